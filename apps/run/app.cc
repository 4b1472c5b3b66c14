// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run/app.h"

#include <gflags/gflags.h>
#include <glog/logging.h>

#include <cstring>
#include <filesystem>
#include <iostream>
#include <new>

#include "apps/run/interrupt.h"
#include "icpscape/common/error.h"
#include "icpscape/io/manifest.h"
#include "icpscape/simd/level.h"

namespace icpscape {
namespace {

std::string& MutableAppName() {
  static std::string name;
  return name;
}

bool AsksForHelp(const char* argument) {
  return std::strcmp(argument, "--help") == 0 || std::strcmp(argument, "-help") == 0 ||
         std::strcmp(argument, "-h") == 0;
}

void PrintHelp(const std::string& summary) {
  std::cout << AppName() << ": " << summary
            << "\n\nFlags are given as --name=value; --flagfile=FILE reads them from a file.\n";
  std::string group;
  for (const Flag& flag : OwnFlags()) {
    if (flag.group != group) {
      group = flag.group;
      std::cout << "\n" << group << ":\n";
    }
    const bool has_default = !flag.default_value.empty() && flag.default_value != "nan";
    std::cout << "  --" << flag.name << "  (" << flag.type << ", default "
              << (has_default ? flag.default_value : "none") << ")\n      " << flag.help << "\n";
  }
  std::cout << "\nExit codes: 0 done, 1 the command line is wrong, 2 the data are wrong, 3 the "
            << "computation has no answer,\n4 there is a pose but its verdict is bad, 130 "
               "interrupted by Ctrl-C, 143 by SIGTERM.\n";
}

int Fail(const std::string& message, int code) {
  std::cerr << AppName() << ": " << message << std::endl;
  return code;
}

}  // namespace

const std::string& AppName() { return MutableAppName(); }

int RunApp(int argc, char** argv, const std::string& summary, const std::function<void()>& run) {
  MutableAppName() = std::filesystem::path(argv[0]).filename().string();
  google::InitGoogleLogging(argv[0]);
  FLAGS_logtostderr = true;
  FLAGS_log_prefix = false;
  // By default icpscape-landscape writes into out/landscape.
  SetFlagDefault("out", "out/" + AppName().substr(AppName().find('-') + 1));
  for (int i = 1; i < argc; ++i) {
    if (AsksForHelp(argv[i])) {
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
  EndOnSignals();
  try {
    ActiveSimdLevel();  // Refuses an unknown level before any work.
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
  } catch (const DoubtfulPose& doubt) {
    return Fail(doubt.what(), 4);
  } catch (const std::bad_alloc&) {
    return Fail("out of memory; expected smaller clouds or fewer samples.", 3);
  } catch (const std::exception& error) {
    return Fail(std::string("unexpected error: ") + error.what(), 3);
  }
}

}  // namespace icpscape
