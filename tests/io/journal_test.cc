// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>

#include "icpscape/io/sha256.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing_support::MessageOf;
using testing_support::ReadFile;
using testing_support::TemporaryFolder;

constexpr char kHeader[] = "program; version=1; voxel_m=0.25; scans=3";

class JournalTest : public testing::Test {
 protected:
  // The journal of a run that ended; returns its text.
  std::string Write(const std::vector<std::string>& records) {
    std::filesystem::remove(path_);
    Journal journal(path_, kHeader);
    for (const std::string& record : records) {
      journal.Append(record);
    }
    return ReadFile(path_);
  }

  std::string Refusal(const std::string& header = kHeader) {
    return MessageOf([&] { Journal(path_, header); });
  }

  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "journal.txt";
};

TEST_F(JournalTest, GivesBackWhatWasAppended) {
  {
    Journal journal(path_, kHeader);
    EXPECT_THAT(journal.records(), IsEmpty());
    journal.Append("1 2 3");
    journal.Append("");  // A record may be empty, and may end in a blank.
    EXPECT_THAT(journal.records(), ElementsAre("1 2 3", ""));
  }
  {
    Journal journal(path_, kHeader);
    EXPECT_THAT(journal.records(), ElementsAre("1 2 3", ""));
    journal.Append("4 ");
  }
  EXPECT_THAT(Journal(path_, kHeader).records(), ElementsAre("1 2 3", "", "4 "));
}

// The format as it is documented, so that others can check a journal.
TEST_F(JournalTest, ChainsChecksums) {
  const std::string first = Sha256OfText(std::string("\n") + kHeader).substr(0, 16);
  const std::string second = Sha256OfText(first + "\na b").substr(0, 16);
  EXPECT_EQ(Write({"a b"}), kHeader + (" " + first) + "\na b " + second + "\n");
}

// Readers see a record as soon as Append returned: nothing waits in this process.
TEST_F(JournalTest, IsWrittenAtOnce) {
  Journal journal(path_, kHeader);
  journal.Append("reported");
  EXPECT_THAT(ReadFile(path_), HasSubstr("\nreported "));
}

TEST_F(JournalTest, DropsATornTailWhereverItWasTorn) {
  const std::string two = Write({"first record", "second record"});
  const std::string three = Write({"first record", "second record", "third record"});
  ASSERT_EQ(three.substr(0, two.size()), two);
  for (std::size_t size = two.size(); size < three.size(); ++size) {
    folder_.Write("journal.txt", three.substr(0, size));
    {
      Journal journal(path_, kHeader);
      EXPECT_THAT(journal.records(), ElementsAre("first record", "second record")) << size;
      EXPECT_EQ(ReadFile(path_), two) << size;
      journal.Append("third record");
    }
    EXPECT_EQ(ReadFile(path_), three) << size;
  }
}

// After a loss of power a file can be longer than what was written to it.
TEST_F(JournalTest, DropsATailOfZeros) {
  const std::string text = Write({"first record"});
  folder_.Write("journal.txt", text + std::string(4096, '\0'));
  EXPECT_THAT(Journal(path_, kHeader).records(), ElementsAre("first record"));
  EXPECT_EQ(ReadFile(path_), text);
}

TEST_F(JournalTest, BeginsAnewFromATornHeader) {
  const std::string text = Write({});
  for (std::size_t size = 0; size < text.size(); ++size) {
    folder_.Write("journal.txt", text.substr(0, size));
    EXPECT_THAT(Journal(path_, kHeader).records(), IsEmpty()) << size;
    EXPECT_EQ(ReadFile(path_), text) << size;
  }
}

// A file that is no journal is not cut off.
TEST_F(JournalTest, LeavesOtherFilesAlone) {
  for (const std::string text :
       {"a diary without a line feed", "a diary\n", "a diary\nof days\n"}) {
    folder_.Write("journal.txt", text);
    EXPECT_THAT(Refusal(), HasSubstr("journal.txt:1: ")) << text;
    EXPECT_EQ(ReadFile(path_), text);
  }
}

TEST_F(JournalTest, RefusesDamageBeforeTheEnd) {
  const std::string text = Write({"first record", "second record", "third record"});
  const std::size_t end = text.find("third") - 1;  // The line feed before the last line.
  int line = 1;
  for (std::size_t i = 0; i < end; ++i) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    folder_.Write("journal.txt", damaged);
    const std::string place = "journal.txt:" + std::to_string(line) + ": damaged";
    EXPECT_THAT(Refusal(), HasSubstr(place)) << i;
    EXPECT_EQ(ReadFile(path_), damaged);
    line += text[i] == '\n' ? 1 : 0;
  }
  // Lines that are whole but not where they were.
  const std::size_t first = text.find("first"), second = text.find("second");
  folder_.Write("journal.txt", text.substr(0, first) + text.substr(second));
  EXPECT_THAT(Refusal(), HasSubstr("journal.txt:2: damaged"));
  folder_.Write("journal.txt", text.substr(0, second) + text.substr(first));
  EXPECT_THAT(Refusal(), HasSubstr("journal.txt:3: damaged"));
}

TEST_F(JournalTest, RefusesAnotherHeaderByItsFirstDifference) {
  const std::string text = Write({"first record"});
  EXPECT_THAT(Refusal("program; version=1; voxel_m=0.5; scans=4"),
              EndsWith("journal.txt: was written with voxel_m=0.25, now voxel_m=0.5; expected the "
                       "same, another folder, or a restart."));
  EXPECT_THAT(Refusal("program; version=1; voxel_m=0.25; scans=3; more=1"),
              HasSubstr("with nothing, now more=1"));
  EXPECT_THAT(Refusal("program; version=1; voxel_m=0.25"), HasSubstr("with scans=3, now nothing"));
  EXPECT_THAT(Refusal("odometry"), HasSubstr("with program, now odometry"));
  EXPECT_EQ(ReadFile(path_), text);
}

TEST_F(JournalTest, RefusesASecondRun) {
  Write({"first record"});
  {
    const Journal journal(path_, kHeader);
    EXPECT_THAT(Refusal(), HasSubstr("journal.txt: another run writes it"));
  }
  EXPECT_THAT(Journal(path_, kHeader).records(), ElementsAre("first record"));
}

TEST_F(JournalTest, BeginsAnewWhereAsked) {
  Write({"first record"});
  const std::string anew = "program; version=2";
  {
    Journal journal(path_, anew, Journal::Begin::kAnew);
    EXPECT_THAT(journal.records(), IsEmpty());
    journal.Append("another");
    // Not even then is it taken from a run that writes it.
    EXPECT_THAT(MessageOf([&] { Journal(path_, anew, Journal::Begin::kAnew); }),
                HasSubstr("another run writes it"));
  }
  EXPECT_THAT(Journal(path_, anew).records(), ElementsAre("another"));
  folder_.Write("journal.txt", "damaged\nbeyond\nrepair\n");
  EXPECT_THAT(Journal(path_, kHeader, Journal::Begin::kAnew).records(), IsEmpty());
  EXPECT_EQ(ReadFile(path_), Write({}));
}

TEST_F(JournalTest, RefusesPathsThatCannotBeWritten) {
  const auto message = [](const std::filesystem::path& path) {
    return MessageOf([&] { Journal(path, kHeader); });
  };
  EXPECT_THAT(message(folder_.path() / "missing/journal.txt"),
              HasSubstr("missing/journal.txt: cannot be written; expected a writable folder"));
  EXPECT_THAT(message(folder_.path()), HasSubstr("cannot be written"));
}

// A file may grow no further, as on a full disk: the record is written in part, and then not there.
TEST_F(JournalTest, LosesNothingOnAFullDisk) {
  const std::string text = Write({"first record"});
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit full = {text.size() + 5, before.rlim_max};
  {
    Journal journal(path_, kHeader);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &full), 0);
    const std::string message = MessageOf([&] { journal.Append("second record"); });
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    EXPECT_THAT(message, HasSubstr("journal.txt: cannot be written; expected a disk with space"));
  }
  EXPECT_EQ(ReadFile(path_), text + "secon");
  EXPECT_THAT(Journal(path_, kHeader).records(), ElementsAre("first record"));
  EXPECT_EQ(ReadFile(path_), text);
}

TEST_F(JournalTest, TakesNoLineFeeds) {
  Journal journal(path_, kHeader);
  const auto message = [](const auto& f) { return testing_support::MessageOf<UsageError>(f); };
  EXPECT_EQ(message([&] { journal.Append("a\nb"); }),
            "A journal's record has a line feed; expected one line: a\nb");
  EXPECT_EQ(message([&] { Journal(folder_.path() / "other", "c\nd"); }),
            "A journal's record has a line feed; expected one line: c\nd");
  EXPECT_TRUE(journal.records().empty());
}

}  // namespace
}  // namespace icpscape
