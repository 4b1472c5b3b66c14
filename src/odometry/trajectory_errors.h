// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_ODOMETRY_TRAJECTORY_ERRORS_H_
#define ICPSCAPE_SRC_ODOMETRY_TRAJECTORY_ERRORS_H_

#include <optional>
#include <vector>

#include "icpscape/cloud/trajectory.h"
#include "icpscape/common/names.h"

namespace icpscape {

/// A true and an estimated trajectory of the same body, pose by pose. The two may have different
/// world frames; only AbsoluteErrors depends on them, and takes an alignment.
struct TrajectoryPair {
  std::vector<SE3d> truth;      ///< T_world_body.
  std::vector<SE3d> estimate;   ///< T_world_body, as many.
  std::vector<double> times_s;  ///< Of both, or empty.
};

/// Pairs the poses: by time, nearest within `max_time_difference_s` and one to one, where both
/// trajectories have times; else by index. Throws InputError where by index the lengths differ, or
/// fewer than two pairs are left.
TrajectoryPair Associate(const Trajectory& truth, const Trajectory& estimate,
                         double max_time_difference_s);

/// Length of the path from the first pose to each (m); the first is 0.
std::vector<double> PathLengths(const std::vector<SE3d>& T_world_body);

/// Error over one stretch of a trajectory [Geiger et al., CVPR 2012; KITTI odometry devkit,
/// evaluate_odometry.cpp]:
///   E = (estimate_first^-1 estimate_last)^-1 (truth_first^-1 truth_last)
struct SegmentError {
  int first_frame = 0;
  int last_frame = 0;
  double length_m = 0;            ///< Nominal: 100, 200, ..., 800.
  double speed_mps = 0;           ///< length_m over the time it took.
  double translation = 0;         ///< |t(E)| / length_m.
  double rotation_rad_per_m = 0;  ///< angle(E) / length_m.
};

/// What the devkit does: from every tenth frame, for each length, to the first frame that lies
/// farther than that along the truth. Empty for a path of less than 100 m. Without times, as in the
/// devkit: 0.1 s for each frame of the stretch, both ends included. (The devkit computes in float,
/// and its angle by acos of a trace, which loses angles below 3e-4 rad.)
std::vector<SegmentError> KittiSegmentErrors(const TrajectoryPair& pair);

inline constexpr double kKittiLengthsM[] = {100, 200, 300, 400, 500, 600, 700, 800};
/// Middles of the devkit's speed bins. Each reaches 2 m/s to either side: neighbours overlap.
inline constexpr double kKittiSpeedsMps[] = {2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24};

/// t_err and r_err: plain means over segments.
struct MeanSegmentError {
  int segments = 0;
  double translation = 0;
  double rotation_rad_per_m = 0;
};

/// Each of these is nothing where there is nothing to average.
std::optional<MeanSegmentError> MeanOf(const std::vector<SegmentError>& errors);
std::optional<MeanSegmentError> MeanOfLength(const std::vector<SegmentError>& errors,
                                             double length_m);
std::optional<MeanSegmentError> MeanOfSpeed(const std::vector<SegmentError>& errors,
                                            double speed_mps);
/// Mean of the sequences' means, each sequence counting the same; `segments` is their sum.
/// (MeanOf over all segments of all sequences is what the benchmark ranks by: there a long sequence
/// counts more.)
std::optional<MeanSegmentError> MeanOfMeans(const std::vector<MeanSegmentError>& sequences);

/// How the estimate is moved before it is compared, as a whole and rigidly.
enum class Alignment {
  kNone,       ///< As given.
  kFirstPose,  ///< The first poses coincide.
  kRigid,      ///< Least sum of squared distances of the positions [Umeyama 1991], without scale.
};
template <>
struct Names<Alignment> {
  static constexpr const char* kWhat = "alignment";
  static constexpr const char* kNames[] = {"none", "first_pose", "rigid"};
};

/// T_truth_estimate, from the estimate's world to the truth's. Nothing for kRigid where either
/// trajectory's positions lie on one line, to a hundredth of its length: then the rotation about it
/// is undetermined.
std::optional<SE3d> AlignmentOf(const TrajectoryPair& pair, Alignment alignment);

/// Errors of poses, one entry each: |t(E)| in metres and angle(E) in radians.
struct PoseErrors {
  std::vector<double> translation_m;
  std::vector<double> rotation_rad;
};

/// Absolute trajectory error, ATE [Sturm et al., IROS 2012]: E_i = truth_i^-1 T_truth_estimate
/// estimate_i.
PoseErrors AbsoluteErrors(const TrajectoryPair& pair, const SE3d& T_truth_estimate);

/// Relative pose error, RPE [ibid.], over `delta` frames, from every frame that has such a
/// successor:
///   E_i = (truth_i^-1 truth_i+delta)^-1 (estimate_i^-1 estimate_i+delta).
/// Throws UsageError for a delta below 1.
PoseErrors RelativeErrors(const TrajectoryPair& pair, int delta);

struct Statistics {
  double rmse = 0, mean = 0, median = 0, max = 0;
};
/// The median of an even number is the mean of the middle two. Throws UsageError for no values.
Statistics Summarize(std::vector<double> values);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_ODOMETRY_TRAJECTORY_ERRORS_H_
