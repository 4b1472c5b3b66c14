// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_TRAJECTORY_H_
#define ICPSCAPE_APPS_REPORTS_TRAJECTORY_H_

#include <string>
#include <vector>

#include "apps/run/run.h"
#include "icpscape/odometry/trajectory_errors.h"

namespace icpscape {

/// One estimated trajectory under the name that tables and figures give it. `pair.truth` is empty
/// where none is known.
struct NamedTrajectory {
  std::string name;
  TrajectoryPair pair;
};

/// Prints and records all errors of trajectories with truth, and writes them: errors.csv, one row a
/// segment of KITTI's protocol; summary.csv, their means by sequence, length and speed;
/// pose_errors.csv, ATE by alignment and RPE over `rpe_frames`. Prints a sentence for errors that
/// need a longer trajectory. Throws UsageError for one of at most `rpe_frames` poses.
void ReportTrajectoryErrors(const std::vector<NamedTrajectory>& trajectories, int rpe_frames,
                            Run* run);

/// Writes trajectory.csv and draws it as trajectory.svg and .png: positions, aligned by the first
/// pose, and the distance from the truth over the path; without truth only the positions (nan in
/// the columns of the truth).
void DrawTrajectories(const std::vector<NamedTrajectory>& trajectories, const std::string& title,
                      Run* run);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_TRAJECTORY_H_
