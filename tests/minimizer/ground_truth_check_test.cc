// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/ground_truth_check.h"

#include <gtest/gtest.h>

#include "icpscape/cloud/normals.h"
#include "icpscape/io/sequences.h"
#include "tests/support/real_scans.h"

namespace icpscape {
namespace {

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
