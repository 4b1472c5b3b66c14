// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/odometry.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "icpscape/cloud/origin.h"
#include "icpscape/common/error.h"
#include "icpscape/common/text.h"
#include "icpscape/io/kitti.h"
#include "icpscape/io/output.h"
#include "icpscape/io/point_files.h"
#include "icpscape/io/trajectory.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

// In the coordinates of the user; the frames of all scans have the same origin.
std::vector<SE3d> PosesOf(const ResumableOdometry& odometry) {
  const PairOrigins origins = {odometry.origin(), odometry.origin()};
  std::vector<SE3d> T_world_lidar;
  for (const FrameRecord& record : odometry.records()) {
    T_world_lidar.push_back(origins.ToUser(record.result.T_world_lidar));
  }
  return T_world_lidar;
}

void WriteFrames(const ScanSequence& sequence, const std::vector<FrameRecord>& records,
                 const std::vector<SE3d>& T_world_lidar, Run* run) {
  Table frames({"frame",
                "scan",
                "time_s",
                "registered",
                "termination",
                "converged",
                "recovered",
                "predicted_directions",
                "uncertain_directions",
                "iterations",
                "n",
                "rmse",
                "gate_m",
                "points",
                "map_points",
                "motion_m",
                "motion_deg",
                "x_m",
                "y_m",
                "z_m"});
  // Apart, since no two runs take the same time.
  Table timings({"frame", "read_s", "odometry_s"});
  for (std::size_t i = 0; i < records.size(); ++i) {
    const FrameResult& r = records[i].result;
    const Vec3& t = T_world_lidar[i].t();
    frames.AddRow({std::to_string(i),
                   sequence.scans[i].name,
                   Number(sequence.times_s[i]),
                   r.registered ? "1" : "0",
                   i == 0 ? "first" : NameOf(r.termination),
                   r.converged ? "1" : "0",
                   r.recovered ? "1" : "0",
                   std::to_string(r.predicted_directions),
                   std::to_string(r.uncertain_directions),
                   std::to_string(r.iterations),
                   std::to_string(r.n),
                   Number(r.rmse),
                   Number(r.gate_m),
                   std::to_string(r.points),
                   std::to_string(r.map_points),
                   Number(r.motion.t().norm()),
                   Number(r.motion.LogRotation().norm() * kDegrees),
                   Number(t.x()),
                   Number(t.y()),
                   Number(t.z())});
    timings.AddRow({std::to_string(i), Number(records[i].read_s), Number(records[i].odometry_s)});
  }
  frames.WriteCsv(run->File("frames.csv"));
  timings.WriteCsv(run->File("timings.csv"));
}

// How many scans there are of a kind, in a sentence and in the manifest.
void Count(const std::vector<FrameRecord>& records, bool (*is_of_kind)(const FrameResult&),
           const char* name, const char* sentence, Manifest* manifest) {
  const auto count =
      std::count_if(records.begin() + 1, records.end(),
                    [&](const FrameRecord& record) { return is_of_kind(record.result); });
  if (count > 0) {
    std::cout << count << " of " << records.size() - 1 << " scans " << sentence << "\n";
  }
  manifest->SetResult(name, static_cast<double>(count));
}

void ReportDoubts(const std::vector<FrameRecord>& records, Manifest* manifest) {
  Count(
      records, [](const FrameResult& r) { return !r.registered; }, "not_registered",
      "could not be registered and keep the predicted pose", manifest);
  Count(
      records, [](const FrameResult& r) { return r.recovered; }, "recovered",
      "were lost from the predicted pose and found from another start", manifest);
  Count(
      records, [](const FrameResult& r) { return r.predicted_directions > 0; }, "not_observed",
      "have the predicted motion in directions that they do not see", manifest);
  Count(
      records, [](const FrameResult& r) { return r.uncertain_directions > 0; }, "uncertain",
      "have directions with a predicted deviation beyond the tolerance", manifest);
  Count(
      records, [](const FrameResult& r) { return r.termination == Termination::kMaxIterations; },
      "ended_at_limit", "ended at the limit of steps: see frames.csv", manifest);
}

void ReportDeskewing(const std::vector<FrameRecord>& records, Manifest* manifest) {
  const auto count = std::count_if(records.begin(), records.end(), [](const FrameRecord& record) {
    return record.result.deskewed;
  });
  if (count > 0) {
    std::cout << "de-skewed: " << count << " of " << records.size() << " scans" << std::endl;
  }
  manifest->SetResult("deskewed", static_cast<double>(count));
}

void PrintPath(const std::vector<SE3d>& T_world_body) {
  const double away_m = (T_world_body.back().t() - T_world_body.front().t()).norm();
  std::printf("path: %.1f m, %.1f m from its start to its end\n", PathLengths(T_world_body).back(),
              away_m);
}

void ReportSpeed(const std::vector<FrameRecord>& records, Manifest* manifest) {
  std::vector<double> seconds;
  double sum = 0;
  for (const FrameRecord& record : records) {
    seconds.push_back(record.read_s + record.odometry_s);
    sum += seconds.back();
  }
  const double mean = sum / static_cast<double>(seconds.size());
  std::printf("time per scan, reading included: mean %.1f ms (%.1f Hz), longest %.1f ms\n",
              1e3 * mean, 1 / mean, 1e3 * *std::max_element(seconds.begin(), seconds.end()));
  manifest->SetResult("mean_s_per_scan", mean);
}

}  // namespace

NamedTrajectory ReportOdometry(const ResumableOdometry& odometry, Run* run) {
  const ScanSequence& sequence = odometry.sequence();
  Trajectory lidar;
  lidar.times_s = sequence.times_s;
  lidar.T_world_body = PosesOf(odometry);
  const SE3d Tr = sequence.T_camera_lidar.value_or(SE3d());  // Without a camera: the lidar's poses.
  NamedTrajectory named;
  named.name = sequence.title;
  // Paths and errors are those of the sensor, not of an origin that lies far out.
  const PairOrigins origins = {odometry.origin(), odometry.origin()};
  const auto without_origin = [&](std::vector<SE3d> poses) {
    for (SE3d& T : poses) {
      T = origins.FromUser(T);
    }
    return KittiPosesOf(poses, Tr);
  };
  named.pair.estimate = without_origin(lidar.T_world_body);
  if (sequence.times_are_measured) {
    named.pair.times_s = sequence.times_s;
  }
  if (!sequence.T_world_lidar.empty() && sequence.scans.size() > 1) {  // One pose has no error.
    named.pair.truth = without_origin(sequence.T_world_lidar);
  }
  WriteKittiTrajectory(run->File("trajectory_kitti.txt"), KittiPosesOf(lidar.T_world_body, Tr));
  WriteTumTrajectory(run->File("trajectory_tum.txt"), lidar);
  WriteFrames(sequence, odometry.records(), lidar.T_world_body, run);
  if (odometry.map()) {
    PointCloud map = odometry.map()->Cloud(SE3d());
    map.origin = odometry.origin();
    WritePly(run->File("map.ply"), map);
  }
  ReportDoubts(odometry.records(), run->manifest());
  std::cout << "times: " << sequence.TimesText() << std::endl;
  run->manifest()->SetResult("times", sequence.TimesText());
  ReportDeskewing(odometry.records(), run->manifest());
  PrintPath(named.pair.estimate);
  ReportSpeed(odometry.records(), run->manifest());
  return named;
}

void RequireAccepted(const std::vector<FrameRecord>& records, const AcceptedVerdicts& accepted) {
  const auto is_doubtful = [&](const FrameRecord& record) {
    const FrameResult& r = record.result;
    const bool predicted = !r.registered || r.predicted_directions > 0;
    return (predicted && !accepted.undetermined) ||
           (r.registered && r.termination == Termination::kMaxIterations && !accepted.limit);
  };
  const auto doubtful = std::count_if(records.begin() + 1, records.end(), is_doubtful);
  if (doubtful > 0) {
    throw DoubtfulPose(std::to_string(doubtful) + " of " + std::to_string(records.size() - 1) +
                       " scans have the predicted motion, in some direction or in all, or ended at "
                       "the limit of steps. The results are written; --accept takes such scans.");
  }
}

void ReportEnd(const TrajectoryPair& pair, Manifest* manifest) {
  const SE3d truth = pair.truth.front().Inverse() * pair.truth.back();
  const SE3d error = truth.Inverse() * (pair.estimate.front().Inverse() * pair.estimate.back());
  const double degrees = error.LogRotation().norm() * kDegrees;
  std::printf("end: %.4f m, %.4f deg off the ground truth after %.1f m\n", error.t().norm(),
              degrees, PathLengths(pair.truth).back());
  manifest->SetResult("end_off_m", error.t().norm());
  manifest->SetResult("end_off_deg", degrees);
}

}  // namespace icpscape
