// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/io/dataset.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "icpscape/common/error.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/sequences.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulated_sequence.h"
#include "tests/support/message_of.h"
#include "tests/support/run_program.h"

namespace icpscape {
namespace {

namespace fs = std::filesystem;

using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::RunProgram;

class Dataset : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) / ("icpscape_dataset_" + std::string(info->name()));
    fs::remove_all(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static PointCloud Cloud(int i) {
    PointCloud cloud;
    for (int j = 0; j < 100; ++j) {
      cloud.x.push_back(static_cast<float>(1 + i));
      cloud.y.push_back(static_cast<float>(j) * 0.1F);
      cloud.z.push_back(-1.5F);
      cloud.intensity.push_back(0.25F);
      cloud.ring.push_back(j % 64);
      cloud.label.push_back(252 + (j << 16));
    }
    return cloud;
  }

  static PointCloud CloudWithTimes(int i) {
    PointCloud cloud = Cloud(i);
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      cloud.time_s.push_back(static_cast<float>(j) * 0.001F - 0.05F);
    }
    return cloud;
  }

  DatasetSummary Write(const std::string& parameters = "p", int count = 3,
                       bool point_times = false) {
    DatasetOptions options;
    options.root = root_;
    options.name = "street";
    options.parameters = parameters;
    std::vector<SE3d> poses;
    for (int i = 0; i < count; ++i) {
      Vec6 xi;
      xi << 0.01, -0.02, 0.1 * i, 2.5 * i, 0.3, 0.02 * i;
      poses.push_back(SE3d::Exp(xi));
    }
    poses_ = poses;
    options.point_times = point_times;
    return WriteDataset(options, poses, point_times ? CloudWithTimes : Cloud);
  }

  fs::path Sequence() const { return root_ / "sequences" / "street"; }

  fs::path root_;
  std::vector<SE3d> poses_;
};

TEST_F(Dataset, ReadsBackAsKitti) {
  Write();
  const ScanSequence sequence = OpenKittiSequence(root_, "street");
  DroppedPoints dropped;
  const PointCloud cloud = sequence.scans[2].read(&dropped);
  const PointCloud expected = Cloud(2);
  EXPECT_EQ(cloud.x, expected.x);
  EXPECT_EQ(cloud.y, expected.y);
  EXPECT_EQ(cloud.z, expected.z);
  EXPECT_EQ(cloud.intensity, expected.intensity);
  const SE3d truth = poses_[1].Inverse() * poses_[2];
  EXPECT_TRUE(sequence.Motion(1, 2)->Matrix().isApprox(truth.Matrix(), 1e-12));
  EXPECT_TRUE(sequence.T_world_lidar[2].Matrix().isApprox(
      (poses_[0].Inverse() * poses_[2]).Matrix(), 1e-12));
  EXPECT_EQ(fs::file_size(Sequence() / "labels" / "000002.label"), 400U);
  EXPECT_EQ(fs::file_size(Sequence() / "rings" / "000002.ring"), 100U);
  std::ifstream labels(Sequence() / "labels" / "000002.label", std::ios::binary);
  std::uint32_t label[2];
  labels.read(reinterpret_cast<char*>(label), sizeof(label));
  EXPECT_EQ(label[1], 252U + 65536U);
  std::ifstream times(Sequence() / "times.txt");
  double first = -1, second = -1;
  times >> first >> second;
  EXPECT_EQ(first, 0);
  EXPECT_EQ(second, 0.1);
}

TEST_F(Dataset, IsKeptUntilParametersChange) {
  EXPECT_EQ(Write("a").simulated, 3);
  EXPECT_EQ(Write("a").simulated, 0);
  EXPECT_EQ(Write("a", 5).simulated, 2);  // A longer drive takes up the shorter.
  EXPECT_EQ(Write("b").simulated, 3);
  EXPECT_FALSE(fs::exists(Sequence() / "velodyne" / "000004.bin"));  // Nothing old is left over.
}

TEST_F(Dataset, HarmedScansAreMadeAgain) {
  Write();
  fs::resize_file(Sequence() / "velodyne" / "000001.bin", 100);
  EXPECT_EQ(Write().simulated, 1);
  EXPECT_EQ(fs::file_size(Sequence() / "velodyne" / "000001.bin"), 1600U);
  fs::remove(Sequence() / "rings" / "000000.ring");
  EXPECT_EQ(Write().simulated, 1);
  fs::resize_file(Sequence() / "simulation.json", 30);
  EXPECT_EQ(Write().simulated, 3);
}

TEST_F(Dataset, AStoppedRunIsTakenUp) {
  DatasetOptions options;
  options.root = root_;
  options.name = "street";
  options.parameters = "p";
  const std::vector<SE3d> poses(50);
  EXPECT_THROW(WriteDataset(options, poses,
                            [](int i) {
                              if (i == 45) {
                                throw InputError("stopped");
                              }
                              return Cloud(i);
                            }),
               InputError);
  const DatasetSummary summary = WriteDataset(options, poses, Cloud);
  EXPECT_GE(summary.kept, 38);
  EXPECT_EQ(summary.kept + summary.simulated, 50);
}

TEST_F(Dataset, LeavesForeignScansAlone) {
  fs::create_directories(Sequence() / "velodyne");
  std::ofstream(Sequence() / "velodyne" / "000000.bin") << "measured";
  EXPECT_THROW(Write(), InputError);
  EXPECT_EQ(fs::file_size(Sequence() / "velodyne" / "000000.bin"), 8U);
}

TEST_F(Dataset, TheProgramAnswersMistakesInOneSentence) {
  const auto refuse = [&](std::vector<std::string> flags, int code, const std::string& says) {
    flags.insert(flags.begin(), "--out=" + root_.string());
    ExpectRefusal(RunProgram("simulate", flags), code, says);
  };
  refuse({"--scene=motorway"}, 1, "scene motorway: no such scene; expected one of");
  refuse({}, 1, "expected --scene=NAME, or --kitti_root=DIR");
  refuse({"--scene=highway", "--dropout=2"}, 1, "dropout=2: expected 0 to 0.9");
  refuse({"--scene=highway", "--range_noise_m=-1"}, 1, "range_noise_m=-1: expected 0 to 1 m");
  refuse({"--scene=highway", "--frames=0:1"}, 1, "--frames=0:1: expected --kitti_root");
  refuse({"--kitti_root=.", "--frames=5:1"}, 1, "frames=5:1: expected FIRST:LAST");
  refuse({"--kitti_root=.", "--frames=1-5"}, 1, "frames=1-5: expected FIRST:LAST");
  EXPECT_FALSE(fs::exists(root_));
  refuse({"--kitti_root=/nowhere", "--sequence=00"}, 2, "/nowhere/sequences/00: no such folder");
  EXPECT_TRUE(!fs::exists(root_) || fs::is_empty(root_));
  refuse({"--scene=highway", "--out=/proc/nowhere"}, 2, "/proc/nowhere");
}

TEST_F(Dataset, HasTheTimesOfPoints) {
  Write("p", 3, true);
  const auto read = [&](std::size_t i) {
    DroppedPoints dropped;
    return OpenKittiSequence(root_, "street").scans[i].read(&dropped);
  };
  EXPECT_EQ(read(2).time_s, CloudWithTimes(2).time_s);
  EXPECT_EQ(Write("p", 3, true).kept, 3);
  const fs::path times = Sequence() / "times" / "000001.time";
  EXPECT_EQ(OpenKittiSequence(root_, "street").scans[1].times_file, times);
  fs::resize_file(times, 396);
  EXPECT_EQ(testing_support::MessageOf([&] { read(1); }),
            times.string() +
                ": 396 bytes; expected a float32 for each of the scan's 100 usable "
                "points.");
  EXPECT_EQ(Write("p", 3, true).simulated, 1);
  EXPECT_EQ(read(1).time_s, CloudWithTimes(1).time_s);
  Write("without");
  EXPECT_TRUE(read(2).time_s.empty());
  EXPECT_FALSE(fs::exists(times));
}

TEST_F(Dataset, AWrittenSceneIsTheSceneItself) {
  const Outcome outcome =
      RunProgram("simulate", {"--scene=right_turn", "--seed=4", "--out=" + root_.string()});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::HasSubstr("right_turn: 3 scans simulated, 0 kept"));
  const ScanPair pair = SimulatePair("right_turn", 4, LidarOptions(), 2);
  const ScanSequence sequence = OpenKittiSequence(root_, "right_turn");
  DroppedPoints dropped;
  EXPECT_EQ(sequence.scans[2].read(&dropped).x, pair.source.x);
  EXPECT_EQ(sequence.scans[1].read(&dropped).x, pair.target.x);
  EXPECT_TRUE(sequence.Motion(1, 2)->Matrix().isApprox(pair.T_ground_truth->Matrix(), 1e-9));
  EXPECT_TRUE(sequence.Motion(0, 1)->Matrix().isApprox(pair.T_predicted->Matrix(), 1e-9));
}

}  // namespace
}  // namespace icpscape
