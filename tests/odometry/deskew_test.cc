// SPDX-License-Identifier: BSD-3-Clause
// Odometry of scans from a lidar that moves while it turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "icpscape/common/error.h"
#include "tests/odometry/drives.h"
#include "tests/support/message_of.h"

namespace icpscape {
namespace {

using testing_support::AngleDeg;
using testing_support::Bits;
using testing_support::DistanceM;
using testing_support::kModes;
using testing_support::MessageOf;
using testing_support::Options;
using testing_support::SimulatedDrive;
using testing_support::SimulateDrive;

constexpr int kScans = 14;

// 1.2 m a scan on a bend of 1.5 degrees a scan; the first scan is already on the move.
const SE3d kMotion = SE3d::Exp((Vec6() << 0, 0, 1.5 * M_PI / 180, 1.2, 0, 0).finished());

const SimulatedDrive& Snapshots() {
  static const SimulatedDrive drive = SimulateDrive(kMotion, kScans);
  return drive;
}
const SimulatedDrive& Skewed() {
  static const SimulatedDrive drive = SimulateDrive(kMotion, kScans, true);
  return drive;
}

OdometryOptions WithDeskewing(Deskewing deskew, OdometryMode mode = OdometryMode::kScanToMap) {
  OdometryOptions options = Options(mode);
  options.deskew = deskew;
  return options;
}

std::vector<FrameResult> Drive(const std::vector<PointCloud>& scans, const OdometryOptions& options,
                               double period_s = 0.1) {
  Odometry odometry(options);
  std::vector<FrameResult> results;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    results.push_back(odometry.Add(scans[i], period_s * static_cast<double>(i)));
  }
  return results;
}

// Root mean square error of the motions, in m.
double DriftM(const std::vector<FrameResult>& results) {
  double sum = 0;
  for (std::size_t i = 1; i < results.size(); ++i) {
    const SE3d motion = results[i - 1].T_world_lidar.Inverse() * results[i].T_world_lidar;
    sum += std::pow(DistanceM(motion, kMotion), 2);
  }
  return std::sqrt(sum / static_cast<double>(results.size() - 1));
}

// At constant velocity all scans are skewed alike: two of them fit, a map of them does less.
TEST(OdometryDeskewing, DriftsAsWithoutSkew) {
  for (const OdometryMode mode : kModes) {
    const double snapshots =
        DriftM(Drive(Snapshots().scans, WithDeskewing(Deskewing::kAuto, mode)));
    const double deskewed = DriftM(Drive(Skewed().scans, WithDeskewing(Deskewing::kAuto, mode)));
    EXPECT_LT(deskewed, 1.5 * snapshots) << static_cast<int>(mode);
    if (mode == OdometryMode::kScanToMap) {
      EXPECT_GT(DriftM(Drive(Skewed().scans, WithDeskewing(Deskewing::kOff))), 1.5 * deskewed);
    }
  }
}

TEST(OdometryDeskewing, ReachesTheTruth) {
  const std::vector<FrameResult> results = Drive(Skewed().scans, WithDeskewing(Deskewing::kOn));
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_TRUE(results[i].deskewed);
    EXPECT_LT(DistanceM(results[i].T_world_lidar, Skewed().T_world_lidar[i]), 0.05) << i;
    EXPECT_LT(AngleDeg(results[i].T_world_lidar, Skewed().T_world_lidar[i]), 0.1) << i;
  }
}

// Point times that span 1 ms a turn, or begin anywhere: made-up times count periods.
TEST(OdometryDeskewing, TakesPointTimesForOnePeriodWhereScansHaveNone) {
  OdometryOptions options = WithDeskewing(Deskewing::kAuto);
  const std::vector<FrameResult> measured = Drive(Skewed().scans, options);
  options.times_are_measured = false;
  std::vector<PointCloud> scans = Skewed().scans;
  for (PointCloud& scan : scans) {
    for (float& time : scan.time_s) {
      time = time * 0.01F;
    }
  }
  const std::vector<FrameResult> counted = Drive(scans, options);
  Odometry without(options);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    EXPECT_LT(DistanceM(counted[i].T_world_lidar, measured[i].T_world_lidar), 0.005) << i;
    EXPECT_LT(DistanceM(without.Add(scans[i]).T_world_lidar, measured[i].T_world_lidar), 0.005);
  }
}

// Driven backwards, time goes backwards in each scan as well.
TEST(OdometryDeskewing, GoesBackwards) {
  std::vector<PointCloud> scans = Skewed().scans;
  std::reverse(scans.begin(), scans.end());
  for (PointCloud& scan : scans) {
    for (float& time : scan.time_s) {
      time = -time;
    }
  }
  const SE3d end = Drive(scans, WithDeskewing(Deskewing::kAuto)).back().T_world_lidar;
  EXPECT_LT(DistanceM(end, Skewed().T_world_lidar.back().Inverse()), 0.05);
}

TEST(OdometryDeskewing, IsReplayedBitForBit) {
  for (const OdometryMode mode : kModes) {
    const OdometryOptions options = WithDeskewing(Deskewing::kAuto, mode);
    const std::vector<PointCloud> scans(Skewed().scans.begin(), Skewed().scans.begin() + 5);
    const std::vector<FrameResult> results = Drive(scans, options);
    for (const std::size_t known : {1, 2, 3}) {
      Odometry resumed(options);
      for (std::size_t i = 0; i < scans.size(); ++i) {
        const double time_s = 0.1 * static_cast<double>(i);
        if (i < known) {
          resumed.Replay(scans[i], results[i], time_s);
        } else {
          EXPECT_EQ(Bits(resumed.Add(scans[i], time_s)), Bits(results[i])) << known << " " << i;
        }
      }
    }
  }
}

TEST(OdometryDeskewing, LeavesSnapshotsAsTheyAre) {
  const std::vector<PointCloud> scans(Snapshots().scans.begin(), Snapshots().scans.begin() + 3);
  EXPECT_EQ(Bits(Drive(scans, WithDeskewing(Deskewing::kAuto))),
            Bits(Drive(scans, WithDeskewing(Deskewing::kOff))));
}

TEST(OdometryDeskewing, RefusesScansThatItCannotMove) {
  Odometry on(WithDeskewing(Deskewing::kOn));
  EXPECT_EQ(MessageOf<InputError>([&] { on.Add(Snapshots().scans[0], 0); }),
            "the points have no times; expected them, as the scan is to be de-skewed.");
  std::vector<PointCloud> scans = {Skewed().scans[0], Skewed().scans[1]};
  for (PointCloud& scan : scans) {
    for (float& time : scan.time_s) {
      time *= 1000;  // Milliseconds.
    }
  }
  EXPECT_NE(MessageOf<InputError>([&] {
              Drive(scans, WithDeskewing(Deskewing::kAuto));
            }).find("s, and the scans are 0.1 s apart; expected seconds."),
            std::string::npos);
}

}  // namespace
}  // namespace icpscape
