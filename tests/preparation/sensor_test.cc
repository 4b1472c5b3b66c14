// SPDX-License-Identifier: BSD-3-Clause
// What a scan is prepared into does not hang on where the origin of its frame is, as long as the
// cloud says where its sensor was.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "icpscape/cloud/features.h"
#include "icpscape/cloud/rings.h"
#include "icpscape/filtering/voxel_filter.h"
#include "icpscape/preparation/prepared_scan.h"
#include "icpscape/residuals/correspondence.h"
#include "tests/support/drives.h"

namespace icpscape {
namespace {

// On a lattice of a 256th of a metre, so that the shifts here are exact in float.
PointCloud Scan() {
  PointCloud scan = testing_support::TownDrive().scans[0];
  for (std::vector<float>* values : {&scan.x, &scan.y, &scan.z}) {
    for (float& value : *values) {
      value = std::round(256 * value) / 256;
    }
  }
  scan.ring.clear();
  return scan;
}

const SE3d kShift(Mat3::Identity(), Vec3(-448, 272, 32));

TEST(Sensor, IsWhereNormalsLookFrom) {
  PointCloud here = Scan();
  PointCloud far = here.Transformed(kShift);
  EXPECT_EQ(far.sensor, kShift.t());
  EstimateNormals({}, 2, &here);
  EstimateNormals({}, 2, &far);
  std::size_t turned_to_origin = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_LT((far.Normal(i) - here.Normal(i)).norm(), 1e-6) << i;
    turned_to_origin += far.Normal(i).dot(far.Point(i)) <= 0 ? 1 : 0;
  }
  EXPECT_LT(turned_to_origin, here.size());  // The origin would turn some of them around.
}

TEST(Sensor, IsWhatRangesAndAzimuthsAreOf) {
  PointCloud here = Scan();
  PointCloud far = here.Transformed(kShift);
  EXPECT_EQ(RecoverRings(&far), RecoverRings(&here));
  EXPECT_EQ(far.ring, here.ring);
  for (const SmoothnessFormula formula : AllOf<SmoothnessFormula>()) {
    SmoothnessOptions options;
    options.formula = formula;
    const std::vector<double> smoothness = ComputeSmoothness(here, options, 2);
    const std::vector<double> of_far = ComputeSmoothness(far, options, 2);
    for (std::size_t i = 0; i < here.size(); ++i) {
      ASSERT_EQ(std::isnan(of_far[i]), std::isnan(smoothness[i])) << NameOf(formula) << i;
      ASSERT_TRUE(std::isnan(of_far[i]) || of_far[i] == smoothness[i]) << NameOf(formula) << i;
    }
    EXPECT_GT(std::count_if(smoothness.begin(), smoothness.end(), [](double s) { return s > 0; }),
              1000);
  }
}

TEST(Sensor, StaysWithThinnedAndSelectedPoints) {
  const PointCloud far = Scan().Transformed(kShift);
  EXPECT_EQ(VoxelFilter(far, 0.5).sensor, kShift.t());
  EXPECT_EQ(far.Select(std::vector<char>(far.size(), 1)).sensor, kShift.t());
  PreparationOptions options;
  options.voxel_m = 0.25;
  options.elevation_correction_deg = 0.2;
  EXPECT_EQ(Prepare(far, kTargetNormal, options, 2).cloud().sensor, kShift.t());
}

}  // namespace
}  // namespace icpscape
