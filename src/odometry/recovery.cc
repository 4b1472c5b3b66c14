// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/recovery.h"

#include <cmath>
#include <utility>

#include "icpscape/odometry/thinned.h"

namespace icpscape {
namespace {

// A start needs no more: the whole scan is registered from there.
constexpr std::size_t kPoints = 2000;
constexpr int kTurns = 12;

}  // namespace

std::optional<SE3d> FindStart(const SearchableCloud& source, const SearchableCloud& target,
                              const std::vector<std::string>& metrics,
                              const std::vector<double>& weights, ObjectiveSetOptions objective,
                              MinimizerOptions minimizer, const SE3d& T_predicted,
                              const SE3d& T_still) {
  minimizer.reassociation = Reassociation::kEveryStep;
  objective.matching.max_distance_m = 0;
  objective.loss = nullptr;
  const Registration registration({PreparedScan(Thinned(source, kPoints)), PreparedScan(target)},
                                  metrics, weights, std::move(objective), Preset::kRobust,
                                  minimizer.threads);
  std::vector<SE3d> starts = {T_predicted};
  const Vec3 sensor = source.cloud().sensor;
  for (int i = 0; i < kTurns; ++i) {
    const Mat3 turn = Eigen::AngleAxisd(2 * M_PI * i / kTurns, Vec3::UnitZ()).toRotationMatrix();
    starts.push_back(T_still * SE3d(turn, sensor - turn * sensor));
  }
  std::optional<SE3d> best;
  double shortest_m = 0;
  for (const SE3d& start : starts) {
    const Registered registered = registration.Run(start, minimizer);
    // The gate follows from the median length of the pairs.
    const double gate_m = registered.stages.back().max_distance_m;
    if (registered.summary.Usable() && (!best || gate_m < shortest_m)) {
      best = registered.summary.T_target_source();
      shortest_m = gate_m;
    }
  }
  return best;
}

}  // namespace icpscape
