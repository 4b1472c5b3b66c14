// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_INTERRUPT_H_
#define ICPSCAPE_APPS_RUN_INTERRUPT_H_

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace icpscape {

/// From now on Ctrl-C (SIGINT) and SIGTERM end the program with one sentence on stderr and the exit
/// code 130 or 143. The file that is being written is finished first, the child process is ended,
/// and the scratch folder is removed: nothing half-written is left. A signal that the caller
/// ignores stays ignored. To be called before there is a second thread.
void EndOnSignals();

/// What the sentence of an interrupted run advises: "the next run goes on from journal.txt".
void SetAdviceAfterInterrupt(const std::string& advice);

/// A folder that goes with the object, or when the program is interrupted. There is one at a time.
class ScratchFolder {
 public:
  /// Throws filesystem_error where the folder cannot be created.
  explicit ScratchFolder(std::filesystem::path path);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Waits for the child, which is ended when the program is interrupted. Returns its wait status.
int WaitForChild(pid_t child);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_INTERRUPT_H_
