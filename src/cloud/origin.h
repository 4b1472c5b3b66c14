// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_ORIGIN_H_
#define ICPSCAPE_SRC_CLOUD_ORIGIN_H_

#include <cstddef>
#include <vector>

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// A float has steps of 0.06 mm here, and of half a metre at 5000 km. The coordinates of a cloud
/// whose middle lies farther out along an axis have its middle taken out; see PointCloud::origin.
inline constexpr double kFarM = 1000;

/// The origin of a cloud with these coordinates (m): 0 where its middle, the median along each
/// axis, is within kFarM of 0 along all three, else its middle, rounded to whole metres.
Vec3 OriginOf(const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& z);

/// Takes the middle out of a cloud that lies far out and has no origin yet. The sensor moves along,
/// unless it is at 0, where it stands for unknown: then it is in the middle.
void TakeOutOrigin(PointCloud* cloud);

/// Drops the points beyond 1000 km of the cloud's origin, along an axis: no scan goes so far, and
/// one such point spoils a fit. Returns how many.
std::size_t DropStrays(PointCloud* cloud);

/// Moves the clouds of a pair to one origin, where the middle of one stays within kFarM of the
/// other's origin; the target's comes first. Coordinates of the user do not change.
void ShareOrigin(PointCloud* source, PointCloud* target);

/// The same cloud with another origin.
void MoveOrigin(const Vec3& origin, PointCloud* cloud);

/// The origins of a pair, between whose frames all computations are, and poses in the coordinates
/// of the user, which are what comes in and goes out:
///   T_user = Trans(target) T Trans(-source).
struct PairOrigins {
  Vec3 source = Vec3::Zero();
  Vec3 target = Vec3::Zero();

  SE3d ToUser(const SE3d& T_target_source) const;
  SE3d FromUser(const SE3d& T_user) const;

 private:
  bool IsZero() const { return source.isZero(0) && target.isZero(0); }
  Vec3 Step(const Mat3& R) const;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_ORIGIN_H_
