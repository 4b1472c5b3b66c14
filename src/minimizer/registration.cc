// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/minimizer/registration.h"

#include <ceres/cost_function.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "icpscape/common/error.h"
#include "icpscape/objective/loss.h"
#include "icpscape/objective/pairs.h"

namespace icpscape {
namespace {

// Enough that a thinned loop ends where the whole one would, and a fraction of a full lidar scan.
constexpr std::size_t kThinnedPoints = 20000;
// The standard deviation of a normal distribution from the median of absolute values.
constexpr double kSigmaOfMedian = 1.4826;
constexpr double kGateSigmas = 4;
constexpr double kWorthShrinking = 0.8;
constexpr int kMostGates = 10;
// Huber's constant: 95 % efficiency under normal errors.
constexpr double kHuberSigmas = 1.345;
// Steps of the thinned loops end at this multiple of the stop rule.
constexpr double kCoarseStop = 10;
// MakeLoss takes no smaller scale. A fit as good needs no loss.
constexpr double kSmallestLossScale = 1e-6;

double Median(std::vector<double> values) {
  if (values.empty()) {
    return 0;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

PreparedPair Thinned(const PreparedPair& scans, int threads) {
  const std::size_t size = scans.source.cloud().size();
  if (size <= kThinnedPoints) {
    return scans;
  }
  std::vector<char> keep(size, 0);
  for (std::size_t i = 0; i < kThinnedPoints; ++i) {
    keep[i * size / kThinnedPoints] = 1;
  }
  return {scans.source.Select(keep, threads), scans.target};
}

// Of all source points to their closest target points.
double MedianDistance(const PreparedPair& scans, const SE3d& T, int threads) {
  const ClosestPointMatcher matcher(*scans.source.clouds().points, *scans.target.AsTarget().points);
  Matches matches;
  matcher.Match(T, threads, &matches);
  std::vector<double> distances;
  for (std::size_t i = 0; i < matches.target_index.size(); ++i) {
    if (matches.target_index[i] >= 0) {
      const auto j = static_cast<std::size_t>(matches.target_index[i]);
      distances.push_back(
          (T * scans.source.cloud().Point(i) - scans.target.cloud().Point(j)).norm());
    }
  }
  return Median(std::move(distances));
}

double MedianResidual(const Objective& objective, const SE3d& T, int threads) {
  double x[7];
  T.ToParameters(x);
  const double* const parameters[] = {x};
  std::vector<double> residuals, lengths;
  ForEachPair(objective, objective.Match(T, threads),
              [&](std::size_t, std::size_t, const Correspondence& pair) {
                const std::unique_ptr<ceres::CostFunction> cost(objective.metric().make_cost(pair));
                residuals.resize(static_cast<std::size_t>(cost->num_residuals()));
                cost->Evaluate(parameters, residuals.data(), nullptr);
                lengths.push_back(Eigen::Map<const Eigen::VectorXd>(
                                      residuals.data(), static_cast<Eigen::Index>(residuals.size()))
                                      .norm());
              });
  return Median(std::move(lengths));
}

JointObjective WithHuber(const ObjectiveSet& set, const std::vector<double>& weights,
                         const std::vector<double>& scales) {
  std::vector<Objective> objectives;
  for (std::size_t k = 0; k < scales.size(); ++k) {
    const Objective& plain = set.objectives()[k];
    objectives.emplace_back(
        plain.metric(), plain.matcher(),
        scales[k] > kSmallestLossScale ? MakeLoss("huber", scales[k]) : nullptr);
  }
  return {std::move(objectives), weights};
}

// What a gate would be for these pairs; 0 where more than half of them fit exactly.
double GateAt(const PreparedPair& scans, const SE3d& T, int threads) {
  return kGateSigmas * kSigmaOfMedian * MedianDistance(scans, T, threads);
}

// Whether a further stage makes sense: nobody asked it to end here.
bool GoesOn(const MinimizerSummary& summary) {
  return summary.Usable() && summary.termination != Termination::kStopped &&
         summary.termination != Termination::kCostReached;
}

// Goes on from what was found so far.
void Append(Registered* done, Registered next) {
  std::vector<Iterate>& iterates = done->summary.iterates;
  next.stages.front().first_iterate = iterates.size();
  const double time_s = iterates.back().time_s;
  for (Iterate& iterate : next.summary.iterates) {
    iterate.time_s += time_s;
    iterates.push_back(iterate);
  }
  done->stages.push_back(std::move(next.stages.front()));
  next.summary.iterates = std::move(iterates);
  next.summary.matching_passes += done->summary.matching_passes;
  done->summary = std::move(next.summary);
  done->objective = std::move(next.objective);
  done->set = std::move(next.set);
}

}  // namespace

Registration::Registration(PreparedPair scans, std::vector<std::string> metrics,
                           std::vector<double> weights, ObjectiveSetOptions options, Preset preset,
                           int threads)
    : scans_(std::move(scans)),
      thinned_(preset == Preset::kRobust ? Thinned(scans_, threads) : scans_),
      metrics_(std::move(metrics)),
      weights_(std::move(weights)),
      options_(std::move(options)),
      preset_(preset) {
  if (preset_ == Preset::kRobust) {
    if (options_.matching.max_distance_m > 0 || options_.loss != nullptr) {
      throw UsageError("The preset robust has a gate and a loss of its own; expected none.");
    }
    const auto of_features = std::find_if(metrics_.begin(), metrics_.end(), NeedsFeatures);
    if (of_features != metrics_.end()) {
      throw UsageError(
          "The preset robust shrinks the gate of closest points; expected no metric of "
          "edge or planar points such as " +
          *of_features + ".");
    }
  }
  const ObjectiveSet set(scans_, metrics_, options_);
  const JointObjective check(set.objectives(), weights_);
}

Registered Registration::Run(const SE3d& T_start, const MinimizerOptions& options) const {
  return preset_ == Preset::kPaper ? RunPaper(T_start, options) : RunRobust(T_start, options);
}

Registered Registration::RunPaper(const SE3d& T_start, const MinimizerOptions& options) const {
  auto set = std::make_shared<const ObjectiveSet>(scans_, metrics_, options_);
  JointObjective objective(set->objectives(), weights_);
  MinimizerSummary summary = Minimize(objective, T_start, options);
  return {std::move(set),
          std::move(objective),
          std::move(summary),
          {{0, options_.matching.max_distance_m, {}}}};
}

Registered Registration::RunRobust(const SE3d& T_start, const MinimizerOptions& options) const {
  if (options.reassociation == Reassociation::kEveryEvaluation) {
    throw UsageError("The preset robust leaves pairs out; expected every_step.");
  }
  MinimizerOptions coarse = options;
  coarse.min_step_m *= kCoarseStop;
  coarse.min_step_rad *= kCoarseStop;
  const auto run = [&](const PreparedPair& scans, double gate_m, bool with_loss, const SE3d& T,
                       const MinimizerOptions& how) -> Registered {
    ObjectiveSetOptions gated = options_;
    gated.matching.max_distance_m = gate_m;
    auto set = std::make_shared<const ObjectiveSet>(scans, metrics_, gated);
    Stage stage = {0, gate_m, {}};
    if (with_loss) {
      const ObjectiveSet thinned(thinned_, metrics_, gated);
      for (const Objective& objective : thinned.objectives()) {
        stage.loss_scales.push_back(kHuberSigmas * kSigmaOfMedian *
                                    MedianResidual(objective, T, options.threads));
      }
    }
    JointObjective objective = with_loss ? WithHuber(*set, weights_, stage.loss_scales)
                                         : JointObjective(set->objectives(), weights_);
    MinimizerSummary summary = Minimize(objective, T, how);
    return {std::move(set), std::move(objective), std::move(summary), {std::move(stage)}};
  };
  Registered done = run(thinned_, 0, false, T_start, coarse);
  const auto pose = [&]() -> const SE3d& { return done.summary.T_target_source(); };
  double gate_m = 0;
  for (int i = 0; i < kMostGates && GoesOn(done.summary); ++i) {
    const double next_m = GateAt(thinned_, pose(), options.threads);
    if (next_m == 0 || (gate_m > 0 && next_m > kWorthShrinking * gate_m)) {
      break;
    }
    gate_m = next_m;
    Append(&done, run(thinned_, gate_m, false, pose(), coarse));
  }
  for (const PreparedPair* scans : {&thinned_, &scans_}) {
    if (GoesOn(done.summary)) {
      Append(&done, run(*scans, gate_m, true, pose(), scans == &scans_ ? options : coarse));
    }
  }
  return done;
}

}  // namespace icpscape
