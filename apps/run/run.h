// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_RUN_H_
#define ICPSCAPE_APPS_RUN_RUN_H_

#include <filesystem>
#include <string>
#include <vector>

#include "apps/run/run_flags.h"
#include "icpscape/io/manifest.h"

namespace icpscape {

/// One run of a program: its folder, its manifest, and every file that it writes.
///
/// What an earlier run of the same program left in the folder is removed just before this run
/// writes its first file: by then all inputs are read, which may be among those files. The earlier
/// run's manifest.json lists these files or, where that run did not end, .PROGRAM.written, which
/// lists files from before they are written until the manifest takes its place. Files of other
/// programs and of the user stay.
class Run {
 public:
  /// Creates --out, proves that it is writable, and takes away the manifest of an earlier run: a
  /// folder with a manifest holds a finished run. Throws UsageError, InputError.
  Run();

  Manifest* manifest() { return &manifest_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Where the caller is about to write this file of the results.
  std::filesystem::path File(const std::string& name);

  /// Where a file or folder lies that later runs go on with. They do not remove it, and the
  /// closing lines name it as well.
  std::filesystem::path Lasting(const std::string& name);

  /// Draws what --figures asks for: calls tools/SCRIPT with the arguments and "--out PATH", PATH
  /// being that of the figure without extension, or of a folder where `figure` is empty. What the
  /// script has drawn moves into the folder when all of it is done. Where drawing fails there is
  /// one warning, and no figure, not even that of an earlier run.
  void Draw(const std::string& script, std::vector<std::string> arguments,
            const std::string& figure);

  /// Writes manifest.json and prints the closing lines: how long what took, and what was written.
  void Finish();

 private:
  void BeginWriting();
  std::string WrittenText() const;

  std::filesystem::path folder_;
  FigureFormats figures_;
  std::filesystem::path list_;      // Of this run's files, while it is not finished.
  std::vector<std::string> stale_;  // Of an earlier run; empty once they are removed.
  std::vector<std::string> files_, lasting_;
  Manifest manifest_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_RUN_H_
