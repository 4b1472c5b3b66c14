// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/ground_truth_check.h"

#include <gtest/gtest.h>

#include "icpscape/cloud/normals.h"
#include "icpscape/common/error.h"
#include "icpscape/io/sequences.h"
#include "tests/minimizer/room.h"
#include "tests/support/message_of.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

using testing_support::DistanceM;
using testing_support::kMotion;

// A truth that is off by 0.2 m and 2 degrees. It takes some iterations until nothing moves, and
// they end at the motion; the distances are those between the two.
TEST(GroundTruthCheck, IteratesUntilNothingMoves) {
  const testing_support::MovedRoom& room = testing_support::RoomOfKMotion();
  const SE3d off = SE3d::Exp((Vec6() << 0, 0, 2 * M_PI / 180, 0.2, 0, 0).finished());
  const GroundTruthCheck check = CheckGroundTruth(room.source, room.target, kMotion * off, 2);
  EXPECT_EQ(check.summary.termination, Termination::kConverged) << check.summary.message;
  EXPECT_GT(check.summary.iterates.size(), 4U);
  EXPECT_LT(DistanceM(kMotion, check.T_refined), 0.003);
  EXPECT_NEAR(check.translation_m, DistanceM(kMotion * off, kMotion), 0.003);
  EXPECT_NEAR(check.rotation_rad, 2 * M_PI / 180, 1e-3);
}

// Of two parallel walls the source sees a copy `beside_m` inside the room: nearer than 1 m it
// pulls, farther away it takes no part.
TEST(GroundTruthCheck, LeavesOutPairsBeyondAMetre) {
  const testing_support::MovedRoom& room = testing_support::RoomOfKMotion();
  const auto moves_m = [&](double beside_m) {
    PointCloud source = room.source;
    for (int i = 0; i < 400; ++i) {
      const Vec3 p(-10 + beside_m, 0.2 * (i % 20) - 2, 0.1 * (i / 20.0) - 1);
      testing_support::AddPoint(kMotion.Inverse() * p, &source);
    }
    source.nx.clear(), source.ny.clear(), source.nz.clear();
    return CheckGroundTruth(source, room.target, kMotion, 2).translation_m;
  };
  EXPECT_GT(moves_m(0.8), 0.05);
  EXPECT_LT(moves_m(1.2), 0.01);
}

TEST(GroundTruthCheck, RefusesWhatHasNoAnswer) {
  const testing_support::MovedRoom& room = testing_support::RoomOfKMotion();
  const SE3d elsewhere(Mat3::Identity(), Vec3(0, 0, 100));
  EXPECT_EQ(testing_support::MessageOf<ComputationError>(
                [&] { CheckGroundTruth(room.source, room.target, elsewhere, 2); }),
            "ground-truth check: No pair of points is left after 0 iterates.");
}

TEST(GroundTruthCheck, TellsGoodTruthFromBad) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const ScanSequence sequence = OpenKittiSequence(KittiRoot(), "00");
  const auto check = [&](int frame) {
    ScanPair pair = sequence.Pair(frame, frame - 1);
    EstimateNormals({}, 2, &pair.target);
    return CheckGroundTruth(pair.source, pair.target, *pair.T_ground_truth, 2).translation_m;
  };
  EXPECT_LT(check(95), 0.02);
  EXPECT_GT(check(1), 0.1);
}

}  // namespace
}  // namespace icpscape
