// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/support/run_program.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadFile;
using testing_support::RunProgram;

constexpr char kPrefix[] = "icpscape-";

std::set<std::string> Programs() {
  std::set<std::string> programs;
  for (const auto& entry : std::filesystem::directory_iterator(ICPSCAPE_BIN_DIR)) {
    const std::string name = entry.path().filename().string();
    if (name.rfind(kPrefix, 0) == 0) {
      programs.insert(name.substr(sizeof(kPrefix) - 1));
    }
  }
  return programs;
}

const std::string kWithoutInput = "list_metrics";

struct Command {
  std::string place;  // README.md:50
  std::string program;
  std::vector<std::string> arguments;
};

// The command in a row of a table: | question | `icpscape-register --scene=...` |.
std::string CommandInRow(const std::string& row) {
  const std::size_t begin = row.find(std::string("`") + kPrefix);
  return begin == std::string::npos ? ""
                                    : row.substr(begin + 1, row.find('`', begin + 1) - begin - 1);
}

// The lines of a page's fenced code blocks that run a program, without their comments, and the
// commands in rows of its tables.
std::vector<Command> CommandsOf(const std::filesystem::path& page) {
  std::vector<Command> commands;
  std::istringstream in(ReadFile(page.string()));
  bool in_block = false;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (line.rfind("```", 0) == 0) {
      in_block = !in_block;
      continue;
    }
    const bool in_row = !in_block && line.rfind("|", 0) == 0;
    const std::vector<std::string> words =
        Split(in_row ? CommandInRow(line) : line.substr(0, line.find(" #")), ' ');
    const std::string name =
        words.empty() ? "" : std::filesystem::path(words[0]).filename().string();
    // A row may also mention a program by its name alone.
    const bool is_mention = in_row && words.size() == 1 && name != kPrefix + kWithoutInput;
    if ((in_block || in_row) && !is_mention && name.rfind(kPrefix, 0) == 0) {
      commands.push_back({page.filename().string() + ":" + std::to_string(number),
                          name.substr(sizeof(kPrefix) - 1),
                          {words.begin() + 1, words.end()}});
    }
  }
  return commands;
}

// Programs check their flags before they create the folder for their results: with a folder that
// cannot be, a command ends there, before any work, if its flags are accepted.
void ExpectAccepted(Command command) {
  SCOPED_TRACE(command.place + ": " + command.program);
  if (command.program == kWithoutInput) {
    EXPECT_EQ(RunProgram(command.program, command.arguments).code, 0);
    return;
  }
  command.arguments.push_back("--out=/dev/null/out");
  ExpectRefusal(RunProgram(command.program, command.arguments), 2, "/dev/null/out");
}

TEST(DocumentedCommands, EveryProgramAnswersHelp) {
  ASSERT_FALSE(Programs().empty());
  for (const std::string& program : Programs()) {
    const Outcome outcome = RunProgram(program, {"--help"});
    EXPECT_EQ(outcome.code, 0) << program;
    EXPECT_EQ(outcome.err, "") << program;
    EXPECT_THAT(outcome.out, StartsWith(kPrefix + program + ": "));
    EXPECT_THAT(outcome.out, HasSubstr("  --"));
  }
}

TEST(DocumentedCommands, ReadmeHasEveryProgramAndItsFlagsAreAccepted) {
  std::set<std::string> named;
  for (const Command& command :
       CommandsOf(std::filesystem::path(ICPSCAPE_SOURCE_DIR) / "README.md")) {
    named.insert(command.program);
    ExpectAccepted(command);
  }
  EXPECT_EQ(named, Programs());
}

TEST(DocumentedCommands, FlagsInDocumentsAreAccepted) {
  std::vector<Command> commands;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(ICPSCAPE_SOURCE_DIR) / "docs")) {
    if (entry.path().extension() == ".md") {
      const std::vector<Command> of_page = CommandsOf(entry.path());
      commands.insert(commands.end(), of_page.begin(), of_page.end());
    }
  }
  ASSERT_FALSE(commands.empty());
  for (const Command& command : commands) {
    ExpectAccepted(command);
  }
}

TEST(DocumentedCommands, TableOfMetricsIsPrintedByListMetrics) {
  const Outcome outcome = RunProgram("list_metrics", {"--markdown"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(ReadFile(std::string(ICPSCAPE_SOURCE_DIR) + "/docs/metrics.md"),
              HasSubstr("\n\n" + outcome.out + "\n"));
}

}  // namespace
}  // namespace icpscape
