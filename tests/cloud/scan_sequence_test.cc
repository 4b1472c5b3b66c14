// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/scan_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
