// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/apps/apps_fixture.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::TemporaryFolder;
using CovarianceApp = testing_support::AppsFixture;

TEST_F(CovarianceApp, ReportsOnAPairOfFiles) {
  const Outcome outcome = RunProgram("covariance", Files({"--metrics=point_to_plane,symmetric"}));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("L = 10 m"));
  EXPECT_THAT(outcome.out, HasSubstr("censi_ring_bias     none: the clouds carry no ring numbers"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("warning")));
  const auto covariances = ReadCsv(Path("out/covariance.csv"));
  ASSERT_EQ(covariances.size(), 2U * 6U);
  for (const auto& row : covariances) {
    const double sd = std::stod(row.at("sd_tx_m"));
    if (row.at("estimator") == "censi_ring_bias") {
      EXPECT_TRUE(std::isnan(sd));
    } else {
      EXPECT_GT(sd, 0);
      EXPECT_NEAR(sd * sd, std::stod(row.at("cov_tx_tx_m_m")), 1e-12 * sd * sd);
    }
  }
  EXPECT_EQ(ReadCsv(Path("out/directions.csv")).size(), 2U * 6U);
  // Four rules of six directions each; a room has none that degenerates.
  const auto judgements = ReadCsv(Path("out/degeneracy.csv"));
  ASSERT_EQ(judgements.size(), 2U * 24U);
  for (const auto& row : judgements) {
    if (row.at("rule") != "dcreg") {
      EXPECT_EQ(row.at("localizability"), "full") << row.at("rule");
    }
  }
  EXPECT_FALSE(std::filesystem::exists(Path("out/draws.csv")));
}

TEST_F(CovarianceApp, SaysWhatAPlaneLeavesOpen) {
  PointCloud plane;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      testing_support::AddPoint(Vec3(0.3 * i - 4.5, 0.3 * j - 4.5, -1.7), &plane);
    }
  }
  WritePly(folder_.path() / "plane.ply", plane);
  const Outcome outcome =
      RunProgram("covariance", {"--source=" + Path("plane.ply"), "--target=" + Path("plane.ply"),
                                "--metrics=point_to_plane", "--out=" + Path("out")});
  ASSERT_EQ(outcome.code, 4) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("verdict: undetermined: yaw, along x, along y; converged"));
  EXPECT_THAT(outcome.out, HasSubstr("do not determine all six degrees of freedom"));
  int degenerate = 0;
  for (const auto& row : ReadCsv(Path("out/degeneracy.csv"))) {
    degenerate += row.at("localizability") == "none" ? 1 : 0;
  }
  EXPECT_EQ(degenerate, 4 * 3);  // Two translations and a turn, by each of four rules.
}

TEST(CovarianceDraws, CalibrateAndWarn) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const Outcome outcome =
      RunProgram("covariance", {"--scene=straight_street", "--azimuth_step_deg=2", "--draws=4",
                                "--metrics=point_to_point,point_to_plane", "--out=" + out});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Bonnabel"));
  const auto manifest = nlohmann::json::parse(ReadFile(out + "/manifest.json"));
  EXPECT_TRUE(manifest["results"].contains("warning_point_to_point"));
  EXPECT_FALSE(manifest["results"].contains("warning_point_to_plane"));
  EXPECT_EQ(ReadCsv(out + "/draws.csv").size(), 2U * 4U);
  EXPECT_EQ(ReadCsv(out + "/bias.csv").size(), 2U * 6U);
  // The draws' own spread, and six estimators.
  const auto calibration = ReadCsv(out + "/calibration.csv");
  ASSERT_EQ(calibration.size(), 2U * 7U);
  EXPECT_EQ(calibration[0].at("estimator"), "monte_carlo");
  const double nees = manifest["results"]["nees_about_mean_point_to_plane_gauss_newton"];
  EXPECT_EQ(calibration[8].at("estimator"), "gauss_newton");
  EXPECT_EQ(std::stod(calibration[8].at("nees_about_mean")), nees);
  EXPECT_NEAR(std::stod(calibration[8].at("overconfidence")), std::sqrt(nees / 6), 1e-12);
  // Not every draw has every covariance: the screen says how many have it, and their own bounds.
  int shown = 0;
  for (const auto& row : calibration) {
    if (row.at("estimator") != "monte_carlo" && std::stoi(row.at("draws")) >= 2) {
      char text[64];
      std::snprintf(text, sizeof(text), " %d  %.2f to %.2f\n", std::stoi(row.at("draws")),
                    std::stod(row.at("mean_lower_95")), std::stod(row.at("mean_upper_95")));
      EXPECT_THAT(outcome.out, HasSubstr(text)) << row.at("estimator");
      ++shown;
    }
  }
  EXPECT_GE(shown, 6);
  EXPECT_THAT(ReadFile(out + "/covariance.svg"), HasSubstr("</svg>"));
}

TEST_F(CovarianceApp, WrongCommandLines) {
  const std::string scene = "--scene=straight_street";
  const auto refuse = [&](const std::string& flag, const std::string& says) {
    ExpectRefusal(RunProgram("covariance", {scene, flag}), 1, says);
  };
  refuse("--draws=1", "--draws=1: expected 0, or 2 to");
  refuse("--draws=-3", "--draws=-3");
  refuse("--sensor=broken", "expected one of fixed, redrawn");
  refuse("--cluster_m=0", "cluster_m=0: expected 0.01 to 1000 m");
  refuse("--rematching_step_m=nan", "rematching_step_m=nan");
  refuse("--assumed_range_noise_m=-1", "--assumed_range_noise_m=-1");
  refuse("--length_scale_m=0", "--length_scale_m=0");
  refuse("--start_deg=180", "--start_deg=180");
  for (const char* flag : {"--voxel_m=1", "--reverse=true", "--artificial_blind_spot_m=5",
                           "--ego_filter_m=5", "--elevation_correction_deg=0.2"}) {
    refuse(flag, std::string(flag) + ": expected --draws=0 with it");
  }
  refuse("--octree_voxel_m=0.1", "--octree_voxel_m=0.1: expected --draws=0 with it");
  ExpectRefusal(RunProgram("covariance", Files({"--draws=10"})), 1, "expected 0 without --scene");
  ExpectRefusal(RunProgram("covariance", {}), 1, "no input");
}

}  // namespace
}  // namespace icpscape
