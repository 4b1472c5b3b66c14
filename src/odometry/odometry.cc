// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/odometry.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "icpscape/cloud/scan_sequence.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/odometry/recovery.h"
#include "icpscape/odometry/thinned.h"
#include "icpscape/preparation/deskew.h"

namespace icpscape {
namespace {

bool AnyFeatures(const std::vector<std::string>& metrics) {
  return std::any_of(metrics.begin(), metrics.end(), NeedsFeatures);
}
bool AnyPoints(const std::vector<std::string>& metrics) {
  return !std::all_of(metrics.begin(), metrics.end(), NeedsFeatures);
}

// Of how many points a registration's verdict is told: a hundredth of a scan, since 13 matching
// passes must not cost more than a tenth of the registration.
constexpr std::size_t kJudgedPoints = 1000;

MetricClouds Thinned(const MetricClouds& clouds, std::size_t most) {
  MetricClouds thinned = clouds;
  for (auto* cloud : {&thinned.points, &thinned.edges, &thinned.planar}) {
    if (*cloud) {
      *cloud = Thinned(**cloud, most);
    }
  }
  return thinned;
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
  MinimizerSummary summary;
  Verdict verdict;
  bool recovered = false;
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
    double gate_m = gate_.MaxDistance_m();
    if (objective.matching.max_distance_m > 0) {
      gate_m = std::min(gate_m, objective.matching.max_distance_m);
    }
    objective.matching.max_distance_m = gate_m;
    objective.line.max_neighbor_distance_m = gate_m;
    objective.patch.max_neighbor_distance_m = gate_m;
  }
  return objective;
}

Odometry::Registration Odometry::Register(const MetricClouds& source, const MetricClouds& target,
                                          const SE3d& T_predicted, const SE3d& T_still) const {
  VerdictOptions judge = options_.verdict;
  judge.minimizer = options_.minimizer;
  judge.minimizer.threads = options_.threads;
  const ObjectiveSet set(source, target, options_.metrics, ObjectiveOptions());
  const JointObjective objective(set.objectives(), options_.weights);
  Registration result;
  result.summary = Minimize(objective, T_predicted, judge.minimizer);
  if (IsLost(result.summary) && !AnyFeatures(options_.metrics)) {
    const std::optional<SE3d> start =
        FindStart(*source.points, *target.points, options_.metrics, options_.weights,
                  options_.objective, judge.minimizer, T_predicted, T_still);
    MinimizerSummary again;
    if (start) {
      again = Minimize(objective, *start, judge.minimizer);
    }
    if (again.Usable() && again.termination != Termination::kMaxIterations && !IsLost(again)) {
      result.summary = std::move(again);
      result.recovered = true;
    }
  }
  const ObjectiveSet few(Thinned(source, kJudgedPoints), target, options_.metrics,
                         ObjectiveOptions());
  result.verdict =
      JudgePose(JointObjective(few.objectives(), options_.weights), result.summary, judge);
  result.T = result.verdict.HasPose()
                 ? result.verdict.WithPrediction(result.summary.T_target_source().Normalized(),
                                                 T_predicted)
                 : T_predicted;
  return result;
}

Odometry::Registration Odometry::Register(const PreparedPair& scans, const SE3d& T_predicted,
                                          const SE3d& T_still) const {
  const auto registered = [&](const PreparedPair& pair) {
    return Register(pair.source.clouds(), pair.target.AsTarget(), T_predicted, T_still);
  };
  if (!options_.filters.Any()) {
    return registered(scans);
  }
  return registered(scans.Select(
      ApplyFilters(scans.source.cloud(), scans.target.cloud(), T_predicted, options_.filters),
      options_.threads));
}

Odometry::Registration Odometry::RegisterToMap(const PreparedScan& source, const SE3d& T_predicted,
                                               FrameResult* result) const {
  const MetricClouds map = map_.ViewFrom(T_world_last_, options_.threads);
  for (const std::optional<SearchableCloud>* cloud : {&map.points, &map.edges, &map.planar}) {
    result->map_points += *cloud ? (*cloud)->cloud().size() : 0;
  }
  if (options_.filters.Any()) {  // Only with closest points; see OdometryOptions::Check.
    return Register({source, PreparedScan(*map.points)}, T_predicted, SE3d());
  }
  return Register(source.clouds(), map, T_predicted, SE3d());
}

bool Odometry::IsLost(const MinimizerSummary& summary) const {
  // An objective that is slow to converge ends at the limit as well, but with pairs as usual. One
  // that converges to a wrong pose is told by its pairs alone.
  const double unusual = summary.termination == Termination::kMaxIterations ? 2 : 5;
  return !summary.Usable() ||
         (usual_rmse_ && summary.iterates.back().rmse > unusual * *usual_rmse_);
}

bool Odometry::MapsNow() const {
  return options_.mode == OdometryMode::kScanToMap ||
         (options_.mode == OdometryMode::kTwoStage && size_ % options_.map_every == 0);
}

PreparedScan Odometry::PrepareOrEmpty(PointCloud scan, const Vec6& velocity) const {
  try {
    return Prepare(std::move(scan), needs_, options_.preparation, options_.threads, velocity);
  } catch (const InputError& error) {
    if (!last_) {
      throw;
    }
    LOG(WARNING) << "frame " << size_ << ": " << error.what();
    return Prepare(PointCloud(), needs_, options_.preparation, options_.threads);
  }
}

SE3d Odometry::PredictedMotion(std::optional<double> time_s) const {
  return options_.constant_velocity ? motion_.Predict(time_s) : SE3d();
}

bool Odometry::IsSkewed(const PointCloud& scan) const {
  if (options_.deskew == Deskewing::kOff || scan.empty()) {
    return false;
  }
  const bool has_times = scan.time_s.size() == scan.size();
  if (!has_times && options_.deskew == Deskewing::kOn) {
    throw InputError("the points have no times; expected them, as the scan is to be de-skewed.");
  }
  return has_times && SweepOf(scan).Duration_s() > 0;
}

Vec6 Odometry::SweepVelocity(const PointCloud& scan, const SE3d& motion, double span_s) const {
  if (!IsSkewed(scan)) {
    return Vec6::Zero();
  }
  const double sweep_s = SweepOf(scan).Duration_s();
  double seconds = sweep_s;  // That the motion took, as the points count them.
  if (!std::isnan(span_s)) {
    seconds = options_.times_are_measured ? span_s : span_s / kScanPeriodS * sweep_s;
  }
  constexpr double kMostSpans = 10;  // Units of time are a thousandfold apart.
  constexpr double kFewestSweeps = 0.01;
  if (sweep_s > kMostSpans * seconds || sweep_s < kFewestSweeps * seconds) {
    throw InputError("the times of the points span " + Number(sweep_s) + " s, and the scans are " +
                     Number(seconds) + " s apart; expected seconds.");
  }
  return motion.Log() / seconds;
}

void Odometry::DeskewFirst(const SE3d& motion, double span_s) {
  last_ = PrepareOrEmpty(*first_, SweepVelocity(*first_, motion, span_s));
  if (options_.mode != OdometryMode::kScanToScan) {
    map_ = LocalMap(options_.map, AnyPoints(options_.metrics), needs_);
    map_.Insert(*last_, T_world_last_, 0);
  }
}

FrameResult Odometry::RegisterNext(const PreparedScan& current,
                                   const SE3d& predicted_motion) const {
  FrameResult result;
  result.points = current.cloud().size();
  if (!last_) {
    return result;
  }
  result.gate_m = ObjectiveOptions().matching.max_distance_m;
  result.motion = predicted_motion;
  SE3d motion = predicted_motion;  // In kTwoStage with the map's correction.
  const auto take_over = [&](const Registration& registration) {
    if (!registration.verdict.HasPose()) {
      LOG(WARNING) << "frame " << size_ << ": " << registration.verdict.no_pose;
    }
    result.registered = result.registered || registration.verdict.HasPose();
    result.termination = registration.summary.termination;
    result.converged = registration.verdict.converged;
    result.recovered = result.recovered || registration.recovered;
    result.predicted_directions = static_cast<int>(registration.verdict.Unobservable().cols());
    result.uncertain_directions =
        static_cast<int>(registration.verdict.undetermined.size()) - result.predicted_directions;
    if (!registration.summary.iterates.empty()) {
      const Iterate& last = registration.summary.iterates.back();
      result.iterations += static_cast<int>(registration.summary.iterates.size()) - 1;
      result.n = last.n;
      result.rmse = last.rmse;
    }
  };
  try {
    if (options_.mode != OdometryMode::kScanToMap) {
      const Registration registration =
          Register({current, *last_}, T_last_previous_ * predicted_motion, T_last_previous_);
      take_over(registration);
      motion = result.motion = T_last_previous_.Inverse() * registration.T;
    }
    if (MapsNow()) {
      const Registration registration = RegisterToMap(current, motion, &result);
      take_over(registration);
      motion = registration.T;
    }
  } catch (const ComputationError& error) {  // A filter or a metric was left without a point.
    LOG(WARNING) << "frame " << size_ << ": " << error.what();
  }
  if (options_.mode == OdometryMode::kScanToMap) {
    result.motion = motion;
  }
  result.T_world_lidar = (T_world_last_ * motion).Normalized();
  return result;
}

FrameResult Odometry::Add(PointCloud scan, std::optional<double> time_s) {
  motion_.Check(time_s);
  const bool is_skewed = IsSkewed(scan);
  const Vec6 velocity = SweepVelocity(scan, motion_.motion(), motion_.span_s());
  FrameResult result;
  const bool has_velocity = size_ == 0 ? !is_skewed : !first_.has_value();
  if (has_velocity) {
    PreparedScan current = PrepareOrEmpty(std::move(scan), velocity);
    result = RegisterNext(current, PredictedMotion(time_s));
    result.deskewed = is_skewed;
    Finish(std::move(current), result, time_s);
    return result;
  }
  const PreparedScan as_it_is = PrepareOrEmpty(scan, velocity);
  result = RegisterNext(as_it_is, PredictedMotion(time_s));
  if (result.registered) {
    const double span_s = motion_.Since(time_s);
    const auto as_they_were = std::pair(last_, map_);
    DeskewFirst(result.motion, span_s);
    result = RegisterNext(PrepareOrEmpty(scan, SweepVelocity(scan, result.motion, span_s)),
                          result.motion);
    if (!result.registered) {  // Then Replay does not de-skew the first either.
      std::tie(last_, map_) = as_they_were;
    }
  }
  result.deskewed = is_skewed;
  Replay(std::move(scan), result, time_s);
  return result;
}

void Odometry::Replay(PointCloud scan, const FrameResult& result, std::optional<double> time_s) {
  motion_.Check(time_s);
  Vec6 velocity = SweepVelocity(scan, motion_.motion(), motion_.span_s());
  if (size_ == 1 && first_ && result.registered) {
    const double span_s = motion_.Since(time_s);
    DeskewFirst(result.motion, span_s);
    velocity = SweepVelocity(scan, result.motion, span_s);
  }
  first_.reset();
  if (size_ == 0 && IsSkewed(scan)) {
    first_ = scan;
  }
  Finish(PrepareOrEmpty(std::move(scan), velocity), result, time_s);
}

void Odometry::Finish(PreparedScan scan, const FrameResult& result, std::optional<double> time_s) {
  if (options_.adaptive_gate_m > 0 && last_) {
    gate_.Add(PredictedMotion(time_s), result.motion);
  }
  // An empty scan is nothing to register to: the next begins anew.
  const bool has_pose = !last_ || last_->cloud().empty() || result.registered;
  if (options_.mode != OdometryMode::kScanToScan && has_pose &&
      (!last_ || last_->cloud().empty() || MapsNow()) &&
      (!last_ || result.termination != Termination::kMaxIterations)) {
    map_.Insert(scan, result.T_world_lidar, size_);
  }
  if (has_pose) {
    last_ = std::move(scan);
    T_last_previous_ = SE3d();
  } else {
    T_last_previous_ = T_last_previous_ * result.motion;
  }
  if (result.registered && result.converged) {
    // It follows where the surroundings change, but not one wrong pose.
    usual_rmse_ = usual_rmse_ ? std::min(result.rmse, 2 * *usual_rmse_) : result.rmse;
  }
  T_world_last_ = result.T_world_lidar;
  motion_.Add(result.motion, time_s);
  ++size_;
}

}  // namespace icpscape
