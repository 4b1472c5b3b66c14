// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/preparation/deskew.h"

#include <algorithm>
#include <cmath>

#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"

namespace icpscape {

Sweep SweepOf(const PointCloud& cloud) {
  const auto& times = cloud.time_s;
  if (times.empty()) {
    return {};
  }
  if (!std::all_of(times.begin(), times.end(), [](float t) { return std::isfinite(t); })) {
    throw InputError("the time of a point is not finite; expected seconds.");
  }
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return {*first, *last};
}

void Deskew(const Vec6& velocity, int threads, PointCloud* cloud) {
  const double instant_s = SweepOf(*cloud).Instant_s();
  ForEachPart(cloud->time_s.size(), threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const SE3d T = SE3d::Exp((cloud->time_s[i] - instant_s) * velocity);
      PointCloud::ForEachKind([&](auto kind) {
        using Kind = decltype(kind);
        if (!cloud->Carries(kind)) {
          return;
        }
        const auto moved =
            Kind::template InFrame<double>(T, cloud->Get(kind, i).template cast<double>());
        for (std::size_t k = 0; k < Kind::kSize; ++k) {
          (cloud->*PointCloud::ArraysOf(kind)[k])[i] =
              static_cast<float>(Kind::template NumberOf<double>(moved, k));
        }
      });
    }
  });
  cloud->time_s.clear();
}

}  // namespace icpscape
