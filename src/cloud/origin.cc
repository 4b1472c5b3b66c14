// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/origin.h"

#include <algorithm>
#include <cmath>

namespace icpscape {
namespace {

bool IsFar(double value) { return std::abs(value) > kFarM; }

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.empty() ? 0 : *middle;
}

std::vector<double> Doubles(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

// In the coordinates of the user.
Vec3 MiddleOf(const PointCloud& cloud) {
  return cloud.origin +
         Vec3(Median(Doubles(cloud.x)), Median(Doubles(cloud.y)), Median(Doubles(cloud.z)));
}

bool IsWithinReach(const PointCloud& cloud, const Vec3& origin) {
  return (MiddleOf(cloud) - origin).cwiseAbs().maxCoeff() <= kFarM;
}

}  // namespace

Vec3 OriginOf(const std::vector<double>& x, const std::vector<double>& y,
              const std::vector<double>& z) {
  const auto has_far = [](const std::vector<double>& values) {
    return std::any_of(values.begin(), values.end(), IsFar);
  };
  if (!has_far(x) && !has_far(y) && !has_far(z)) {
    return Vec3::Zero();
  }
  const Vec3 middle(Median(x), Median(y), Median(z));
  if (middle.cwiseAbs().maxCoeff() <= kFarM) {
    return Vec3::Zero();
  }
  return {std::round(middle.x()), std::round(middle.y()), std::round(middle.z())};
}

void MoveOrigin(const Vec3& origin, PointCloud* cloud) {
  const Vec3 step = cloud->origin - origin;
  if (step.isZero(0)) {
    return;
  }
  const auto move = [](double by, std::vector<float>* values) {
    for (float& value : *values) {
      value = static_cast<float>(value + by);
    }
  };
  move(step.x(), &cloud->x);
  move(step.y(), &cloud->y);
  move(step.z(), &cloud->z);
  cloud->sensor += step;
  cloud->origin = origin;
}

void TakeOutOrigin(PointCloud* cloud) {
  if (!cloud->origin.isZero(0)) {
    return;
  }
  const Vec3 origin = OriginOf(Doubles(cloud->x), Doubles(cloud->y), Doubles(cloud->z));
  const bool knows_sensor = !cloud->sensor.isZero(0);
  MoveOrigin(origin, cloud);
  if (!knows_sensor) {
    cloud->sensor = Vec3::Zero();
  }
}

std::size_t DropStrays(PointCloud* cloud) {
  constexpr float kStrayM = 1e6F;
  std::vector<char> keep(cloud->size());
  std::size_t dropped = 0;
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    keep[i] =
        std::max({std::abs(cloud->x[i]), std::abs(cloud->y[i]), std::abs(cloud->z[i])}) <= kStrayM;
    dropped += keep[i] == 0 ? 1 : 0;
  }
  if (dropped > 0) {
    *cloud = cloud->Select(keep);
  }
  return dropped;
}

void ShareOrigin(PointCloud* source, PointCloud* target) {
  if (source->origin == target->origin) {
    return;
  }
  if (IsWithinReach(*source, target->origin)) {
    MoveOrigin(target->origin, source);
  } else if (IsWithinReach(*target, source->origin)) {
    MoveOrigin(source->origin, target);
  }
}

Vec3 PairOrigins::Step(const Mat3& R) const { return target - R * source; }

// Not a sum with 0 where nothing was taken out: -0 stays what it is.
SE3d PairOrigins::ToUser(const SE3d& T) const {
  return IsZero() ? T : SE3d(T.R(), T.t() + Step(T.R()));
}

SE3d PairOrigins::FromUser(const SE3d& T) const {
  return IsZero() ? T : SE3d(T.R(), T.t() - Step(T.R()));
}

}  // namespace icpscape
