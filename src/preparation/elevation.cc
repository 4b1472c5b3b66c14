// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/elevation.h"

#include <cmath>

namespace icpscape {

void CorrectElevation(double angle_deg, PointCloud* cloud) {
  if (angle_deg == 0) {
    return;
  }
  const double angle = angle_deg * M_PI / 180;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    const Vec3 p = cloud->Point(i) - cloud->sensor;
    const double horizontal = std::hypot(p.x(), p.y());
    if (horizontal == 0) {
      continue;
    }
    const double elevation = std::atan2(p.z(), horizontal) + angle;
    const double scale = p.norm() * std::cos(elevation) / horizontal;
    const Vec3& s = cloud->sensor;
    cloud->x[i] = static_cast<float>(s.x() + p.x() * scale);
    cloud->y[i] = static_cast<float>(s.y() + p.y() * scale);
    cloud->z[i] = static_cast<float>(s.z() + p.norm() * std::sin(elevation));
  }
}

}  // namespace icpscape
