// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/random_starts.h"

#include <mutex>
#include <random>

#include "icpscape/cloud/displacement.h"
#include "icpscape/common/parallel.h"
#include "icpscape/objective/source_centroid.h"

namespace icpscape {
namespace {

// std's distributions differ between libraries; the engine does not.
double Uniform(std::mt19937_64* engine) {
  return static_cast<double>((*engine)() >> 11U) * 0x1p-53;
}

Vec3 RandomVector(double longest, std::mt19937_64* engine) {
  const double z = 2 * Uniform(engine) - 1;
  const double angle = 2 * M_PI * Uniform(engine);
  const double length = longest * Uniform(engine);
  const double ring = std::sqrt(1 - z * z);
  return length * Vec3(ring * std::cos(angle), ring * std::sin(angle), z);
}

}  // namespace

std::vector<SE3d> RandomStarts(const SE3d& T_reference, const Vec3& c,
                               const RandomStartOptions& options) {
  std::mt19937_64 engine(options.seed);
  std::vector<SE3d> starts;
  for (int i = 0; i < options.count; ++i) {
    Vec6 xi;
    xi.head<3>() = RandomVector(options.rotation_rad, &engine);
    xi.tail<3>() = RandomVector(options.translation_m, &engine);
    xi.tail<3>() -= xi.head<3>().cross(c);
    for (int axis = 0; axis < 6; ++axis) {
      if (!options.minimizer.free[static_cast<std::size_t>(axis)]) {
        xi[axis] = 0;
      }
    }
    starts.push_back(T_reference * SE3d::Exp(xi));
  }
  return starts;
}

std::vector<StartResult> RunRandomStarts(const LoopFrom& loop, const SE3d& T_reference,
                                         const Vec3& c, const RandomStartOptions& options,
                                         const std::function<void(int)>& progress) {
  const std::vector<SE3d> starts = RandomStarts(T_reference, c, options);
  const auto from_reference = [&](const SE3d& T) {
    return DisplacementAt(c, T_reference.Inverse() * T);
  };
  std::vector<StartResult> results(starts.size());
  MinimizerOptions minimizer = options.minimizer;
  minimizer.threads = 1;  // Parallel over starts.
  std::mutex mutex;
  int done = 0;
  ParallelFor(starts.size(), options.minimizer.threads, [&](std::size_t i) {
    const MinimizerSummary summary = loop(starts[i], minimizer);
    StartResult& result = results[i];
    const Displacement start = from_reference(starts[i]);
    result.start_m = start.m;
    result.start_rad = start.rad;
    result.termination = summary.termination;
    result.end_m = result.end_rad = std::numeric_limits<double>::quiet_NaN();
    if (!summary.iterates.empty()) {
      const Displacement end = from_reference(summary.T_target_source());
      result.end_m = end.m;
      result.end_rad = end.rad;
      result.iterations = static_cast<int>(summary.iterates.size()) - 1;
    }
    result.success = summary.Usable() && result.end_m < kSuccessM && result.end_rad < kSuccessRad;
    if (progress) {
      const std::lock_guard<std::mutex> lock(mutex);
      progress(++done);
    }
  });
  return results;
}

}  // namespace icpscape
