// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/local_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace icpscape {
namespace {

using testing::UnorderedElementsAre;

// Points 10 and 19 m ahead, seen from x = 0, 5 and 35 m.
std::vector<float> MapAfterThreeScans(const LocalMapOptions& options) {
  PointCloud ahead;
  testing_support::AddPoint(Vec3(10, 0, 0), &ahead);
  testing_support::AddPoint(Vec3(19, 0, 0), &ahead);
  const PreparedScan scan = Prepare(ahead, 0, {}, 1);
  LocalMap map(options, true, 0);
  int number = 0;
  for (const double x_m : {0.0, 5.0, 35.0}) {
    map.Insert(scan, SE3d(Mat3::Identity(), Vec3(x_m, 0, 0)), number++);
  }
  return map.ViewFrom(SE3d(), 1).points->cloud().x;
}

TEST(LocalMap, KeepsAllWithinItsRadius) {
  EXPECT_THAT(MapAfterThreeScans({0.5, 80, 0}), UnorderedElementsAre(10, 19, 15, 24, 45, 54));
}

// What was seen before is 20 m around x = 35: from 15 m on.
TEST(LocalMap, ForgetsWhatIsLeftBehind) {
  EXPECT_THAT(MapAfterThreeScans({0.5, 20, 0}), UnorderedElementsAre(19, 15, 24, 45, 54));
}

// Of its own scan it takes no more: 19 m ahead is beyond a radius of 18 m.
TEST(LocalMap, TakesNothingBeyondItsRadius) {
  EXPECT_THAT(MapAfterThreeScans({0.5, 18, 0}), UnorderedElementsAre(45));
}

TEST(LocalMap, ForgetsOldScans) {
  EXPECT_THAT(MapAfterThreeScans({0.5, 80, 2}), UnorderedElementsAre(15, 24, 45, 54));
  EXPECT_THAT(MapAfterThreeScans({0.5, 80, 1}), UnorderedElementsAre(45, 54));
}

}  // namespace
}  // namespace icpscape
