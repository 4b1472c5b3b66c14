// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_MINIMIZER_ROOM_H_
#define ICPSCAPE_TESTS_MINIMIZER_ROOM_H_

#include <gtest/gtest.h>

#include "icpscape/cloud/displacement.h"
#include "icpscape/minimizer/minimizer.h"
#include "tests/support/named.h"
#include "tests/support/scenes.h"

namespace icpscape::testing_support {

inline const SE3d kMotion = SE3d::Exp((Vec6() << 0.01, -0.005, 0.05, 0.3, 0.05, -0.02).finished());

/// A room seen before and after kMotion.
inline const MovedRoom& RoomOfKMotion() {
  static const MovedRoom room(8000, kMotion);
  return room;
}

/// How far apart the two poses take the middle of the source.
inline double DistanceM(const SE3d& a, const SE3d& b) {
  static const Vec3 middle = CentroidOf(RoomOfKMotion().source);
  return (a * middle - b * middle).norm();
}
inline double AngleRad(const SE3d& a, const SE3d& b) {
  return (a.Inverse() * b).LogRotation().norm();
}

/// Tests of both ways to re-associate; INSTANTIATE_TEST_SUITE_P(Minimizer, ..., EachMode(),
/// testing::PrintToStringParamName()).
class BothModes : public testing::TestWithParam<Named<Reassociation>> {
 protected:
  static Reassociation Mode() { return GetParam().value; }
  static MinimizerOptions Options() {
    MinimizerOptions options;
    options.reassociation = Mode();
    options.threads = 2;
    return options;
  }
};

inline auto EachMode() {
  return testing::Values(Named<Reassociation>{"EveryStep", Reassociation::kEveryStep},
                         Named<Reassociation>{"EveryEvaluation", Reassociation::kEveryEvaluation});
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_MINIMIZER_ROOM_H_
