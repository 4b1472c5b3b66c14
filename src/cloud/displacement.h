// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_DISPLACEMENT_H_
#define ICPSCAPE_SRC_CLOUD_DISPLACEMENT_H_

#include "icpscape/cloud/point_cloud.h"

namespace icpscape {

/// How far a motion takes a point, and by what angle it turns.
struct Displacement {
  double m = 0;
  double rad = 0;
};

/// |dT c - c| and the angle of dT. About the centroid c of a cloud this says how far the cloud
/// moves, wherever the origin of its frame is; the length of dT's translation is that of the
/// origin, which may lie far away.
Displacement DisplacementAt(const Vec3& c, const SE3d& dT);

/// How far the sensor went, and turned, from the target to the source: |T s_source - s_target| with
/// PointCloud::sensor s of each. Clouds far from the user's origin are scans in one frame that the
/// sensor moved through, and where it was is seldom known: for these it is how far the pose takes
/// s_source, in the coordinates of the user.
Displacement MotionOfSensor(const PointCloud& source, const PointCloud& target,
                            const SE3d& T_target_source);

/// The matrix that makes [L omega; v + omega x c] of a small motion [omega; v]: the velocity of the
/// point c instead of that of the origin, and rotations as lengths at a lever arm of L (m).
Mat6 AboutPoint(const Vec3& c, double lever_m);

/// The mean of the points; (0, 0, 0) where there is none.
Vec3 CentroidOf(const PointCloud& cloud);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_DISPLACEMENT_H_
