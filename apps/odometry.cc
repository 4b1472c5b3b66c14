// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <optional>
#include <set>

#include "apps/flags/odometry.h"
#include "apps/flags/run.h"
#include "apps/flags/drive.h"
#include "apps/reports/trajectory.h"
#include "apps/run/app.h"
#include "src/common/error.h"
#include "src/common/text.h"
#include "src/io/journal.h"
#include "src/io/output.h"
#include "src/io/point_files.h"
#include "src/io/sha256.h"
#include "src/io/trajectory.h"
#include "src/odometry/frame_record.h"

DEFINE_bool(restart, false, "Begin anew where an earlier run has left a journal in --out.");
DEFINE_double(
    write_map_voxel_m, 0.5,
    "map.ply has one point per voxel of this size (m) of the whole drive; 0 writes none.");

namespace icpscape {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kDegrees = 180 / M_PI;

double SecondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// All that the results depend on besides the scans' bytes, whose hashes are in the records: where
// they lie does not matter.
std::string JournalHeader(const ScanSequence& sequence) {
  static const std::set<std::string> kWithoutSay = {
      "out", "threads", "restart", "write_map_voxel_m", "kitti_root", "scans", "ground_truth"};
  std::vector<std::string> parts = {"icpscape-odometry", "version=" + Version()};
  for (const auto& [name, value] : OwnFlagValues()) {
    if (kWithoutSay.count(name) == 0) {
      parts.push_back(name);
      parts.back().append("=").append(value);
    }
  }
  parts.push_back("scans=" + std::to_string(sequence.scans.size()));
  std::string header = Join(parts, "; ");
  std::replace(header.begin(), header.end(), '\n', ' ');  // A path may have one, a record not.
  return header;
}

// Goes through the drive: what the journal has is replayed, the rest is registered and recorded.
class Run {
 public:
  Run(const ScanSequence& sequence, Journal* journal)
      : sequence_(sequence), journal_(*journal), odometry_(OdometryFromFlags()) {}

  void Go() {
    const std::size_t known = journal_.records().size();
    if (known > 0) {
      std::cout << "journal: " << known << " scans are done, and are replayed" << std::endl;
    }
    // Apart: one is faster than the other, and the time that remains is told from the rate.
    ForScans("scans replayed", 0, known, [this](std::size_t i) { Replay(i); });
    ForScans("scans", known, sequence_.scans.size(), [this](std::size_t i) { Register(i); });
  }

  const std::vector<FrameRecord>& records() const { return records_; }
  const std::optional<VoxelMap>& map() const { return map_; }

 private:
  void ForScans(const char* what, std::size_t begin, std::size_t end,
                const std::function<void(std::size_t)>& take) {
    Progress progress(what, static_cast<int>(end - begin));
    for (std::size_t i = begin; i < end; ++i) {
      take(i);
      if (map_) {
        NamingTheScan(i, [&] {
          map_->Insert(odometry_.last_scan()->cloud(), records_.back().result.T_world_lidar,
                       static_cast<int>(i));
        });
      }
      progress.Show(static_cast<int>(i + 1 - begin));
    }
  }

  PointCloud Read(std::size_t i) const {
    DroppedPoints dropped;
    return sequence_.scans[i].read(&dropped);
  }

  // What the odometry has to say against a scan, with the scan's name.
  void NamingTheScan(std::size_t i, const std::function<void()>& use) const {
    try {
      use();
    } catch (const InputError& error) {
      throw InputError(sequence_.scans[i].Place() + ": " + error.what());
    }
  }

  void Replay(std::size_t i) {
    const FrameRecord record = ParseFrameRecord(
        journal_.records()[i], "journal, scan " + sequence_.scans[i].name);
    PointCloud scan = Read(i);
    if (record.scan_sha256 != Sha256OfScan(sequence_.scans[i].file, scan)) {
      throw InputError(sequence_.scans[i].Place() +
                       ": is not the scan of the journal; expected it unchanged, or --restart.");
    }
    NamingTheScan(i, [&] { odometry_.Replay(std::move(scan), record.result); });
    records_.push_back(record);
  }

  void Register(std::size_t i) {
    FrameRecord record;
    const Clock::time_point start = Clock::now();
    PointCloud scan = Read(i);
    record.scan_sha256 = Sha256OfScan(sequence_.scans[i].file, scan);
    record.read_s = SecondsSince(start);
    const Clock::time_point read = Clock::now();
    NamingTheScan(i, [&] { record.result = odometry_.Add(std::move(scan)); });
    record.odometry_s = SecondsSince(read);
    journal_.Append(FormatFrameRecord(record));
    records_.push_back(record);
  }

  const ScanSequence& sequence_;
  Journal& journal_;
  Odometry odometry_;
  std::vector<FrameRecord> records_;
  std::optional<VoxelMap> map_ = FLAGS_write_map_voxel_m > 0
                                     ? std::optional<VoxelMap>(FLAGS_write_map_voxel_m)
                                     : std::nullopt;
};

void WriteFrames(const ScanSequence& sequence, const std::vector<FrameRecord>& records,
                 const std::filesystem::path& out) {
  Table frames({"frame", "scan", "time_s", "registered", "termination", "iterations", "n", "rmse",
                "gate_m", "points", "map_points", "motion_m", "motion_deg", "x_m", "y_m", "z_m"});
  // Apart, since no two runs take the same time.
  Table timings({"frame", "read_s", "odometry_s"});
  for (std::size_t i = 0; i < records.size(); ++i) {
    const FrameResult& r = records[i].result;
    const Vec3& t = r.T_world_lidar.t();
    frames.AddRow({std::to_string(i), sequence.scans[i].name,
                   Number(sequence.times_s[i]), r.registered ? "1" : "0",
                   i == 0 ? "first" : TerminationName(r.termination), std::to_string(r.iterations),
                   std::to_string(r.n), Number(r.rmse), Number(r.gate_m), std::to_string(r.points),
                   std::to_string(r.map_points), Number(r.motion.t().norm()),
                   Number(r.motion.LogRotation().norm() * kDegrees), Number(t.x()), Number(t.y()),
                   Number(t.z())});
    timings.AddRow({std::to_string(i), Number(records[i].read_s), Number(records[i].odometry_s)});
  }
  frames.WriteCsv(out / "frames.csv");
  timings.WriteCsv(out / "timings.csv");
}

// T_camera as KITTI has it where the camera is known, else the lidar's poses; the first is the
// identity.
std::vector<SE3d> KittiPoses(const ScanSequence& sequence, std::vector<SE3d> T_world_lidar) {
  const SE3d Tr = sequence.T_camera_lidar.value_or(SE3d());
  const SE3d T_first_world = T_world_lidar.front().Inverse();
  for (SE3d& T : T_world_lidar) {
    T = Tr * T_first_world * T * Tr.Inverse();
  }
  return T_world_lidar;
}

std::vector<SE3d> WriteTrajectories(const ScanSequence& sequence,
                                    const std::vector<FrameRecord>& records,
                                    const std::filesystem::path& out) {
  Trajectory trajectory;
  trajectory.times_s = sequence.times_s;
  for (const FrameRecord& record : records) {
    trajectory.T_world_body.push_back(record.result.T_world_lidar);
  }
  std::vector<SE3d> kitti = KittiPoses(sequence, trajectory.T_world_body);
  WriteKittiTrajectory(out / "trajectory_kitti.txt", kitti);
  WriteTumTrajectory(out / "trajectory_tum.txt", trajectory);
  return kitti;
}

void PrintSpeed(const std::vector<FrameRecord>& records, Manifest* manifest) {
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

void PrintPath(const std::vector<SE3d>& T_world_body) {
  const double away_m = (T_world_body.back().t() - T_world_body.front().t()).norm();
  std::printf("path: %.1f m, %.1f m from its start to its end\n", PathLengths(T_world_body).back(),
              away_m);
}

void PrintEnd(const TrajectoryPair& pair, Manifest* manifest) {
  const SE3d truth = pair.truth.front().Inverse() * pair.truth.back();
  const SE3d error = truth.Inverse() * (pair.estimate.front().Inverse() * pair.estimate.back());
  std::printf("end: %.4f m, %.4f deg off the ground truth after %.1f m\n", error.t().norm(),
              error.LogRotation().norm() * kDegrees, PathLengths(pair.truth).back());
  manifest->SetResult("end_off_m", error.t().norm());
  manifest->SetResult("end_off_deg", error.LogRotation().norm() * kDegrees);
}

void PrintFailures(const std::vector<FrameRecord>& records, Manifest* manifest) {
  const auto failures =
      std::count_if(records.begin() + 1, records.end(),
                    [](const FrameRecord& record) { return !record.result.registered; });
  if (failures > 0) {
    std::cout << failures << " scans could not be registered: the prediction stands in\n";
  }
  const auto unfinished =
      std::count_if(records.begin() + 1, records.end(), [](const FrameRecord& record) {
        return record.result.termination == Termination::kMaxIterations;
      });
  if (unfinished > 0) {
    std::cout << unfinished << " scans ended at the limit of steps: see frames.csv\n";
  }
  manifest->SetResult("ended_at_limit", static_cast<double>(unfinished));
  manifest->SetResult("not_registered", static_cast<double>(failures));
}

void RunOdometry() {
  SetDefaultsOfMode();
  CheckDriveFlags();
  OdometryFromFlags();
  RequireFlag(FLAGS_write_map_voxel_m >= 0 && std::isfinite(FLAGS_write_map_voxel_m),
              "write_map_voxel_m", Number(FLAGS_write_map_voxel_m), "a length in m, or 0");
  const std::filesystem::path out = OutputFolder();
  Manifest manifest(AppName());
  RecordFlags(&manifest);
  const ScanSequence sequence = DriveFromFlags(&manifest);
  Journal journal(out / "journal.txt", JournalHeader(sequence),
                  FLAGS_restart ? Journal::Begin::kAnew : Journal::Begin::kWhereItEnds);
  std::filesystem::remove(out / "manifest.json");  // Written last: the mark of a finished run.
  Run run(sequence, &journal);
  run.Go();
  manifest.AddTiming("odometry");

  NamedTrajectory named = {sequence.title, {}};
  named.pair.estimate = WriteTrajectories(sequence, run.records(), out);
  named.pair.times_s = sequence.times_are_measured ? sequence.times_s : std::vector<double>();
  WriteFrames(sequence, run.records(), out);
  if (run.map()) {
    WritePly(out / "map.ply", run.map()->Cloud(SE3d()));
  }
  PrintFailures(run.records(), &manifest);
  PrintPath(named.pair.estimate);
  PrintSpeed(run.records(), &manifest);
  if (!sequence.T_world_lidar.empty() && sequence.scans.size() > 1) {
    named.pair.truth = KittiPoses(sequence, sequence.T_world_lidar);
    PrintEnd(named.pair, &manifest);
    std::cout << std::endl;  // Before printf writes.
    ReportTrajectoryErrors({named}, 1, out, &manifest);
  }
  const bool drawn = DrawTrajectories({named}, sequence.title + ", " + "odometry", out);
  manifest.AddTiming("results");
  manifest.Write(out / "manifest.json");
  std::cout << "\nwritten: " << (out / "trajectory_kitti.txt").string()
            << ", trajectory_tum.txt, frames.csv, timings.csv, journal.txt"
            << (run.map() ? ", map.ply" : "")
            << (named.pair.truth.empty() ? "" : ", errors.csv, summary.csv, pose_errors.csv")
            << (drawn ? ", trajectory.csv, trajectory.svg, trajectory.png" : ", trajectory.csv")
            << ", manifest.json\n";
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  // One metric, as register; all that are named are minimised together.
  gflags::SetCommandLineOptionWithMode("metrics", "point_to_plane", gflags::SET_FLAGS_DEFAULT);
  return icpscape::RunApp(argc, argv,
                          "estimates the trajectory of a drive from its scans, by any metric, scan "
                          "to scan or scan to map; goes on where an earlier run was stopped.",
                          icpscape::RunOdometry);
}
