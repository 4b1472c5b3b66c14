// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/landscape/path.h"

#include <cmath>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/common/vehicle.h"

namespace icpscape {
namespace {

// b of the bicycle that comes closest to the motion; see Path.
Vec6 BicycleTwist(const SE3d& motion) {
  const double yaw = std::atan2(motion.R()(1, 0), motion.R()(0, 0));
  const double chord = motion.t().x() * std::cos(yaw / 2) + motion.t().y() * std::sin(yaw / 2);
  const double arc = chord / internal::SinOverAngle(yaw * yaw / 4);
  Vec6 twist;
  twist << 0, 0, yaw, arc, yaw * kSensorAheadOfRearAxle_m, 0;
  return twist;
}

// Of a path, in m and rad.
constexpr double kShortest = 1e-9;

}  // namespace

Path::Path(const SE3d& T_0, const SE3d& T_1, PathKind kind, const Vec3& sensor)
    : kind_(kind),
      T_source_sensor_(Mat3::Identity(), sensor),
      T_0_(T_0 * T_source_sensor_),
      T_1_(T_1 * T_source_sensor_),
      remainder_(Vec6::Zero()) {
  const SE3d motion = T_0_.Inverse() * T_1_;
  if (motion.t().norm() < kShortest && motion.LogRotation().norm() < kShortest) {
    throw ComputationError(
        "the path has no length, so that u has no meaning; expected a start other than the "
        "reference.");
  }
  twist_ = kind == PathKind::kBicycle ? BicycleTwist(motion) : motion.Log();
  if (kind == PathKind::kBicycle) {
    remainder_ = (SE3d::Exp(twist_).Inverse() * motion).Log();
  }
}

SE3d Path::PoseOfSensor(double u) const {
  switch (kind_) {
    case PathKind::kGeodesic:
      return T_0_ * SE3d::Exp(u * twist_);
    case PathKind::kBicycle:
      return T_0_ * SE3d::Exp(u * twist_) * SE3d::Exp(u * remainder_);
    case PathKind::kLerpSlerp:
      break;
  }
  Vec6 rotation = Vec6::Zero();
  rotation.head<3>() = u * twist_.head<3>();
  return SE3d(T_0_.R() * SE3d::Exp(rotation).R(), (1 - u) * T_0_.t() + u * T_1_.t());
}

Vec6 Path::BodyTwist(double u) const {
  Vec6 xi = twist_;
  if (kind_ == PathKind::kLerpSlerp) {
    // omega is constant; the translation's velocity is constant in the target frame.
    xi.tail<3>() = PoseOfSensor(u).R().transpose() * (T_1_.t() - T_0_.t());
  } else if (kind_ == PathKind::kBicycle) {
    // The car's twist as felt behind the remainder, and the remainder's own.
    xi = SE3d::Exp(-u * remainder_).Adjoint() * twist_ + remainder_;
  }
  return T_source_sensor_.Adjoint() * xi;
}

}  // namespace icpscape
