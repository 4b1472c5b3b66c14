// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/rings.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "icpscape/common/error.h"

namespace icpscape {
namespace {

constexpr double kTurn = 2 * M_PI;
constexpr double kLongestStepBack = M_PI / 9;  // 20 degrees.
constexpr int kMostRings = 128;                // No spinning lidar has more.

// About the sensor, counter-clockwise from the x axis, [0, 2 pi).
double Azimuth(const PointCloud& cloud, std::size_t i) {
  const double angle = std::atan2(static_cast<float>(cloud.y[i] - cloud.sensor.y()),
                                  static_cast<float>(cloud.x[i] - cloud.sensor.x()));
  return angle < 0 ? angle + kTurn : angle;
}

}  // namespace

int RecoverRings(PointCloud* cloud) {
  if (cloud->empty()) {
    return 0;
  }
  if (cloud->ring.size() == cloud->size()) {
    return 1 + *std::max_element(cloud->ring.begin(), cloud->ring.end());
  }
  std::vector<std::int32_t> ring(cloud->size(), 0);
  int current = 0;
  int last = 0;
  double previous = Azimuth(*cloud, 0);
  for (std::size_t i = 1; i < cloud->size(); ++i) {
    const double azimuth = Azimuth(*cloud, i);
    const double step = azimuth - previous;
    if (step < -kLongestStepBack) {
      ++current;
    } else if (step > kTurn - kLongestStepBack && current > 0) {
      --current;  // A small step back across the seam.
    }
    ring[i] = current;
    last = std::max(last, current);
    previous = azimuth;
  }
  const int rings = last + 1;
  if (rings < 2 || rings > kMostRings) {
    throw InputError("the points form " + std::to_string(rings) +
                     (rings == 1 ? " ring" : " rings") + " by their azimuth; expected 2 to " +
                     std::to_string(kMostRings) + ", stored ring by ring as in KITTI's files.");
  }
  cloud->ring = std::move(ring);
  return rings;
}

std::vector<std::vector<std::int32_t>> PointsByRing(const PointCloud& cloud) {
  if (cloud.ring.size() != cloud.size()) {
    throw InputError("the cloud has no rings; expected a ring number for each of its " +
                     std::to_string(cloud.size()) + " points.");
  }
  std::vector<std::vector<std::int32_t>> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (cloud.ring[i] < 0) {
      throw InputError("point " + std::to_string(i) + " has ring " + std::to_string(cloud.ring[i]) +
                       "; expected 0 or more.");
    }
    const auto ring = static_cast<std::size_t>(cloud.ring[i]);
    if (ring >= points.size()) {
      points.resize(ring + 1);
    }
    points[ring].push_back(static_cast<std::int32_t>(i));
  }
  return points;
}

}  // namespace icpscape
