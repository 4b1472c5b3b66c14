// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/monte_carlo/monte_carlo.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/error.h"
#include "icpscape/common/parallel.h"
#include "icpscape/simulation/scenes.h"
#include "icpscape/simulation/simulator.h"

namespace icpscape {
namespace {

class Experiment {
 public:
  explicit Experiment(const MonteCarloOptions& options)
      : Experiment(options, MakeScene(options.scene, options.seed)) {}

  // By metric.
  std::vector<DrawResult> Draw(int draw) const {
    const PreparedPair scans = PreparePair(Scan(2, draw), Scan(1, draw),
                                           NeedsOf(options_.metrics, options_.objective.matching),
                                           options_.preparation, 1);
    const ObjectiveSet set(scans, options_.metrics, options_.objective);
    std::vector<DrawResult> results;
    for (const Objective& objective : set.objectives()) {
      results.push_back(Register(objective, starts_[static_cast<std::size_t>(draw)]));
    }
    return results;
  }

 private:
  Experiment(const MonteCarloOptions& options, Scene scene)
      : options_(options),
        motions_(MotionsThrough({scene.T_world_lidar.begin(), scene.T_world_lidar.end()})),
        T_truth_(scene.T_target_source()),
        simulator_(std::move(scene.world), options.lidar, options.seed) {
    RandomStartOptions start = options.start;
    start.count = options.draws;
    start.seed = static_cast<unsigned>(options.seed);
    starts_ = RandomStarts(T_truth_, Vec3::Zero(), start);
  }

  // Draw 0 has the scans of SimulatePair.
  PointCloud Scan(int frame, int draw) const {
    const std::uint64_t sensor =
        options_.sensor == Sensor::kRedrawn ? static_cast<std::uint64_t>(draw) : 0;
    return simulator_.Scan(motions_[static_cast<std::size_t>(frame)], (frame - 1) * kScanPeriodS,
                           2 * draw + frame, 1, sensor);
  }

  DrawResult Register(const Objective& objective, const SE3d& T_start) const {
    DrawResult result;
    MinimizerOptions minimizer = options_.start.minimizer;
    minimizer.threads = 1;
    const MinimizerSummary summary = Minimize(objective, T_start, minimizer);
    result.termination = summary.termination;
    result.usable = summary.Usable();
    if (!result.usable) {
      return result;
    }
    const SE3d& T = summary.T_target_source();
    result.iterations = static_cast<int>(summary.iterates.size()) - 1;
    result.error = (T_truth_.Inverse() * T).Log();
    const CovarianceSums sums = SumForCovariance(objective, T, options_.covariance, 1);
    for (const Estimator estimator : AllOf<Estimator>()) {
      result.covariances[static_cast<std::size_t>(estimator)] =
          EstimateCovariance(estimator, sums, options_.covariance);
    }
    return result;
  }

  MonteCarloOptions options_;
  std::vector<LidarMotion> motions_;
  SE3d T_truth_;
  Simulator simulator_;
  std::vector<SE3d> starts_;
};

}  // namespace

std::vector<std::vector<DrawResult>> RunMonteCarlo(const MonteCarloOptions& options,
                                                   const std::function<void(int)>& progress) {
  if (options.draws < 2) {
    throw UsageError("draws=" + std::to_string(options.draws) + ": expected at least 2.");
  }
  options.covariance.Check();
  const Experiment experiment(options);
  std::vector<std::vector<DrawResult>> results(
      options.metrics.size(), std::vector<DrawResult>(static_cast<std::size_t>(options.draws)));
  std::mutex mutex;
  int done = 0;
  ParallelFor(static_cast<std::size_t>(options.draws), options.threads, [&](std::size_t draw) {
    const std::vector<DrawResult> of_draw = experiment.Draw(static_cast<int>(draw));
    for (std::size_t m = 0; m < of_draw.size(); ++m) {
      results[m][draw] = of_draw[m];
    }
    const std::lock_guard<std::mutex> lock(mutex);
    ++done;
    if (progress) {
      progress(done);
    }
  });
  return results;
}

Calibration Calibrate(const std::vector<DrawResult>& draws) {
  Calibration calibration;
  std::vector<Vec6> all_errors;
  for (const DrawResult& draw : draws) {
    if (draw.usable) {
      all_errors.push_back(draw.error);
      calibration.unconverged += draw.termination == Termination::kMaxIterations ? 1 : 0;
    } else {
      ++calibration.failed;
    }
  }
  calibration.errors = StatisticsOf(all_errors);
  for (const Estimator estimator : AllOf<Estimator>()) {
    EstimatorCalibration entry;
    entry.estimator = estimator;
    std::vector<Vec6> errors;
    std::vector<Mat6> covariances;
    for (const DrawResult& draw : draws) {
      const auto& covariance = draw.covariances[static_cast<std::size_t>(estimator)];
      if (draw.usable && covariance) {
        errors.push_back(draw.error);
        covariances.push_back(*covariance);
      }
    }
    entry.draws = static_cast<long>(errors.size());
    if (entry.draws >= 2) {
      entry.about_mean = NeesAboutMean(errors, covariances);
      entry.about_truth = NeesAboutTruth(errors, covariances);
      entry.deviation_ratio = DeviationRatio(StatisticsOf(errors), covariances);
      for (const Mat6& covariance : covariances) {
        entry.mean_covariance += covariance / static_cast<double>(entry.draws);
      }
    }
    calibration.estimators.push_back(entry);
  }
  return calibration;
}

}  // namespace icpscape
