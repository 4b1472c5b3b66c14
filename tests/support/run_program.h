// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_RUN_PROGRAM_H_
#define ICPSCAPE_TESTS_SUPPORT_RUN_PROGRAM_H_

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/common/text.h"
#include "tests/support/temporary_folder.h"

extern char** environ;

namespace icpscape::testing_support {

/// How a program ended.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// icpscape-APP while it runs.
class RunningProgram {
 public:
  RunningProgram(const std::string& app, std::vector<std::string> arguments) {
    const std::string program = std::string(ICPSCAPE_BIN_DIR) + "/icpscape-" + app;
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out_.c_str(), O_CREAT | O_WRONLY,
                                     0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err_.c_str(), O_CREAT | O_WRONLY,
                                     0600);
    EXPECT_EQ(posix_spawn(&pid_, program.c_str(), &actions, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }

  void Signal(int number) const { kill(pid_, number); }

  /// Waits for its end. Where a signal kills it the code is 256 + signal, which no program returns.
  Outcome Wait() {
    Outcome outcome;
    int status = 0;
    if (waitpid(pid_, &status, 0) == pid_) {
      outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 256 + WTERMSIG(status);
    }
    outcome.out = ReadFile(out_);
    outcome.err = ReadFile(err_);
    return outcome;
  }

 private:
  TemporaryFolder capture_;
  std::string out_ = (capture_.path() / "out").string();
  std::string err_ = (capture_.path() / "err").string();
  pid_t pid_ = 0;
};

/// Runs icpscape-APP to its end.
inline Outcome RunProgram(const std::string& app, std::vector<std::string> arguments) {
  return RunningProgram(app, std::move(arguments)).Wait();
}

/// Exit code, exactly one line on stderr, and what it must say.
inline void ExpectRefusal(const Outcome& outcome, int code, const std::string& says) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr(says));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

/// One map from column to cell per row.
inline std::vector<std::map<std::string, std::string>> ReadCsv(const std::string& path) {
  std::istringstream in(ReadFile(path));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> columns = Split(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(in, line)) {
    const std::vector<std::string> cells = Split(line);
    EXPECT_EQ(cells.size(), columns.size());
    std::map<std::string, std::string> row;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      row[columns[i]] = cells[i];
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_RUN_PROGRAM_H_
