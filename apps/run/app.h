// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_RUN_APP_H_
#define ICPSCAPE_APPS_RUN_APP_H_

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "src/io/manifest.h"

namespace icpscape {

/// main() of every program: parses the flags (all must be --flag=value; --flagfile works), answers
/// --help with this program's own flags, refuses stray arguments and turns errors into one sentence
/// on stderr. Exit codes: 0 done, 1 the command line is wrong, 2 the data are wrong, 3 the
/// computation has no answer.
int RunApp(int argc, char** argv, const std::string& summary, const std::function<void()>& run);

/// Name of the running program, as in "icpscape-landscape".
const std::string& AppName();

/// Throws UsageError "--flag=value: expected ..." unless good.
void RequireFlag(bool good, const std::string& flag, const std::string& value,
                 const std::string& expected);

/// The effective value of each of this program's flags, by name.
std::map<std::string, std::string> OwnFlagValues();

/// Records them.
void RecordFlags(Manifest* manifest);

/// "[###-------] 30/100 poses, 12.1/s, 6 s left" on stderr while it is a terminal; silent
/// otherwise.
class Progress {
 public:
  Progress(std::string unit, int total) : unit_(std::move(unit)), total_(total) {}
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void Show(int done);

 private:
  std::string unit_;
  int total_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Runs tools/SCRIPT (Python with matplotlib) on the arguments. Where that fails there is one
/// warning, the tables stay, and the answer is false.
bool RunPlotScript(const std::string& script, const std::vector<std::string>& arguments);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_RUN_APP_H_
