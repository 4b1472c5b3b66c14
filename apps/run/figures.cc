// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/figures.h"

#include <fcntl.h>
#include <glog/logging.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>

#include <filesystem>

#include "apps/run/interrupt.h"

extern char** environ;

namespace icpscape {
namespace {

// Where this program was installed or built from.
std::filesystem::path ToolPath(const std::string& script) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path installed =
      self.parent_path().parent_path() / "share" / "icpscape" / "tools" / script;
  return std::filesystem::exists(installed, error)
             ? installed
             : std::filesystem::path(ICPSCAPE_SOURCE_DIR) / "tools" / script;
}

}  // namespace

bool RunPlotScript(const std::string& script, const std::vector<std::string>& arguments) {
  // Debian's matplotlib belongs to Debian's Python, which need not be the first on PATH.
  const std::string python =
      std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";
  std::vector<std::string> words = {python, ToolPath(script).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t quiet;  // One warning of ours instead of Python's traceback.
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawnattr_t attributes;  // Signals that only our own thread waits for are Python's again.
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t pid = 0;
  int status = -1;
  if (posix_spawnp(&pid, python.c_str(), &quiet, &attributes, argv.data(), environ) == 0) {
    status = WaitForChild(pid);
  }
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&quiet);
  if (status != 0) {
    LOG(WARNING) << "No figures: " << script
                 << " failed (it needs python3 with matplotlib); the tables are written.";
  }
  return status == 0;
}

}  // namespace icpscape
