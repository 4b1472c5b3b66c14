// SPDX-License-Identifier: BSD-3-Clause
// What a stopped run leaves, and how the next run goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/apps/odometry_fixture.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_support::Bytes;
using testing_support::ExpectRefusal;
using testing_support::kProgram;
using testing_support::OdometryApp;
using testing_support::Outcome;
using testing_support::ReadFile;
using testing_support::RunningProgram;
using testing_support::RunProgram;
using testing_support::TheDrive;

// Starts the program with its output thrown away.
pid_t Spawn(const std::vector<std::string>& arguments) {
  std::vector<char*> argv = {const_cast<char*>(kProgram)};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, kProgram, &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

// One run that is killed ten times, a few milliseconds after one more scan was reported.
TEST_F(OdometryApp, LosesNothingWhenItIsKilled) {
  ASSERT_EQ(Run({"--threads=1"}, "whole").code, 0);
  const auto lines = [&] {
    const std::string text = ReadFile(Path("out/journal.txt"));
    return std::count(text.begin(), text.end(), '\n');
  };
  std::mt19937 engine(1);
  int killed = 0;
  for (int kill_number = 1; kill_number <= 10; ++kill_number) {
    const pid_t pid = Spawn(Kitti());
    int status = 0;
    pid_t ended = 0;
    while (lines() < 1 + kill_number && ended == 0) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ended = waitpid(pid, &status, WNOHANG);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(engine() % 20000));
    if (ended == 0) {
      kill(pid, SIGKILL);
      waitpid(pid, &status, 0);
    }
    killed += WIFSIGNALED(status) ? 1 : 0;
    const auto reported = lines();
    if (kill_number % 3 == 0) {  // A write that the system had not finished.
      std::ofstream(Path("out/journal.txt"), std::ios::app) << "0123 1 0 17 0.02";
    }
    EXPECT_GE(reported, 1 + kill_number);
  }
  EXPECT_GE(killed, 5);
  const Outcome outcome = Run();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scans are done, and are replayed"));
  ExpectSameResults("out", "whole");
}

// Ctrl-C and SIGTERM, each at one more scan.
TEST_F(OdometryApp, GoesOnWhereItWasInterrupted) {
  ASSERT_EQ(Run({}, "whole").code, 0);
  for (const int signal : {SIGINT, SIGTERM}) {
    const auto lines = [&] {
      const std::string text = ReadFile(Path("out/journal.txt"));
      return std::count(text.begin(), text.end(), '\n');
    };
    const auto before = lines();
    RunningProgram program("odometry", Kitti());
    while (lines() < before + 2) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    program.Signal(signal);
    const Outcome outcome = program.Wait();
    EXPECT_EQ(outcome.code, 128 + signal) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("the next run goes on from journal.txt.\n"));
    for (const auto& entry : std::filesystem::directory_iterator(Path("out"))) {
      EXPECT_EQ(entry.path().filename(), "journal.txt");
    }
  }
  const Outcome outcome = Run();
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("scans are done, and are replayed"));
  ExpectSameResults("out", "whole");
  // A journal is no result that the next run would remove.
  EXPECT_THAT(outcome.out, HasSubstr("journal.txt"));
  ASSERT_EQ(Run().code, 0);
  EXPECT_EQ(Journal().size(), static_cast<std::size_t>(testing_support::kScans));
}

// A run that goes on from a journal repeats the results of a whole run.
TEST_F(OdometryApp, RepeatsItsResults) {
  for (const char* mode : {"scan_to_scan", "two_stage"}) {
    const std::vector<std::string> flags = {std::string("--mode=") + mode, "--frames=0:5",
                                            "--map_every=2", "--restart"};
    ASSERT_EQ(Run(flags, "first").code, 0);
    std::filesystem::remove_all(Path("again"));
    std::filesystem::create_directories(Path("again"));
    // All but two of the scans.
    const std::string journal = ReadFile(Path("first/journal.txt"));
    std::size_t end = journal.size() - 1;
    for (int line = 0; line < 2; ++line) {
      end = journal.rfind('\n', end - 1);
    }
    folder_.Write("again/journal.txt", journal.substr(0, end + 1));
    ASSERT_EQ(Run({flags[0], flags[1], flags[2]}, "again").code, 0);
    ExpectSameResults("again", "first");
  }
}

TEST_F(OdometryApp, GoesOnOnlyWithTheSameFlags) {
  const std::string frames = "--frames=0:2";
  ASSERT_EQ(Run({frames, "--mode=scan_to_scan"}).code, 0);
  const std::string journal = ReadFile(Path("out/journal.txt"));
  ExpectRefusal(Run({frames, "--mode=two_stage"}), 2,
                "journal.txt: was written with mode=scan_to_scan, now mode=two_stage");
  ExpectRefusal(Run({"--frames=0:3", "--mode=scan_to_scan"}), 2, "frames=0:2, now frames=0:3");
  EXPECT_EQ(ReadFile(Path("out/journal.txt")), journal);
  ASSERT_EQ(Run({frames, "--mode=two_stage", "--restart"}).code, 0);
  EXPECT_NE(ReadFile(Path("out/journal.txt")), journal);
  const std::string replayed = "journal: 3 scans are done, and are replayed";
  const Outcome again = Run({frames, "--mode=two_stage", "--threads=1"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr(replayed));

  folder_.Write(Scan(1), Bytes(TheDrive().scans[2]));
  ExpectRefusal(Run({frames, "--mode=two_stage"}), 2,
                "000001.bin: is not the scan of the journal; expected it unchanged, or a restart.");
  EXPECT_FALSE(std::filesystem::exists(Path("out/manifest.json")));  // The mark of a finished run.
  const Outcome restarted = Run({frames, "--mode=two_stage", "--restart"});
  EXPECT_EQ(restarted.code, 0) << restarted.err;
  EXPECT_THAT(restarted.out, Not(HasSubstr("replayed")));
  EXPECT_TRUE(std::filesystem::exists(Path("out/manifest.json")));

  // The data may have moved since.
  std::filesystem::rename(Path("kitti"), Path("moved"));
  const Outcome moved =
      RunProgram("odometry", {"--kitti_root=" + Path("moved"), "--sequence=05", frames,
                              "--mode=two_stage", "--out=" + Path("out")});
  EXPECT_EQ(moved.code, 0) << moved.err;
  EXPECT_THAT(moved.out, HasSubstr(replayed));
  std::filesystem::rename(Path("moved"), Path("kitti"));

  // Not even --restart takes the folder from a running program.
  const int file = open(Path("out/journal.txt").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(file, LOCK_EX), 0);
  const std::string kept = ReadFile(Path("out/journal.txt"));
  ExpectRefusal(Run({frames, "--restart"}), 2, "journal.txt: another run writes it");
  EXPECT_EQ(ReadFile(Path("out/journal.txt")), kept);
  close(file);
}

TEST_F(OdometryApp, KeepsWhatWasDoneBeforeABadScan) {
  const std::vector<std::string> frames = {"--frames=0:5"};
  ASSERT_EQ(Run(frames, "whole").code, 0);
  const std::string scan = ReadFile(Path(Scan(3)));
  folder_.Write(Scan(3), scan.substr(0, 1000));
  ExpectRefusal(Run(frames), 2, "000003.bin: 1000 bytes; expected a multiple of 16");
  EXPECT_EQ(Journal().size(), 3U);
  EXPECT_FALSE(std::filesystem::exists(Path("out/trajectory_kitti.txt")));
  EXPECT_FALSE(std::filesystem::exists(Path("out/manifest.json")));
  folder_.Write(Scan(3), scan);
  const Outcome outcome = Run(frames);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("journal: 3 scans are done, and are replayed"));
  ExpectSameResults("out", "whole");
}

}  // namespace
}  // namespace icpscape
