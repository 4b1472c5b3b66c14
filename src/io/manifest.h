// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_IO_MANIFEST_H_
#define ICPSCAPE_SRC_IO_MANIFEST_H_

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace icpscape {

/// What a run was: program, version, effective flags, hashes of its inputs, timings, headline
/// results and the files that it wrote; written as manifest.json beside the tables.
class Manifest {
 public:
  explicit Manifest(const std::string& program);
  ~Manifest();
  Manifest(const Manifest&) = delete;
  Manifest& operator=(const Manifest&) = delete;

  /// A flag that `is_changed` makes the results differ from those of the defaults; it is listed a
  /// second time.
  void SetFlag(const std::string& name, const std::string& value, bool is_changed);
  /// Records path, size and SHA-256. Throws InputError where the file cannot be read.
  void AddInput(const std::filesystem::path& path);
  void SetResult(const std::string& name, double value);
  void SetResult(const std::string& name, const std::string& value);
  /// Seconds since the last call (or the start), under that name.
  void AddTiming(const std::string& name);
  /// "read 0.03 s, landscape 0.41 s": the timings in the order of AddTiming.
  std::string TimingsText() const;

  /// The files beside the manifest that belong to the run.
  void SetFiles(const std::vector<std::string>& names);

  void Write(const std::filesystem::path& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The files that a manifest lists; nothing where there is no manifest of this program.
std::optional<std::vector<std::string>> FilesOfManifest(const std::filesystem::path& path,
                                                        const std::string& program);

/// "0.1.0 (1a2b3c4d5e6f)": release and, where the sources are a git checkout, the commit.
std::string Version();

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_IO_MANIFEST_H_
