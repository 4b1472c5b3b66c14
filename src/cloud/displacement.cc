// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/displacement.h"

namespace icpscape {

Displacement DisplacementAt(const Vec3& c, const SE3d& dT) {
  return {(dT * c - c).norm(), dT.LogRotation().norm()};
}

Displacement MotionOfSensor(const PointCloud& source, const PointCloud& target,
                            const SE3d& T_target_source) {
  const bool far = !source.origin.isZero(0) || !target.origin.isZero(0);
  const Vec3 from = far ? Vec3(source.sensor + (source.origin - target.origin)) : target.sensor;
  return {(T_target_source * source.sensor - from).norm(), T_target_source.LogRotation().norm()};
}

Mat6 AboutPoint(const Vec3& c, double lever_m) {
  Mat6 about = Mat6::Identity();
  about.topLeftCorner<3, 3>() *= lever_m;
  about.bottomLeftCorner<3, 3>() = -Skew<double>(c);
  return about;
}

Vec3 CentroidOf(const PointCloud& cloud) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sum += cloud.Point(i);
  }
  return cloud.empty() ? sum : Vec3(sum / static_cast<double>(cloud.size()));
}

}  // namespace icpscape
