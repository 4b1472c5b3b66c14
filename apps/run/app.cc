// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/app.h"

#include <fcntl.h>
#include <gflags/gflags.h>
#include <glog/logging.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>
#include <vector>

#include "src/common/error.h"
#include "src/simd/level.h"

extern char** environ;

namespace icpscape {
namespace {

std::string& MutableAppName() {
  static std::string name;
  return name;
}

std::vector<gflags::CommandLineFlagInfo> OwnFlags() {
  std::vector<gflags::CommandLineFlagInfo> all;
  std::vector<gflags::CommandLineFlagInfo> own;
  gflags::GetAllFlags(&all);
  for (const gflags::CommandLineFlagInfo& flag : all) {
    // gflags, glog and other libraries define flags of their own.
    if (flag.filename.find("apps/") != std::string::npos) {
      own.push_back(flag);
    }
  }
  return own;
}

void PrintHelp(const std::string& summary) {
  std::cout << AppName() << ": " << summary << "\n\nFlags (--name=value; --flagfile=FILE reads "
            << "them from a file):\n";
  for (const gflags::CommandLineFlagInfo& flag : OwnFlags()) {
    std::cout << "  --" << flag.name << "  (" << flag.type << ", default "
              << (flag.default_value.empty() ? "none" : flag.default_value) << ")\n      "
              << flag.description << "\n";
  }
  std::cout << "\nExit codes: 0 done, 1 the command line is wrong, 2 the data are wrong, 3 the "
            << "computation has no answer.\n";
}

int Fail(const std::string& message, int code) {
  std::cerr << AppName() << ": " << message << std::endl;
  return code;
}

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

const std::string& AppName() { return MutableAppName(); }

int RunApp(int argc, char** argv, const std::string& summary, const std::function<void()>& run) {
  MutableAppName() = std::filesystem::path(argv[0]).filename().string();
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  FLAGS_log_prefix = false;
  // icpscape-landscape writes into out/landscape unless told otherwise.
  gflags::SetCommandLineOptionWithMode("out",
                                       ("out/" + AppName().substr(AppName().find('-') + 1)).c_str(),
                                       gflags::SET_FLAGS_DEFAULT);
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--help") == 0 || std::strcmp(argv[i], "-help") == 0 ||
        std::strcmp(argv[i], "-h") == 0) {
      PrintHelp(summary);
      return 0;
    }
  }
  gflags::SetUsageMessage(summary);
  gflags::SetVersionString(Version());
  gflags::ParseCommandLineFlags(&argc, &argv, true);
  if (argc > 1) {
    return Fail(
        "stray argument \"" + std::string(argv[1]) + "\"; expected only --flag=value (see --help).",
        1);
  }
  try {
    ActiveSimdLevel();  // A level that is none is refused before there is work.
    run();
    return 0;
  } catch (const UsageError& error) {
    return Fail(error.what(), 1);
  } catch (const InputError& error) {
    return Fail(error.what(), 2);
  } catch (const std::filesystem::filesystem_error& error) {
    return Fail(error.what(), 2);
  } catch (const ComputationError& error) {
    return Fail(error.what(), 3);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory; expected smaller clouds or fewer samples.", 3);
  } catch (const std::exception& error) {
    return Fail(std::string("unexpected error: ") + error.what(), 3);
  }
}

void RequireFlag(bool good, const std::string& flag, const std::string& value,
                 const std::string& expected) {
  if (!good) {
    throw UsageError("--" + flag + "=" + value + ": expected " + expected + ".");
  }
}

std::map<std::string, std::string> OwnFlagValues() {
  std::map<std::string, std::string> values;
  for (const gflags::CommandLineFlagInfo& flag : OwnFlags()) {
    values[flag.name] = flag.current_value;
  }
  return values;
}

void RecordFlags(Manifest* manifest) {
  for (const auto& [name, value] : OwnFlagValues()) {
    manifest->SetFlag(name, value);
  }
}

Progress::~Progress() {
  if (shown_) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::Show(int done) {
  if (isatty(STDERR_FILENO) != 0) {
    shown_ = true;
    constexpr int kWidth = 20;
    const int marks = kWidth * done / std::max(1, total_);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    std::fprintf(stderr, "\r[%s%s] %d/%d %s, %.1f/s, %.0f s left\033[K",
                 std::string(static_cast<std::size_t>(marks), '#').c_str(),
                 std::string(static_cast<std::size_t>(kWidth - marks), '-').c_str(), done, total_,
                 unit_.c_str(), done / seconds, seconds / done * (total_ - done));
    std::fflush(stderr);
  }
}

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
  pid_t pid = 0;
  int status = -1;
  if (posix_spawnp(&pid, python.c_str(), &quiet, nullptr, argv.data(), environ) == 0) {
    waitpid(pid, &status, 0);
  }
  posix_spawn_file_actions_destroy(&quiet);
  if (status != 0) {
    LOG(WARNING) << "No figures: " << script
                 << " failed (it needs python3 with matplotlib); the tables are written.";
  }
  return status == 0;
}

}  // namespace icpscape
