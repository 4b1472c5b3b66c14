// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MONTE_CARLO_MONTE_CARLO_H_
#define ICPSCAPE_SRC_MONTE_CARLO_MONTE_CARLO_H_

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/covariance/consistency.h"
#include "icpscape/covariance/registration_uncertainty.h"
#include "icpscape/minimizer/random_starts.h"
#include "icpscape/objective/objective_set.h"
#include "icpscape/simulation/lidar.h"

namespace icpscape {

/// What a draw of the lidar is.
enum class Sensor {
  kFixed,    ///< One lidar: its lasers' constant errors are those of the seed in every draw.
  kRedrawn,  ///< Another copy of the same model in every draw, the same for both scans.
};
template <>
struct Names<Sensor> {
  static constexpr const char* kWhat = "sensor";
  static constexpr const char* kNames[] = {"fixed", "redrawn"};
};

struct MonteCarloOptions {
  std::string scene = "straight_street";
  std::uint64_t seed = 1;  ///< Of the world, the lidar and the draws.
  LidarOptions lidar;
  Sensor sensor = Sensor::kFixed;
  std::vector<std::string> metrics = {"point_to_plane"};
  PreparationOptions preparation;
  ObjectiveSetOptions objective;
  /// One start per draw, turned about the lidar; count, seed and the minimizer's threads are not
  /// used. The minimizer must stop at steps far below the errors that are measured: see
  /// PreciseMinimizer.
  RandomStartOptions start;
  CovarianceOptions covariance;
  int draws = 100;
  int threads = 1;
};

/// One registration of one draw.
struct DrawResult {
  Vec6 error = Vec6::Zero();  ///< Log(T_truth^-1 T), where `termination` is usable.
  Termination termination = Termination::kFailure;
  bool usable = false;
  int iterations = 0;
  /// By Estimator.
  std::array<std::optional<Mat6>, std::size(Names<Estimator>::kNames)> covariances;
};

/// Registers a simulated pair again and again. The world and the motion stay; noise, scan phase
/// (where in a step of its firing angle a scan begins), dropouts and the start pose are drawn anew,
/// and the sensor as `sensor` says. Results by metric, then draw; they do not depend on `threads`.
/// Parallel over draws. `progress` (if any) is called with the number done, one call at a time.
std::vector<std::vector<DrawResult>> RunMonteCarlo(
    const MonteCarloOptions& options, const std::function<void(int)>& progress = nullptr);

/// How one estimator did over the draws that have its covariance.
struct EstimatorCalibration {
  Estimator estimator = Estimator::kGaussNewton;
  long draws = 0;  ///< Fewer than two: the rest is empty.
  Nees about_mean;
  Nees about_truth;
  Vec6 deviation_ratio = Vec6::Zero();  ///< Predicted over actual.
  Mat6 mean_covariance = Mat6::Zero();
};

/// One metric's draws.
struct Calibration {
  ErrorStatistics errors;  ///< About the truth: their mean is the bias.
  long failed = 0;         ///< Draws without a usable result, which are left out.
  /// Draws that ended at the limit of iterations. They count, although the estimators assume a
  /// gradient of zero.
  long unconverged = 0;
  std::vector<EstimatorCalibration> estimators;
};
/// Throws ComputationError where fewer than two draws have a result.
Calibration Calibrate(const std::vector<DrawResult>& draws);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MONTE_CARLO_MONTE_CARLO_H_
