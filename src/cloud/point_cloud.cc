// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/cloud/point_cloud.h"

#include "icpscape/cloud/usable_point.h"

namespace icpscape {
namespace {

template <class T>
void SelectArray(const std::vector<T>& in, const std::vector<char>& keep, std::vector<T>* out) {
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (keep[i] != 0) {
      out->push_back(in[i]);
    }
  }
}

}  // namespace

PointCloud PointCloud::Select(const std::vector<char>& keep) const {
  PointCloud out;
  ForEachKind([&](auto kind) {
    for (const Array array : ArraysOf(kind)) {
      SelectArray(this->*array, keep, &(out.*array));
    }
  });
  SelectArray(intensity, keep, &out.intensity);
  SelectArray(ring, keep, &out.ring);
  SelectArray(label, keep, &out.label);
  SelectArray(time_s, keep, &out.time_s);
  out.sensor = sensor;
  out.origin = origin;
  return out;
}

PointCloud PointCloud::Transformed(const SE3d& T_other_this) const {
  PointCloud out = *this;
  out.sensor = T_other_this * sensor;
  ForEachKind([&](auto kind) {
    using Kind = decltype(kind);
    const auto arrays = ArraysOf(kind);
    for (std::size_t i = 0; i < (this->*arrays[0]).size(); ++i) {
      const auto value =
          Kind::template InFrame<double>(T_other_this, Get(kind, i).template cast<double>());
      for (std::size_t k = 0; k < Kind::kSize; ++k) {
        (out.*arrays[k])[i] = static_cast<float>(Kind::template NumberOf<double>(value, k));
      }
    }
  });
  return out;
}

DroppedPoints DropInvalidPoints(PointCloud* cloud) {
  DroppedPoints dropped;
  std::vector<char> keep(cloud->size());
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    keep[i] = IsUsable(cloud->x[i], cloud->y[i], cloud->z[i], &dropped) ? 1 : 0;
  }
  if (dropped.non_finite + dropped.zero > 0) {
    *cloud = cloud->Select(keep);
  }
  return dropped;
}

}  // namespace icpscape
