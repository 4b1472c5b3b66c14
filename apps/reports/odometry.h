// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_APPS_REPORTS_ODOMETRY_H_
#define ICPSCAPE_APPS_REPORTS_ODOMETRY_H_

#include <vector>

#include "apps/reports/trajectory.h"
#include "apps/reports/verdict.h"
#include "apps/run/run.h"
#include "icpscape/resumable/resumable_odometry.h"

namespace icpscape {

/// Writes trajectory_kitti.txt, trajectory_tum.txt, frames.csv, timings.csv and, where there is a
/// map, map.ply; prints and records failures, path and speed. Returns the trajectory with the
/// truth, where that is known for more than one scan, both as KITTI's files have them.
NamedTrajectory ReportOdometry(const ResumableOdometry& odometry, Run* run);

/// Throws DoubtfulPose for scans that have the predicted motion, in some direction or in all, and
/// for those that ended at the limit of steps, unless that is accepted.
void RequireAccepted(const std::vector<FrameRecord>& records, const AcceptedVerdicts& accepted);

/// Prints and records how far the end is off the truth.
void ReportEnd(const TrajectoryPair& pair, Manifest* manifest);

}  // namespace icpscape

#endif  // ICPSCAPE_APPS_REPORTS_ODOMETRY_H_
