// SPDX-License-Identifier: BSD-3-Clause
// --help: the flags of a program, by group, and their defaults.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>

#include "tests/support/run_program.h"

namespace icpscape {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing_support::Outcome;
using testing_support::RunProgram;

struct FlagOfHelp {
  std::string group, default_value;
};

// Flags by name, as --help lists them.
std::map<std::string, FlagOfHelp> FlagsOf(const std::string& app) {
  std::istringstream in(RunProgram(app, {"--help"}).out);
  const std::regex heading("(\\S.*):");
  const std::regex flag("  --(\\w+)  \\(\\w+, default (.*)\\)");
  std::map<std::string, FlagOfHelp> flags;
  std::string line, group;
  std::smatch match;
  while (std::getline(in, line)) {
    if (std::regex_match(line, match, heading)) {
      group = match[1];
    } else if (std::regex_match(line, match, flag)) {
      flags[match[1]] = {group, match[2]};
    }
  }
  return flags;
}

TEST(AppsHelp, IsGroupedByTheFilesThatDefineTheFlags) {
  auto flags = FlagsOf("landscape");
  EXPECT_EQ(flags["iterates"].group, "icpscape-landscape");  // Only this program has it.
  EXPECT_EQ(flags["reference"].group, "icpscape-landscape");
  EXPECT_EQ(flags["u_min"].group, "Curve along the path");
  EXPECT_EQ(flags["frozen_u"].group, "Curve along the path");
  EXPECT_EQ(flags["range_noise_m"].group, "Simulated lidar");
  EXPECT_EQ(flags["loss"].group, flags["metrics"].group);
  EXPECT_NE(flags["loss"].group, flags["kept_fraction"].group);
  // Each group has one heading, and no flag comes before the first.
  const std::string help = RunProgram("landscape", {"--help"}).out;
  for (const auto& [name, flag] : flags) {
    EXPECT_FALSE(flag.group.empty()) << name;
    const std::string heading = "\n" + flag.group + ":\n";
    EXPECT_EQ(help.find(heading), help.rfind(heading)) << heading;
  }
  EXPECT_LT(help.find("icpscape-landscape:\n"), help.find("Curve along the path:\n"));
}

TEST(AppsHelp, PrintsNumbersAsOneTypesThem) {
  auto flags = FlagsOf("covariance");
  EXPECT_EQ(flags["loss_scale_m"].default_value, "0.1");
  EXPECT_EQ(flags["assumed_range_noise_m"].default_value, "0.009");
  EXPECT_EQ(flags["fit_max_smallest_eigenvalue_m2"].default_value, "1e-4");
  EXPECT_EQ(flags["planar_below"].default_value, "none");
  EXPECT_EQ(flags["samples"].default_value, "");  // Not a flag of this program.
  for (const auto& [name, flag] : flags) {
    EXPECT_LT(flag.default_value.size(), 50U) << name << " " << flag.default_value;
    EXPECT_THAT(flag.default_value, Not(HasSubstr("0000000"))) << name;
  }
}

// A flag that takes one of several names: its help has every name that its error message lists.
TEST(AppsHelp, NamesEveryChoice) {
  const std::pair<const char*, const char*> choices[] = {
      {"landscape", "path"},         {"landscape", "patch_offset"},
      {"landscape", "smoothness"},   {"landscape", "smoothness_neighborhood"},
      {"landscape", "feature_caps"}, {"landscape", "fit_eigenvalue_scale"},
      {"landscape", "fit_anchor"},   {"register", "loss"},
      {"odometry", "mode"},          {"odometry", "prediction"},
      {"covariance", "sensor"},
  };
  for (const auto& [app, flag] : choices) {
    const Outcome refused =
        RunProgram(app, {"--scene=right_turn", std::string("--") + flag + "=x"});
    std::smatch listed;
    ASSERT_TRUE(std::regex_search(refused.err, listed, std::regex("expected one of ([^.]*)\\.")))
        << flag << ": " << refused.err;
    const std::string help = RunProgram(app, {"--help"}).out;
    const std::size_t begin = help.find(std::string("--") + flag + "  (");
    const std::string text = help.substr(begin, help.find("\n  --", begin) - begin);
    std::istringstream names(listed[1]);
    for (std::string name; std::getline(names >> std::ws, name, ',');) {
      EXPECT_THAT(text, HasSubstr(name)) << flag;
    }
  }
}

TEST(AppsHelp, MeansTheSameEverywhere) {
  for (const std::string app : {"landscape", "register", "simulate", "paper_figures", "filter_bias",
                                "covariance", "odometry", "evaluate"}) {
    auto flags = FlagsOf(app);
    EXPECT_EQ(flags["out"].default_value, "out/" + app);
    EXPECT_EQ(flags["out"].group, "Run") << app;
    EXPECT_TRUE(flags.count("octree_voxel_m") == 0 ||
                flags["octree_voxel_m"].default_value == (app == "filter_bias" ? "0.1" : "0"))
        << app;
    EXPECT_EQ(flags["threads"].group, "Run") << app;
    EXPECT_EQ(flags["threads"].default_value, "0") << app;
  }
  EXPECT_EQ(FlagsOf("paper_figures").count("source"), 0U);  // It has --kitti_root.
  EXPECT_EQ(FlagsOf("register")["start_m"].default_value,
            FlagsOf("covariance")["start_m"].default_value);
}

TEST(AppsHelp, EndsWithTheExitCodesAndLeavesOutTheLibraries) {
  for (const char* app : {"landscape", "register", "list_metrics"}) {
    const Outcome outcome = RunProgram(app, {"--help"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Exit codes: 0 done"));
    EXPECT_THAT(outcome.out, HasSubstr("130 interrupted"));
    EXPECT_THAT(outcome.out, Not(HasSubstr("logtostderr")));
  }
}

}  // namespace
}  // namespace icpscape
