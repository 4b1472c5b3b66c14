// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_RUN_PROGRAM_H_
#define ICPSCAPE_TESTS_SUPPORT_RUN_PROGRAM_H_

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "src/common/text.h"
#include "tests/support/temporary_folder.h"

extern char** environ;

namespace icpscape::testing_support {

/// How a program ended.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs icpscape-APP to its end.
inline Outcome RunProgram(const std::string& app, std::vector<std::string> arguments) {
  const TemporaryFolder capture;
  const std::string program = std::string(ICPSCAPE_BIN_DIR) + "/icpscape-" + app;
  arguments.insert(arguments.begin(), program);
  std::vector<char*> argv;
  for (std::string& argument : arguments) {
    argv.push_back(argument.data());
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const std::string out = (capture.path() / "out").string();
  const std::string err = (capture.path() / "err").string();
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out.c_str(), O_CREAT | O_WRONLY, 0600);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err.c_str(), O_CREAT | O_WRONLY, 0600);
  pid_t pid = 0;
  Outcome outcome;
  if (posix_spawn(&pid, program.c_str(), &actions, nullptr, argv.data(), environ) == 0) {
    int status = 0;
    waitpid(pid, &status, 0);
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  posix_spawn_file_actions_destroy(&actions);
  outcome.out = ReadFile(out);
  outcome.err = ReadFile(err);
  return outcome;
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
