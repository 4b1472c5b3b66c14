// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_LANDSCAPE_PATH_H_
#define ICPSCAPE_SRC_LANDSCAPE_PATH_H_

#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

enum class PathKind {
  /// Translation and rotation interpolated separately, as printed [paper sec. 3.1]:
  ///   t_u = (1 - u) t_0 + u t_1,   R_u = R_0 Exp(u Log(R_0^T R_1)).
  kLerpSlerp,
  /// The geodesic of SE(3), motion with a constant body twist: T_u = T_0 Exp(u Log(T_0^-1 T_1)).
  kGeodesic,
  /// A car with constant speed and steering [bicycle model, suggested in paper sec. 3.1]: the rear
  /// axle's middle runs along an arc tangent to the heading. See Path.
  kBicycle,
};

template <>
struct Names<PathKind> {
  static constexpr const char* kWhat = "path";
  static constexpr const char* kNames[] = {"lerp_slerp", "geodesic", "bicycle"};
};

/// A path of poses T_u through T_0 (u = 0) and T_1 (u = 1), defined for every real u: outside
/// [0, 1] it extrapolates. The shorter way round is taken; R_0^T R_1 must turn by less than pi.
///
/// Where the sensor is at s in the source's frame, the formulas here are those of its poses T S,
/// with S the translation by s: t is the place of the sensor, and the path of the sensor does not
/// change if the origins of both frames are put elsewhere.
///
/// The bicycle, in the sensor's frame at T_0 (x forward, y left, z up): with D = T_0^-1 T_1, psi
/// its yaw, l = kSensorAheadOfRearAxle_m and s the length of the axle's arc, the sensor moves with
/// the constant body twist
///   b = [0, 0, psi; s, psi l, 0],   s = (D_x cos(psi/2) + D_y sin(psi/2)) (psi/2) / sin(psi/2),
/// the axle's chord being along psi/2. The rest of the motion, which no such car can do (z, roll,
/// pitch, side slip), follows as a geodesic, so that T_1 is met exactly:
///   T_u = T_0 Exp(u b) Exp(u e),   e = Log(Exp(b)^-1 D).
/// For the motion of such a car e = 0, and the path is the geodesic. The height of the sensor over
/// the axle changes nothing.
class Path {
 public:
  /// `sensor` is PointCloud::sensor of the source. Throws ComputationError where the two poses are
  /// the same (to 1e-9 m and rad): u then has no meaning.
  Path(const SE3d& T_0, const SE3d& T_1, PathKind kind, const Vec3& sensor = Vec3::Zero());

  SE3d Pose(double u) const { return PoseOfSensor(u) * T_source_sensor_.Inverse(); }

  /// Where the path's pose, or another one, has the sensor: in the target's frame.
  Vec3 PlaceOfSensor(const SE3d& T_target_source) const {
    return T_target_source * T_source_sensor_.t();
  }

  /// xi = [omega; v] with dT_u/du = T_u hat(xi): rad and m per unit of u.
  Vec6 BodyTwist(double u) const;

 private:
  SE3d PoseOfSensor(double u) const;

  PathKind kind_;
  SE3d T_source_sensor_;
  SE3d T_0_;  // Of the sensor, as all that follows.
  SE3d T_1_;
  Vec6 twist_;      // Log(T_0^-1 T_1); for the bicycle b.
  Vec6 remainder_;  // For the bicycle e.
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_LANDSCAPE_PATH_H_
