// SPDX-License-Identifier: BSD-3-Clause
// Evaluates objective functions of two clouds along the path from the identity (u = 0) to the true
// motion (u = 1).
#include <cmath>
#include <cstdio>

#include <icpscape/api/landscape.h>
#include "corner.h"

int main() {
  using namespace icpscape;
  const Corner corner;

  LandscapeOptions options;
  options.metrics = {"point_to_point", "point_to_plane"};
  options.curve.samples = 31;  // u = -1, -0.9, ..., 2.
  const LandscapeResult landscape =
      Landscape(corner.source, corner.target, corner.T_truth, options);

  // A table for any plotting program.
  std::printf("metric,u,rmse_m,cost,slope\n");
  for (const Curve& curve : landscape.curves) {
    for (const CurvePoint& point : curve.points) {
      std::printf("%s,%g,%g,%g,%g\n", curve.metric.c_str(), point.u, point.rmse, point.cost,
                  point.slope_analytic);
    }
  }

  // Where is the lowest point, and how far from the truth in metres?
  const double motion_m = corner.T_truth.t().norm();
  bool near = true;
  for (const Curve& curve : landscape.curves) {
    const double u = curve.Minimum().u;
    std::printf("%s: lowest at u = %g, %.3f m from the truth\n", curve.metric.c_str(), u,
                std::abs(u - 1) * motion_m);
    near = near && std::abs(u - 1) < 0.3;
  }
  return near ? 0 : 1;
}
