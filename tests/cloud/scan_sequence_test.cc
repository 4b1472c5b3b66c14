// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/scan_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "icpscape/common/error.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_support::MessageOf;

TEST(FrameRange, IsReadFromText) {
  EXPECT_EQ(FrameRangeFromText("").first, 0);
  EXPECT_EQ(FrameRangeFromText("").last, -1);
  EXPECT_EQ(FrameRangeFromText("4:17").first, 4);
  EXPECT_EQ(FrameRangeFromText("4:17").last, 17);
  EXPECT_EQ(FrameRangeFromText("3:3").last, 3);
  for (const char* text : {"5:1", "3", ":", "3:", ":3", "-1:3", "0:-1", "a:b", "0:3:5", "0:3 ",
                           " 0:3", "0.5:3", "0:99999999999", "0,3"}) {
    EXPECT_EQ(MessageOf<UsageError>([&] { FrameRangeFromText(text); }),
              std::string("frames=") + text +
                  ": expected FIRST:LAST with 0 <= FIRST <= LAST, as in 0:99.");
  }
}

// Scan i has one point at (i, 0, 1); the lidar drives 2 m a frame along y and turns.
ScanSequence Drive(int size) {
  ScanSequence sequence;
  sequence.title = "drive";
  sequence.place = "a/drive";
  for (int i = 0; i < size; ++i) {
    sequence.scans.push_back({"scan " + std::to_string(i), "", [i](DroppedPoints*) {
                                PointCloud cloud;
                                cloud.x = {static_cast<float>(i)};
                                cloud.y = {0};
                                cloud.z = {1};
                                return cloud;
                              }});
    sequence.times_s.push_back(0.1 * i);
    const Eigen::AngleAxisd turn(0.1 * i, Vec3::UnitZ());
    sequence.T_world_lidar.emplace_back(turn.toRotationMatrix(), Vec3(0, 2.0 * i * i, 0));
  }
  return sequence;
}

TEST(ScanSequence, APairIsTwoOfItsFrames) {
  const ScanSequence drive = Drive(5);
  const ScanPair pair = drive.Pair(4, 2);
  EXPECT_EQ(pair.title, "drive, scan 4 to 2");
  EXPECT_THAT(pair.source.x, ElementsAre(4));
  EXPECT_THAT(pair.target.x, ElementsAre(2));
  // By hand: from (0, 8) turned by 0.2 rad to (0, 32); the frames before lie at (0, 18) and (0, 2).
  const Mat3 R = Eigen::AngleAxisd(-0.2, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_LT((pair.T_ground_truth->t() - R * Vec3(0, 24, 0)).norm(), 1e-12);
  EXPECT_NEAR(pair.T_ground_truth->LogRotation().z(), 0.2, 1e-12);
  const Mat3 R1 = Eigen::AngleAxisd(-0.1, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_LT((pair.T_predicted->t() - R1 * Vec3(0, 16, 0)).norm(), 1e-12);
  EXPECT_FALSE(pair.truth_is_exact);
}

TEST(ScanSequence, APairKnowsWhatItsFramesKnow) {
  ScanSequence drive = Drive(3);
  EXPECT_FALSE(drive.Pair(1, 0).T_predicted);  // No frame comes before frame 0.
  EXPECT_TRUE(drive.Pair(1, 0).T_ground_truth);
  drive.truth_is_exact = true;
  EXPECT_TRUE(drive.Pair(1, 0).truth_is_exact);
  drive.T_world_lidar.clear();
  EXPECT_FALSE(drive.Pair(2, 1).T_ground_truth || drive.Pair(2, 1).T_predicted);
  EXPECT_EQ(MessageOf([&] { drive.Pair(3, 1); }),
            "a/drive: no scan 3 among 3 scans, which are numbered from 0.");
  EXPECT_THAT(MessageOf([&] { drive.Pair(1, -1); }), HasSubstr("no scan -1"));
}

// By hand: the predicted motion is the one over the first second, for the half second that follows.
TEST(ScanSequence, APredictedPoseGoesByTime) {
  ScanSequence drive = Drive(3);
  drive.T_world_lidar = {SE3d(), SE3d(Mat3::Identity(), Vec3(4, 0, 0)),
                         SE3d(Mat3::Identity(), Vec3(7, 0, 0))};
  drive.times_s = {5, 6, 6.5};
  EXPECT_LT((drive.Pair(2, 1).T_predicted->t() - Vec3(2, 0, 0)).norm(), 1e-12);
  EXPECT_LT((drive.Pair(1, 2).T_predicted->t() - Vec3(-2, 0, 0)).norm(), 1e-12);
  drive.times_s[2] = 7.05;  // Jitter.
  EXPECT_EQ(drive.Pair(2, 1).T_predicted->t(), Vec3(4, 0, 0));
  drive.times_s[2] = std::nan("");
  EXPECT_EQ(drive.Pair(2, 1).T_predicted->t(), Vec3(4, 0, 0));
}

TEST(ScanSequence, SaysWhereItsTimesComeFrom) {
  ScanSequence drive = Drive(5);
  drive.times_from = "a file";
  EXPECT_EQ(drive.TimesText(), "a file");
  drive.times_s = {0, 0.1, 0.2, 0.7004, 0.8};
  EXPECT_EQ(drive.TimesText(), "a file, 1 gap of 0.5 s");
  drive.times_s = {0, 0.1, 0.3, 0.4, 1.65};
  EXPECT_EQ(drive.TimesText(), "a file, 2 gaps, the longest of 1.25 s");
  EXPECT_EQ(Drive(1).TimesText(), "");
}

TEST(ScanSequence, IsTurnedAroundWithItsTimes) {
  ScanSequence drive = Drive(4);
  drive.times_s = {10, 10.25, 11.25, 11.5};
  drive.scans[0].read = [](DroppedPoints*) {
    PointCloud cloud;
    cloud.x = cloud.y = cloud.z = {1, 2};
    cloud.time_s = {-0.25, 0.5};
    return cloud;
  };
  drive.Reverse();
  EXPECT_THAT(drive.times_s, ElementsAre(10, 10.25, 11.25, 11.5));
  EXPECT_EQ(drive.scans[0].name, "scan 3");
  DroppedPoints dropped;
  EXPECT_THAT(drive.scans[3].read(&dropped).time_s, ElementsAre(0.25, -0.5));
  EXPECT_THAT(drive.scans[0].read(&dropped).x, ElementsAre(3));
  drive.times_s = {10, 10.25, 10.5, 11.5};
  drive.Reverse();
  EXPECT_THAT(drive.times_s, ElementsAre(10, 11, 11.25, 11.5));
}

TEST(ScanPair, IsTurnedAround) {
  ScanPair pair = Drive(4).Pair(3, 2);
  const SE3d truth = *pair.T_ground_truth, predicted = *pair.T_predicted;
  pair.Reverse();
  EXPECT_THAT(pair.source.x, ElementsAre(2));
  EXPECT_THAT(pair.target.x, ElementsAre(3));
  EXPECT_LT((*pair.T_ground_truth * truth).Log().norm(), 1e-12);
  EXPECT_LT((*pair.T_predicted * predicted).Log().norm(), 1e-12);
  EXPECT_EQ(pair.title, "drive, scan 3 to 2, reversed");
}

}  // namespace
}  // namespace icpscape
