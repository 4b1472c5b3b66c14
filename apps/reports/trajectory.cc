// SPDX-License-Identifier: BSD-3-Clause
#include "apps/reports/trajectory.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <utility>

#include "apps/run/flag.h"
#include "icpscape/common/text.h"
#include "icpscape/io/output.h"

namespace icpscape {
namespace {

constexpr double kDegrees = 180 / M_PI;

double Percent(const MeanSegmentError& mean) { return 100 * mean.translation; }
double DegreesPer100M(const MeanSegmentError& mean) {
  return 100 * kDegrees * mean.rotation_rad_per_m;
}

// Rows of summary.csv, and on the screen those that have segments.
class SummaryTable {
 public:
  void Heading(const char* what) const {
    std::printf("%-20s %9s %10s %17s\n", what, "segments", "t_err (%)", "r_err (deg/100 m)");
  }

  void Add(const std::string& sequence, const char* subset, double value, const std::string& label,
           const std::optional<MeanSegmentError>& mean) {
    if (!mean) {
      return;
    }
    if (!label.empty()) {
      std::printf("%-20s %9d %10.4f %17.4f\n", label.c_str(), mean->segments, Percent(*mean),
                  DegreesPer100M(*mean));
    }
    csv_.AddRow({sequence, subset, Number(value), std::to_string(mean->segments),
                 Number(Percent(*mean)), Number(DegreesPer100M(*mean)),
                 Number(kDegrees * mean->rotation_rad_per_m)});
  }

  void Write(Run* run) const { csv_.WriteCsv(run->File("summary.csv")); }

 private:
  Table csv_{{"sequence", "subset", "value", "segments", "t_err_percent", "r_err_deg_per_100m",
              "r_err_deg_per_m"}};
};

void AddByLengthAndSpeed(const std::string& sequence, const std::vector<SegmentError>& errors,
                         bool print, SummaryTable* summary) {
  if (print) {
    summary->Heading("length (m)");
  }
  for (const double length : kKittiLengthsM) {
    summary->Add(sequence, "length_m", length, print ? Number(length) : "",
                 MeanOfLength(errors, length));
  }
  if (print) {
    std::printf("\n");
    summary->Heading("speed (m/s)");
  }
  for (const double speed : kKittiSpeedsMps) {
    summary->Add(sequence, "speed_mps", speed, print ? Number(speed) : "",
                 MeanOfSpeed(errors, speed));
  }
}

void ReportSegmentErrors(const std::vector<NamedTrajectory>& trajectories, Run* run) {
  Manifest* const manifest = run->manifest();
  constexpr double kAll = std::numeric_limits<double>::quiet_NaN();
  Table segments({"sequence", "first_frame", "last_frame", "length_m", "speed_mps", "t_err_percent",
                  "r_err_deg_per_m"});
  SummaryTable summary;
  std::vector<SegmentError> all;
  std::vector<MeanSegmentError> means;
  summary.Heading("sequence");
  for (const NamedTrajectory& trajectory : trajectories) {
    const std::vector<SegmentError> errors = KittiSegmentErrors(trajectory.pair);
    for (const SegmentError& e : errors) {
      segments.AddRow({trajectory.name, std::to_string(e.first_frame), std::to_string(e.last_frame),
                       Number(e.length_m), Number(e.speed_mps), Number(100 * e.translation),
                       Number(kDegrees * e.rotation_rad_per_m)});
    }
    const std::optional<MeanSegmentError> mean = MeanOf(errors);
    if (mean) {
      means.push_back(*mean);
    } else {
      std::printf("%s: a path of %.1f m; t_err and r_err need more than %g m.\n",
                  trajectory.name.c_str(), PathLengths(trajectory.pair.truth).back(),
                  kKittiLengthsM[0]);
    }
    summary.Add(trajectory.name, "all", kAll, trajectory.name, mean);
    AddByLengthAndSpeed(trajectory.name, errors, /*print=*/false, &summary);
    all.insert(all.end(), errors.begin(), errors.end());
  }
  if (const std::optional<MeanSegmentError> mean = MeanOf(all)) {
    summary.Add("all_segments", "all", kAll, "all segments", mean);
    summary.Add("mean_of_sequences", "all", kAll, "mean of sequences", MeanOfMeans(means));
    std::printf("\n");
    AddByLengthAndSpeed("all_segments", all, /*print=*/true, &summary);
    manifest->SetResult("t_err_percent", Percent(*mean));
    manifest->SetResult("r_err_deg_per_100m", DegreesPer100M(*mean));
    manifest->SetResult("t_err_percent_mean_of_sequences", Percent(*MeanOfMeans(means)));
    manifest->SetResult("r_err_deg_per_100m_mean_of_sequences",
                        DegreesPer100M(*MeanOfMeans(means)));
  }
  segments.WriteCsv(run->File("errors.csv"));
  summary.Write(run);
}

// Rows of pose_errors.csv, also on the screen.
void AddPoseErrors(const std::string& sequence, const std::string& error,
                   const std::string& alignment, const PoseErrors& errors, Table* csv) {
  const Statistics m = Summarize(errors.translation_m);
  std::vector<double> degrees;
  for (const double angle : errors.rotation_rad) {
    degrees.push_back(kDegrees * angle);
  }
  const Statistics deg = Summarize(degrees);
  std::printf("%-12s %-24s %9.4f %9.4f %9.4f %9.4f   %9.4f %9.4f %9.4f %9.4f\n", sequence.c_str(),
              (error + ", " + alignment).c_str(), m.rmse, m.mean, m.median, m.max, deg.rmse,
              deg.mean, deg.median, deg.max);
  std::vector<std::string> row = {sequence, error, alignment};
  for (const Statistics& s : {m, deg}) {
    for (const double value : {s.rmse, s.mean, s.median, s.max}) {
      row.push_back(Number(value));
    }
  }
  csv->AddRow(std::move(row));
}

void ReportPoseErrors(const std::vector<NamedTrajectory>& trajectories, int rpe_frames, Run* run) {
  Manifest* const manifest = run->manifest();
  Table csv({"sequence", "error", "alignment", "rmse_m", "mean_m", "median_m", "max_m", "rmse_deg",
             "mean_deg", "median_deg", "max_deg"});
  std::printf("\n%-37s %9s %9s %9s %9s   %9s %9s %9s %9s\n", "sequence, error", "RMSE (m)", "mean",
              "median", "max", "RMSE (deg)", "mean", "median", "max");
  for (const auto& [name, pair] : trajectories) {
    for (const Alignment alignment : AllOf<Alignment>()) {
      const std::optional<SE3d> T_truth_estimate = AlignmentOf(pair, alignment);
      if (!T_truth_estimate) {
        std::printf("%s: its positions lie on one line; a rigid alignment needs more.\n",
                    name.c_str());
        continue;
      }
      const PoseErrors errors = AbsoluteErrors(pair, *T_truth_estimate);
      AddPoseErrors(name, "ATE", NameOf(alignment), errors, &csv);
      manifest->SetResult("ate_rmse_m_" + std::string(NameOf(alignment)) + "_" + name,
                          Summarize(errors.translation_m).rmse);
    }
    const PoseErrors errors = RelativeErrors(pair, rpe_frames);
    AddPoseErrors(name, "RPE_" + std::to_string(rpe_frames), "none", errors, &csv);
    manifest->SetResult("rpe_rmse_m_" + name, Summarize(errors.translation_m).rmse);
  }
  csv.WriteCsv(run->File("pose_errors.csv"));
}

}  // namespace

void ReportTrajectoryErrors(const std::vector<NamedTrajectory>& trajectories, int rpe_frames,
                            Run* run) {
  for (const NamedTrajectory& trajectory : trajectories) {
    const std::size_t poses = trajectory.pair.truth.size();
    RequireFlag(static_cast<std::size_t>(rpe_frames) < poses, "rpe_frames",
                std::to_string(rpe_frames),
                "fewer than the " + std::to_string(poses) + " poses of " + trajectory.name);
  }
  ReportSegmentErrors(trajectories, run);
  ReportPoseErrors(trajectories, rpe_frames, run);
}

void DrawTrajectories(const std::vector<NamedTrajectory>& trajectories, const std::string& title,
                      Run* run) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  Table csv({"sequence", "frame", "path_m", "x_m", "y_m", "z_m", "truth_x_m", "truth_y_m",
             "truth_z_m", "error_m", "error_deg"});
  for (const auto& [name, pair] : trajectories) {
    const bool has_truth = !pair.truth.empty();
    const SE3d T = has_truth ? *AlignmentOf(pair, Alignment::kFirstPose) : SE3d();
    const std::vector<double> path = PathLengths(has_truth ? pair.truth : pair.estimate);
    const PoseErrors errors = has_truth ? AbsoluteErrors(pair, T) : PoseErrors();
    for (std::size_t i = 0; i < pair.estimate.size(); ++i) {
      const Vec3 p = T * pair.estimate[i].t();
      const Vec3 truth = has_truth ? pair.truth[i].t() : Vec3::Constant(kUnknown);
      csv.AddRow({name, std::to_string(i), Number(path[i]), Number(p.x()), Number(p.y()),
                  Number(p.z()), Number(truth.x()), Number(truth.y()), Number(truth.z()),
                  Number(has_truth ? errors.translation_m[i] : kUnknown),
                  Number(has_truth ? kDegrees * errors.rotation_rad[i] : kUnknown)});
    }
  }
  const std::filesystem::path table = run->File("trajectory.csv");
  csv.WriteCsv(table);
  run->Draw("plot_trajectory.py", {table.string(), "--title", title}, "trajectory");
}

}  // namespace icpscape
