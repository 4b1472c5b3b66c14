// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_EXAMPLES_CORNER_H_
#define ICPSCAPE_EXAMPLES_CORNER_H_

#include <random>

#include <icpscape/cloud/point_cloud.h>

/// Two scans of a corner of three walls, and the motion between them, as a lidar of your own would
/// give them: fill x, y and z, in metres, with the sensor at the origin.
struct Corner {
  icpscape::PointCloud source, target;
  icpscape::SE3d T_truth;  ///< p_target = T_truth * p_source.

  Corner() {
    icpscape::Vec6 xi;
    xi << 0, 0, 0.02, 0.1, 0.05, 0.02;  // [omega; v]: 0.02 rad about z, and 11 cm.
    T_truth = icpscape::SE3d::Exp(xi);
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> along(-5, 5);
    std::normal_distribution<float> noise(0, 0.005F);
    for (int i = 0; i < 6000; ++i) {
      float p[3] = {along(engine), along(engine), along(engine)};
      p[i % 3] = 5 + noise(engine);
      icpscape::PointCloud& cloud = i % 2 == 0 ? target : source;
      cloud.x.push_back(p[0]);
      cloud.y.push_back(p[1]);
      cloud.z.push_back(p[2]);
    }
    source = source.Transformed(T_truth.Inverse());
  }
};

#endif  // ICPSCAPE_EXAMPLES_CORNER_H_
