// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_TESTS_SUPPORT_FAR_CLOUDS_H_
#define ICPSCAPE_TESTS_SUPPORT_FAR_CLOUDS_H_

#include <random>
#include <string>

#include "icpscape/cloud/point_cloud.h"
#include "tests/support/point_file_writer.h"

namespace icpscape::testing_support {

/// The cloud moved by T in double, as the text of a PLY file of doubles.
inline std::string MovedAsPly(const PointCloud& cloud, const SE3d& T) {
  return PlyFile(
      {{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}}, static_cast<int>(cloud.size()),
      [&](const TestField& field, int i, int) {
        return (T * cloud.Point(static_cast<std::size_t>(i)))[field.name[0] - 'x'];
      },
      "binary_little_endian");
}

/// A motion by 1000 km in a random direction, turned at random.
inline SE3d FarAway(unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vec3(normal(engine), normal(engine), normal(engine)); };
  const Eigen::Vector4d q = Eigen::Vector4d(vector().x(), vector().x(), vector().x(), vector().x());
  const Mat3 R = Eigen::Quaterniond(q.normalized()).toRotationMatrix();
  return SE3d(R, 1e6 * vector().normalized());
}

inline Vec3 CentroidOf(const PointCloud& cloud) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    sum += cloud.Point(i);
  }
  return sum / static_cast<double>(cloud.size());
}

}  // namespace icpscape::testing_support

#endif  // ICPSCAPE_TESTS_SUPPORT_FAR_CLOUDS_H_
