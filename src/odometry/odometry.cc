// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/odometry.h"

#include <glog/logging.h>

#include <algorithm>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

bool AnyFeatures(const std::vector<std::string>& metrics) {
  return std::any_of(metrics.begin(), metrics.end(), NeedsFeatures);
}
bool AnyPoints(const std::vector<std::string>& metrics) {
  return !std::all_of(metrics.begin(), metrics.end(), NeedsFeatures);
}

}  // namespace

void OdometryOptions::Check() const {
  if (!weights.empty() && weights.size() != metrics.size()) {
    throw UsageError(std::to_string(weights.size()) + " weights for " +
                     std::to_string(metrics.size()) + " metrics; expected one for each, or none.");
  }
  if (map_every < 1) {
    throw UsageError("map_every is " + std::to_string(map_every) + "; expected at least 1.");
  }
  if (adaptive_gate_m > 0 && minimizer.reassociation == Reassociation::kEveryEvaluation) {
    throw UsageError(
        "the adaptive gate rejects pairs, and every_evaluation compares sums over all of them: "
        "expected every_step, or no adaptive gate.");
  }
  if (mode != OdometryMode::kScanToScan && filters.Any() && AnyFeatures(metrics)) {
    throw UsageError(
        "filters compare two scans, but edges and planar points are matched to maps; expected no "
        "filter, scan_to_scan, or metrics of closest points.");
  }
}

// A stage's outcome: T_target_source and how it came about.
struct Odometry::Registration {
  SE3d T;
  bool usable = false;
  Termination termination = Termination::kFailure;
  std::string message;
  int iterations = 0;
  long n = 0;
  double rmse = 0;

  void Run(const ObjectiveSet& set, const SE3d& T_start, const OdometryOptions& options) {
    MinimizerOptions minimizer = options.minimizer;
    minimizer.threads = options.threads;
    const MinimizerSummary summary =
        Minimize(JointObjective(set.objectives(), options.weights), T_start, minimizer);
    usable = summary.Usable();
    termination = summary.termination;
    message = summary.message;
    T = usable ? summary.T_target_source().Normalized() : T_start;
    if (!summary.iterates.empty()) {
      iterations = static_cast<int>(summary.iterates.size()) - 1;
      n = summary.iterates.back().n;
      rmse = summary.iterates.back().rmse;
    }
  }
};

Odometry::Odometry(OdometryOptions options)
    : options_(std::move(options)),
      needs_(NeedsOf(options_.metrics, options_.objective.matching)),
      gate_(options_.adaptive_gate_m),
      map_(options_.map, AnyPoints(options_.metrics), needs_) {
  options_.Check();
}

Odometry::~Odometry() = default;

ObjectiveSetOptions Odometry::ObjectiveOptions() const {
  ObjectiveSetOptions objective = options_.objective;
  if (options_.adaptive_gate_m > 0) {
    const double gate_m = gate_.MaxDistance_m();
    objective.matching.max_distance_m = gate_m;
    objective.line.max_neighbor_distance_m = gate_m;
    objective.patch.max_neighbor_distance_m = gate_m;
  }
  return objective;
}

Odometry::Registration Odometry::Register(const PreparedPair& scans,
                                          const SE3d& T_predicted) const {
  Registration registration;
  const auto run = [&](const PreparedPair& pair) {
    registration.Run(ObjectiveSet(pair, options_.metrics, ObjectiveOptions()), T_predicted,
                     options_);
  };
  if (options_.filters.Any()) {
    run(scans.Select(
        ApplyFilters(scans.source.cloud(), scans.target.cloud(), T_predicted, options_.filters),
        options_.threads));
  } else {
    run(scans);
  }
  return registration;
}

Odometry::Registration Odometry::RegisterToMap(const PreparedScan& source, const SE3d& T_predicted,
                                               FrameResult* result) const {
  const MetricClouds map = map_.ViewFrom(T_world_last_, options_.threads);
  for (const std::optional<SearchableCloud>* cloud : {&map.points, &map.edges, &map.planar}) {
    result->map_points += *cloud ? (*cloud)->cloud().size() : 0;
  }
  if (options_.filters.Any()) {  // Only with closest points; see OdometryOptions::Check.
    return Register({source, PreparedScan(*map.points)}, T_predicted);
  }
  Registration registration;
  registration.Run(ObjectiveSet(source.clouds(), map, options_.metrics, ObjectiveOptions()),
                   T_predicted, options_);
  return registration;
}

bool Odometry::MapsNow() const {
  return options_.mode == OdometryMode::kScanToMap ||
         (options_.mode == OdometryMode::kTwoStage && size_ % options_.map_every == 0);
}

PreparedScan Odometry::PrepareOrEmpty(PointCloud scan) const {
  try {
    return Prepare(std::move(scan), needs_, options_.preparation, options_.threads);
  } catch (const InputError& error) {
    if (!last_) {
      throw;
    }
    LOG(WARNING) << "frame " << size_ << ": " << error.what();
    return Prepare(PointCloud(), needs_, options_.preparation, options_.threads);
  }
}

FrameResult Odometry::Add(PointCloud scan) {
  PreparedScan current = PrepareOrEmpty(std::move(scan));
  FrameResult result;
  result.points = current.cloud().size();
  if (last_) {
    const SE3d T_predicted = options_.constant_velocity ? motion_ : SE3d();
    result.gate_m = ObjectiveOptions().matching.max_distance_m;
    result.motion = T_predicted;
    SE3d T_last_current = T_predicted;
    const auto take_over = [&](const Registration& registration) {
      if (!registration.usable) {
        LOG(WARNING) << "frame " << size_ << ": " << registration.message;
      }
      result.registered = result.registered || registration.usable;
      result.termination = registration.termination;
      result.iterations += registration.iterations;
      result.n = registration.n;
      result.rmse = registration.rmse;
      T_last_current = registration.T;
    };
    try {
      if (options_.mode != OdometryMode::kScanToMap) {
        take_over(Register({current, *last_}, T_predicted));
        result.motion = T_last_current;
      }
      if (MapsNow()) {
        take_over(RegisterToMap(current, T_last_current, &result));
      }
    } catch (const ComputationError& error) {  // A filter or a metric was left without a point.
      LOG(WARNING) << "frame " << size_ << ": " << error.what();
    }
    if (options_.mode == OdometryMode::kScanToMap) {
      result.motion = T_last_current;
    }
    result.T_world_lidar = (T_world_last_ * T_last_current).Normalized();
  }
  Finish(std::move(current), result);
  return result;
}

void Odometry::Replay(PointCloud scan, const FrameResult& result) {
  Finish(PrepareOrEmpty(std::move(scan)), result);
}

void Odometry::Finish(PreparedScan scan, const FrameResult& result) {
  if (options_.adaptive_gate_m > 0 && last_) {
    gate_.Add(options_.constant_velocity ? motion_ : SE3d(), result.motion);
  }
  if (options_.mode != OdometryMode::kScanToScan && (!last_ || MapsNow())) {
    map_.Insert(scan, result.T_world_lidar, size_);
  }
  last_ = std::move(scan);
  T_world_last_ = result.T_world_lidar;
  motion_ = result.motion;
  ++size_;
}

}  // namespace icpscape
