// SPDX-License-Identifier: BSD-3-Clause
// icpscape-landscape --iterates: the closed loop drawn over the open loop.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "icpscape/common/text.h"
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

std::vector<std::string> Turn(const TemporaryFolder& out, std::vector<std::string> more) {
  more.insert(more.begin(), {"--scene=right_turn", "--azimuth_step_deg=0.72",
                             "--metrics=point_to_plane", "--out=" + out.path().string()});
  return more;
}

TEST(Iterates, RunFromTheStartToTheReferenceAndAreThoseOfRegister) {
  const TemporaryFolder landscape, registered;
  const std::vector<std::string> curve = {"--iterates", "--u_min=0", "--u_max=1", "--samples=3"};
  const Outcome outcome = RunProgram("landscape", Turn(landscape, curve));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(RunProgram("register", Turn(registered, {})).code, 0);
  const auto iterates = ReadCsv((landscape.path() / "iterates.csv").string());
  const auto by_register = ReadCsv((registered.path() / "iterates.csv").string());
  ASSERT_EQ(iterates.size(), by_register.size());
  ASSERT_GT(iterates.size(), 3U);
  for (std::size_t i = 0; i < iterates.size(); ++i) {
    for (const char* column : {"iteration", "rmse", "cost", "n", "step_m", "qz", "tx_m"}) {
      EXPECT_EQ(iterates[i].at(column), by_register[i].at(column));
    }
  }
  // The start lies on the path, where the curve has the same value.
  const auto start = ReadCsv((landscape.path() / "curves.csv").string()).front();
  EXPECT_EQ(start.at("u"), "0");
  EXPECT_EQ(std::stod(iterates.front().at("u")), 0);
  EXPECT_EQ(std::stod(iterates.front().at("off_path_m")), 0);
  EXPECT_NEAR(std::stod(iterates.front().at("rmse")), std::stod(start.at("rmse")), 1e-12);
  EXPECT_NEAR(std::stod(iterates.back().at("u")), 1, 0.02);
  EXPECT_LT(std::stod(iterates.back().at("off_path_m")), 0.01);
  // On the way it left the path.
  double farthest = 0;
  for (const auto& row : iterates) {
    farthest = std::max(farthest, std::stod(row.at("off_path_m")));
  }
  EXPECT_GT(farthest, 0.02);
  const auto manifest = nlohmann::json::parse(ReadFile(landscape.path() / "manifest.json"));
  EXPECT_NEAR(manifest["results"]["iterates_end_u_point_to_plane"].get<double>(),
              std::stod(iterates.back().at("u")), 1e-12);
  for (const char* figure : {"landscape.svg", "iterates.svg"}) {
    EXPECT_THAT(ReadFile(landscape.path() / figure), HasSubstr("</svg>"));
  }
  EXPECT_THAT(ReadFile(landscape.path() / "landscape.svg"), HasSubstr("off path"));
}

// In traffic pairs change along the path: the solver ends where the gradient of its pairs vanishes,
// and not where the curve is lowest (docs/experiments/iterates_on_the_curve.md).
TEST(Iterates, EndWhereTheGradientVanishesAndNotAtTheCurvesMinimum) {
  const TemporaryFolder out;
  ASSERT_EQ(RunProgram("landscape",
                       {"--scene=highway_overtaking", "--metrics=point_to_plane", "--iterates",
                        "--u_min=0", "--u_max=1", "--samples=41", "--out=" + out.path().string()})
                .code,
            0);
  const double end = std::stod(ReadCsv((out.path() / "iterates.csv").string()).back().at("u"));
  double zero_of_slope = -1, argmin = -1, least = 1e9, slope_before = 0;
  for (const auto& row : ReadCsv((out.path() / "curves.csv").string())) {
    const double u = std::stod(row.at("u"));
    const double slope = std::stod(row.at("slope_analytic"));
    if (slope_before < 0 && slope >= 0 && u > 0.1) {
      zero_of_slope = u;
    }
    slope_before = slope;
    if (std::stod(row.at("rmse")) < least) {
      least = std::stod(row.at("rmse"));
      argmin = u;
    }
  }
  EXPECT_NEAR(end, zero_of_slope, 0.05);
  EXPECT_GT(end - argmin, 0.15);
}

TEST(Iterates, LeaveNothingForARunWithoutThem) {
  const TemporaryFolder out;
  const std::vector<std::string> files = {"iterates.csv", "iterates.svg", "iterates.png"};
  ASSERT_EQ(RunProgram("landscape", Turn(out, {"--samples=2", "--iterates"})).code, 0);
  for (const std::string& file : files) {
    EXPECT_TRUE(std::filesystem::exists(out.path() / file)) << file;
  }
  ASSERT_EQ(RunProgram("landscape", Turn(out, {"--samples=2"})).code, 0);
  for (const std::string& file : files) {
    EXPECT_FALSE(std::filesystem::exists(out.path() / file)) << file;
  }
  EXPECT_THAT(ReadFile(out.path() / "landscape.svg"), Not(HasSubstr("off path")));
}

TEST(Iterates, WrongCommandLines) {
  const TemporaryFolder out;
  const auto refuse = [&](const std::vector<std::string>& flags, const std::string& says) {
    ExpectRefusal(RunProgram("landscape", Turn(out, flags)), 1, says);
  };
  refuse({"--max_iterations=3"}, "--max_iterations=3: expected --iterates with it");
  refuse({"--dof=planar"}, "--dof=planar: expected --iterates with it");
  refuse({"--iterates", "--max_iterations=0"}, "--max_iterations");
  refuse({"--weights=2"}, "unknown command line flag 'weights'");  // Each metric has a curve.
  refuse({"--iterates", "--column=epsilon"}, "expected rmse or cost with --iterates");
  refuse({"--iterates", "--association=frozen"}, "expected reassociate with --iterates");
  refuse({"--iterates", "--patch_offset=none"}, "expected per_term with --iterates");
}

}  // namespace
}  // namespace icpscape
