// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/odometry/trajectory_errors.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "icpscape/common/error.h"
#include "icpscape/common/text.h"

namespace icpscape {
namespace {

constexpr std::size_t kFirstFrameStep = 10;
constexpr double kFramePeriodS = 0.1;
constexpr double kSpeedBinHalfWidthMps = 2;

// Index of the time that is nearest; times must not be empty.
std::size_t Nearest(const std::vector<double>& times, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) {
    return 0;
  }
  const auto before = after - 1;
  const bool before_is_nearer = after == times.end() || time - *before <= *after - time;
  return static_cast<std::size_t>((before_is_nearer ? before : after) - times.begin());
}

double DurationOf(const TrajectoryPair& pair, std::size_t first, std::size_t last) {
  return pair.times_s.empty() ? kFramePeriodS * static_cast<double>(last - first + 1)
                              : pair.times_s[last] - pair.times_s[first];
}

template <class Predicate>
std::optional<MeanSegmentError> MeanWhere(const std::vector<SegmentError>& errors,
                                          const Predicate& belongs) {
  MeanSegmentError mean;
  for (const SegmentError& error : errors) {
    if (belongs(error)) {
      ++mean.segments;
      mean.translation += error.translation;
      mean.rotation_rad_per_m += error.rotation_rad_per_m;
    }
  }
  if (mean.segments == 0) {
    return std::nullopt;
  }
  mean.translation /= mean.segments;
  mean.rotation_rad_per_m /= mean.segments;
  return mean;
}

using Positions = Eigen::Matrix3Xd;

Positions PositionsOf(const std::vector<SE3d>& poses) {
  Positions positions(3, static_cast<Eigen::Index>(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    positions.col(static_cast<Eigen::Index>(i)) = poses[i].t();
  }
  return positions;
}

bool LieOnALine(const Positions& positions) {
  const Positions centred = positions.colwise() - positions.rowwise().mean();
  const Vec3 spread = Eigen::JacobiSVD<Mat3>(centred * centred.transpose()).singularValues();
  return spread(1) <= 1e-4 * spread(0);  // Squares: a hundredth of the length.
}

void Append(const SE3d& error, PoseErrors* errors) {
  errors->translation_m.push_back(error.t().norm());
  errors->rotation_rad.push_back(error.LogRotation().norm());
}

}  // namespace

TrajectoryPair Associate(const Trajectory& truth, const Trajectory& estimate,
                         double max_time_difference_s) {
  const auto refuse_fewer_than_two = [](std::size_t pairs, const std::string& how) {
    if (pairs < 2) {
      throw InputError("pairs of poses " + how + ": " + std::to_string(pairs) +
                       "; expected at least two.");
    }
  };
  if (truth.times_s.empty() || estimate.times_s.empty()) {
    if (truth.T_world_body.size() != estimate.T_world_body.size()) {
      throw InputError(std::to_string(estimate.T_world_body.size()) +
                       " estimated poses for a ground truth of " +
                       std::to_string(truth.T_world_body.size()) + "; expected as many.");
    }
    refuse_fewer_than_two(truth.T_world_body.size(), "in the files");
    return {truth.T_world_body, estimate.T_world_body,
            truth.times_s.empty() ? estimate.times_s : truth.times_s};
  }
  TrajectoryPair pair;
  for (std::size_t i = 0; i < estimate.times_s.size(); ++i) {
    const std::size_t j = Nearest(truth.times_s, estimate.times_s[i]);
    const bool is_mutual = Nearest(estimate.times_s, truth.times_s[j]) == i;
    if (is_mutual && std::abs(truth.times_s[j] - estimate.times_s[i]) <= max_time_difference_s) {
      pair.truth.push_back(truth.T_world_body[j]);
      pair.estimate.push_back(estimate.T_world_body[i]);
      pair.times_s.push_back(truth.times_s[j]);
    }
  }
  refuse_fewer_than_two(pair.truth.size(),
                        "whose times agree to " + Number(max_time_difference_s) + " s");
  return pair;
}

std::vector<double> PathLengths(const std::vector<SE3d>& T_world_body) {
  std::vector<double> lengths(T_world_body.size(), 0.0);
  for (std::size_t i = 1; i < lengths.size(); ++i) {
    lengths[i] = lengths[i - 1] + (T_world_body[i].t() - T_world_body[i - 1].t()).norm();
  }
  return lengths;
}

std::vector<SegmentError> KittiSegmentErrors(const TrajectoryPair& pair) {
  const std::vector<double> path = PathLengths(pair.truth);
  std::vector<SegmentError> errors;
  for (std::size_t first = 0; first < path.size(); first += kFirstFrameStep) {
    for (const double length : kKittiLengthsM) {
      const auto end = std::upper_bound(path.begin(), path.end(), path[first] + length);
      if (end == path.end()) {
        break;  // Longer ones end no earlier.
      }
      const auto last = static_cast<std::size_t>(end - path.begin());
      const SE3d true_motion = pair.truth[first].Inverse() * pair.truth[last];
      const SE3d motion = pair.estimate[first].Inverse() * pair.estimate[last];
      const SE3d error = motion.Inverse() * true_motion;
      SegmentError segment;
      segment.first_frame = static_cast<int>(first);
      segment.last_frame = static_cast<int>(last);
      segment.length_m = length;
      segment.speed_mps = length / DurationOf(pair, first, last);
      segment.translation = error.t().norm() / length;
      segment.rotation_rad_per_m = error.LogRotation().norm() / length;
      errors.push_back(segment);
    }
  }
  return errors;
}

std::optional<MeanSegmentError> MeanOf(const std::vector<SegmentError>& errors) {
  return MeanWhere(errors, [](const SegmentError&) { return true; });
}

std::optional<MeanSegmentError> MeanOfLength(const std::vector<SegmentError>& errors,
                                             double length_m) {
  return MeanWhere(errors, [&](const SegmentError& e) { return e.length_m == length_m; });
}

std::optional<MeanSegmentError> MeanOfSpeed(const std::vector<SegmentError>& errors,
                                            double speed_mps) {
  return MeanWhere(errors, [&](const SegmentError& e) {
    return std::abs(e.speed_mps - speed_mps) < kSpeedBinHalfWidthMps;
  });
}

std::optional<MeanSegmentError> MeanOfMeans(const std::vector<MeanSegmentError>& sequences) {
  if (sequences.empty()) {
    return std::nullopt;
  }
  MeanSegmentError mean;
  for (const MeanSegmentError& sequence : sequences) {
    mean.segments += sequence.segments;
    mean.translation += sequence.translation / static_cast<double>(sequences.size());
    mean.rotation_rad_per_m += sequence.rotation_rad_per_m / static_cast<double>(sequences.size());
  }
  return mean;
}

std::optional<SE3d> AlignmentOf(const TrajectoryPair& pair, Alignment alignment) {
  switch (alignment) {
    case Alignment::kNone:
      return SE3d();
    case Alignment::kFirstPose:
      return pair.truth.front() * pair.estimate.front().Inverse();
    case Alignment::kRigid:
      break;
  }
  const Positions truth = PositionsOf(pair.truth);
  const Positions estimate = PositionsOf(pair.estimate);
  if (LieOnALine(truth) || LieOnALine(estimate)) {
    return std::nullopt;
  }
  const Mat<double, 4, 4> T = Eigen::umeyama(estimate, truth, /*with_scaling=*/false);
  return SE3d(T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>());
}

PoseErrors AbsoluteErrors(const TrajectoryPair& pair, const SE3d& T_truth_estimate) {
  PoseErrors errors;
  for (std::size_t i = 0; i < pair.truth.size(); ++i) {
    Append(pair.truth[i].Inverse() * T_truth_estimate * pair.estimate[i], &errors);
  }
  return errors;
}

PoseErrors RelativeErrors(const TrajectoryPair& pair, int delta) {
  if (delta < 1) {
    throw UsageError("Relative errors over " + std::to_string(delta) +
                     " frames; expected at least 1.");
  }
  PoseErrors errors;
  const auto step = static_cast<std::size_t>(delta);
  for (std::size_t i = 0; i + step < pair.truth.size(); ++i) {
    const SE3d true_motion = pair.truth[i].Inverse() * pair.truth[i + step];
    const SE3d motion = pair.estimate[i].Inverse() * pair.estimate[i + step];
    Append(true_motion.Inverse() * motion, &errors);
  }
  return errors;
}

Statistics Summarize(std::vector<double> values) {
  if (values.empty()) {
    throw UsageError("Statistics of no values; expected at least one.");
  }
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  Statistics statistics;
  statistics.rmse =
      std::sqrt(std::inner_product(values.begin(), values.end(), values.begin(), 0.0) / n);
  statistics.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  statistics.median = (values[(values.size() - 1) / 2] + values[values.size() / 2]) / 2;
  statistics.max = values.back();
  return statistics;
}

}  // namespace icpscape
