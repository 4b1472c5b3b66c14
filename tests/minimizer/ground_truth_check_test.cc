// SPDX-License-Identifier: BSD-3-Clause
#include "src/minimizer/ground_truth_check.h"

#include <gtest/gtest.h>

#include "src/cloud/normals.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

TEST(GroundTruthCheck, TellsGoodTruthFromBad) {
  ICPSCAPE_SKIP_WITHOUT_KITTI();
  const std::filesystem::path root = KittiRoot();
  const KittiSequence sequence(root, "00");
  const auto check = [&](int frame) {
    DroppedPoints dropped;
    const PointCloud source = ReadVelodyne(sequence.ScanPath(frame), &dropped);
    PointCloud target = ReadVelodyne(sequence.ScanPath(frame - 1), &dropped);
    EstimateNormals({}, 2, &target);
    return CheckGroundTruth(source, target, sequence.RelativeMotion(frame - 1, frame), 2)
        .translation_m;
  };
  EXPECT_LT(check(95), 0.02);
  EXPECT_GT(check(1), 0.1);
}

}  // namespace
}  // namespace icpscape
