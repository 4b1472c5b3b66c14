// SPDX-License-Identifier: BSD-3-Clause
// Odometry of scans that come at uneven times.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "icpscape/common/error.h"
#include "tests/odometry/drives.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing_support::Bits;
using testing_support::DistanceM;
using testing_support::FirstScans;
using testing_support::kModes;
using testing_support::MessageOf;
using testing_support::Options;
using testing_support::SimulatedDrive;

// 2.6 m a scan on a straight street; scans 6 to 9 are missing.
const SimulatedDrive& FastDrive() {
  static const SimulatedDrive drive = [] {
    const SE3d motion(Mat3::Identity(), Vec3(2.6, 0, 0));
    SimulatedDrive all = testing_support::SimulateDrive(motion, 14);
    all.scans.erase(all.scans.begin() + 6, all.scans.begin() + 10);
    all.T_world_lidar.erase(all.T_world_lidar.begin() + 6, all.T_world_lidar.begin() + 10);
    return all;
  }();
  return drive;
}

double EndOff(bool with_times) {
  Odometry odometry(Options(OdometryMode::kScanToMap));
  SE3d end;
  for (std::size_t i = 0; i < FastDrive().scans.size(); ++i) {
    const double time_s = 0.1 * static_cast<double>(i < 6 ? i : i + 4);
    end = odometry.Add(FastDrive().scans[i], with_times ? std::optional(time_s) : std::nullopt)
              .T_world_lidar;
  }
  return DistanceM(end, FastDrive().T_world_lidar.back());
}

TEST(OdometryTime, BridgesAGap) {
  EXPECT_LT(EndOff(true), 0.1);
  EXPECT_GT(EndOff(false), 5);  // It takes 13 m for 2.6 m.
}

// A scan without a point gets the predicted motion.
TEST(OdometryTime, PredictsByTime) {
  for (const OdometryMode mode : kModes) {
    const auto motions = [&](double second, double third) {
      Odometry odometry(Options(mode));
      odometry.Add(FirstScans(2)[0], 5);
      const SE3d motion = odometry.Add(FirstScans(2)[1], second).motion;
      return std::pair(motion, odometry.Add(PointCloud(), third).motion);
    };
    const auto [motion, after_jitter] = motions(5.1, 5.205);
    EXPECT_GT(motion.t().norm(), 0.5);
    EXPECT_EQ(after_jitter.Matrix(), motion.Matrix());
    const SE3d tripled = motions(5.1, 5.4).second;
    EXPECT_LT((tripled.Matrix() - (motion * motion * motion).Matrix()).norm(), 1e-9);
    const SE3d halved = motions(5.2, 5.3).second;
    EXPECT_LT(((halved * halved).Matrix() - motion.Matrix()).norm(), 1e-9);
  }
}

TEST(OdometryTime, EvenTimesAreNoTimes) {
  Odometry with(Options(OdometryMode::kScanToMap)), without(Options(OdometryMode::kScanToMap));
  for (std::size_t i = 0; i < 4; ++i) {
    const double jitter = i % 2 == 0 ? 0.002 : 0;
    EXPECT_EQ(Bits(with.Add(FirstScans(4)[i], 0.1 * static_cast<double>(i) + jitter)),
              Bits(without.Add(FirstScans(4)[i])));
  }
}

TEST(OdometryTime, ReplaysUnevenTimes) {
  const double times[] = {0, 0.1, 0.4, 0.5};
  const std::size_t scans[] = {0, 1, 4, 5};
  Odometry whole(Options(OdometryMode::kScanToMap)), resumed(Options(OdometryMode::kScanToMap));
  for (std::size_t i = 0; i < 4; ++i) {
    const PointCloud scan = FirstScans(6)[scans[i]];
    const FrameResult result = whole.Add(scan, times[i]);
    if (i < 2) {
      resumed.Replay(scan, result, times[i]);
    } else {
      EXPECT_EQ(Bits(resumed.Add(scan, times[i])), Bits(result)) << i;
    }
  }
}

TEST(OdometryTime, RefusesTimesThatDoNotIncrease) {
  Odometry odometry(Options(OdometryMode::kScanToMap));
  odometry.Add(FirstScans(2)[0], 0.5);
  for (const double time : {0.5, 0.25}) {
    EXPECT_EQ(MessageOf<UsageError>([&] { odometry.Add(FirstScans(2)[1], time); }),
              "a scan at " + std::string(time == 0.5 ? "0.5" : "0.25") +
                  " s after one at 0.5 s; expected increasing times.");
  }
  EXPECT_EQ(odometry.size(), 1);
}

}  // namespace
}  // namespace icpscape
