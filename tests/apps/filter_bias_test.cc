// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;
using testing_support::TemporaryFolder;

// Measured: along the path the Octree Correspondence Filter returns its predicted pose.
TEST(FilterBiasApp, MinimumFollowsThePredictedPoseAlongThePath) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  const Outcome outcome = RunProgram(
      "filter_bias", {"--scene=highway_overtaking", "--azimuth_step_deg=0.72", "--steps=3",
                      "--samples=21", "--metrics=point_to_point,point_to_plane", "--out=" + out});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto manifest = nlohmann::json::parse(ReadFile(out + "/manifest.json"));
  EXPECT_NEAR(manifest["results"]["slope_along_path_point_to_point"], 1, 0.1);
  EXPECT_NEAR(manifest["results"]["slope_along_path_point_to_plane"], 1, 0.2);
  // What is left of the moving objects lies where their two poses overlap.
  const double kept = manifest["results"]["moving_kept"];
  EXPECT_GT(kept, 100);
  EXPECT_GT(manifest["results"]["moving_kept_overlapping"].get<double>(), 0.98 * kept);
  // Two sweeps of two metrics: unfiltered, and with three estimates.
  EXPECT_EQ(ReadCsv(out + "/filter_bias.csv").size(), 16U);
  EXPECT_THAT(ReadFile(out + "/filter_bias.svg"), HasSubstr("</svg>"));
  EXPECT_THAT(outcome.out, HasSubstr("recall"));
}

TEST(FilterBiasApp, WrongCommandLines) {
  const std::string scene = "--scene=highway";
  ExpectRefusal(RunProgram("filter_bias", {scene, "--steps=1"}), 1, "--steps=1");
  ExpectRefusal(RunProgram("filter_bias", {scene, "--samples=2"}), 1, "--samples=2");
  ExpectRefusal(RunProgram("filter_bias", {scene, "--octree_voxel_m=0"}), 1, "positive length");
  ExpectRefusal(RunProgram("filter_bias", {}), 1, "no input");
}

}  // namespace
}  // namespace icpscape
