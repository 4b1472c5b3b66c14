// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_SCENES_H_
#define ICPSCAPE_TESTS_SUPPORT_SCENES_H_

#include <cmath>
#include <random>
#include <utility>

#include "icpscape/preparation/prepared_scan.h"
#include "icpscape/residuals/correspondence.h"

namespace icpscape::testing_support {

inline void AddPoint(const Vec3& p, PointCloud* cloud) {
  cloud->x.push_back(static_cast<float>(p.x()));
  cloud->y.push_back(static_cast<float>(p.y()));
  cloud->z.push_back(static_cast<float>(p.z()));
}

/// A closed room of 20 x 12 x 4 m with a pillar, seen from near its middle: planes in every
/// direction, so that all six degrees of freedom are fixed. Points are random on the surfaces;
/// `T_sensor_room` places the sensor.
inline PointCloud Room(int points, unsigned seed, const SE3d& T_sensor_room = SE3d(),
                       double noise_m = 0) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    const double a = unit(engine), b = unit(engine);
    Vec3 p;
    switch (i % 7) {
      case 0:
        p = {-10, 12 * a - 6, 4 * b - 2};
        break;
      case 1:
        p = {10, 12 * a - 6, 4 * b - 2};
        break;
      case 2:
        p = {20 * a - 10, -6, 4 * b - 2};
        break;
      case 3:
        p = {20 * a - 10, 6, 4 * b - 2};
        break;
      case 4:
        p = {20 * a - 10, 12 * b - 6, -2};
        break;
      case 5:
        p = {20 * a - 10, 12 * b - 6, 2};
        break;
      default:  // The pillar, half a metre thick.
        p = {4 + 0.25 * std::cos(2 * M_PI * a), 3 + 0.25 * std::sin(2 * M_PI * a), 4 * b - 2};
    }
    p += noise_m * Vec3(normal(engine), normal(engine), normal(engine));
    AddPoint(T_sensor_room * p, &cloud);
  }
  return cloud;
}

/// Adds all that a metric can need of a cloud.
inline void Complete(PointCloud* cloud) {
  constexpr unsigned kNeeds = NeedsFrom(Origin::kSourceCloud) | NeedsFrom(Origin::kTargetCloud);
  *cloud = Prepare(std::move(*cloud), kNeeds, {}, 2).cloud();
}

/// The room seen from two places: T_target_source is `motion`. Both clouds are complete.
struct MovedRoom {
  PointCloud target;
  PointCloud source;

  MovedRoom(int points, const SE3d& motion)
      : target(Room(points, 1, SE3d(), 0.005)), source(Room(points, 2, motion.Inverse(), 0.005)) {
    Complete(&target);
    Complete(&source);
  }
};

/// A random cloud in a cube, with some exact duplicates and a lattice that makes exact ties.
inline PointCloud CloudWithTies(int points, unsigned seed) {
  std::mt19937 engine(seed);
  std::uniform_int_distribution<int> lattice(-6, 6);
  PointCloud cloud;
  for (int i = 0; i < points; ++i) {
    AddPoint(0.5 * Vec3(lattice(engine), lattice(engine), lattice(engine)), &cloud);
  }
  return cloud;
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_SCENES_H_
