// SPDX-License-Identifier: BSD-3-Clause
#include <gflags/gflags.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "apps/flags/drive.h"
#include "apps/flags/odometry.h"
#include "apps/flags/verdict.h"
#include "apps/reports/odometry.h"
#include "apps/run/app.h"
#include "apps/run/progress.h"
#include "apps/run/run.h"
#include "icpscape/common/text.h"
#include "icpscape/io/sha256.h"

DEFINE_bool(restart, false, "Begins again, without the journal of an earlier run in --out.");
static const icpscape::FlagMark restart_mark(&FLAGS_restart, icpscape::kAside);
DEFINE_double(
    write_map_voxel_m, 0.5,
    "Voxel size (m) of map.ply, which has one point per voxel of the whole drive; 0: none.");
static const icpscape::FlagMark write_map_mark(&FLAGS_write_map_voxel_m, icpscape::kAside);

namespace icpscape {
namespace {

// All that the results depend on besides the scans' bytes, whose hashes are in the records.
std::string JournalHeader(const ScanSequence& sequence) {
  std::vector<std::string> parts = {AppName(), "version=" + Version()};
  for (const Flag& flag : OwnFlags()) {
    if (!flag.Has(kAside)) {
      parts.push_back(flag.name);
      parts.back().append("=").append(flag.value);
    }
  }
  parts.push_back("scans=" + std::to_string(sequence.scans.size()));
  std::string times;
  for (const double time : sequence.times_s) {
    times += Number(time) + " ";
  }
  times += sequence.times_are_measured ? "measured" : "made up";
  parts.push_back("times=" + Sha256OfText(times));
  std::string header = Join(parts, "; ");
  std::replace(header.begin(), header.end(), '\n', ' ');  // A path may have one, a record not.
  return header;
}

// What the journal has is replayed; the rest is registered.
void Drive(ResumableOdometry* odometry) {
  if (odometry->num_known() > 0) {
    std::cout << "journal: " << odometry->num_known() << " scans are done, and are replayed"
              << std::endl;
  }
  {
    // On its own: replay is faster, and the remaining time is computed from the rate.
    Progress progress("scans replayed", odometry->num_known());
    odometry->Replay([&](int done) { progress.Show(done); });
  }
  Progress progress("scans", odometry->num_left());
  odometry->Register([&](int done) { progress.Show(done); });
}

void RunOdometry() {
  SetDefaultsOfMode();
  CheckDriveFlags();
  const OdometryOptions options = OdometryFromFlags();
  AcceptedFromFlags();
  RequireAtLeastZero("write_map_voxel_m", FLAGS_write_map_voxel_m);
  Run run;
  const ScanSequence sequence = DriveFromFlags(run.manifest());
  Journal journal(run.Lasting("journal.txt"), JournalHeader(sequence),
                  FLAGS_restart ? Journal::Begin::kAnew : Journal::Begin::kWhereItEnds);
  ResumableOdometry odometry(sequence, options, FLAGS_write_map_voxel_m, &journal);
  Drive(&odometry);
  run.manifest()->AddTiming("odometry");

  const NamedTrajectory trajectory = ReportOdometry(odometry, &run);
  if (!trajectory.pair.truth.empty()) {
    ReportEnd(trajectory.pair, run.manifest());
    std::cout << std::endl;
    ReportTrajectoryErrors({trajectory}, 1, &run);
  }
  DrawTrajectories({trajectory}, TitleWithFlags(sequence.title + ", odometry"), &run);
  run.manifest()->AddTiming("results");
  run.Finish();
  RequireAccepted(odometry.records(), AcceptedFromFlags());
}

}  // namespace
}  // namespace icpscape

int main(int argc, char** argv) {
  // One metric, as register; all that are named are minimised together.
  icpscape::SetFlagDefault("metrics", "point_to_plane");
  return icpscape::RunApp(argc, argv,
                          "estimates the trajectory of a drive from its scans, by any metric, scan "
                          "to scan or scan to map; goes on where an earlier run was stopped.",
                          icpscape::RunOdometry);
}
