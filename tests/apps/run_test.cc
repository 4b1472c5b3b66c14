// SPDX-License-Identifier: BSD-3-Clause
// The folder of a run: its files, those of earlier runs, and interruptions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "tests/apps/apps_fixture.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunningProgram;
using testing_support::RunProgram;
using testing_support::TemporaryFolder;

/// While it lives, drawing runs this Python instead of matplotlib.
class FakeMatplotlib {
 public:
  explicit FakeMatplotlib(const std::string& code) {
    folder_.Write("matplotlib.py", code);
    setenv("PYTHONPATH", folder_.path().c_str(), 1);
  }
  ~FakeMatplotlib() { unsetenv("PYTHONPATH"); }

 private:
  TemporaryFolder folder_;
};

class RunOfAProgram : public testing_support::AppsFixture {
 protected:
  // The files in out/, hidden ones too, by their paths within it.
  std::set<std::string> Out() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(Path("out"))) {
      if (!entry.is_directory()) {
        names.insert(std::filesystem::relative(entry.path(), Path("out")).string());
      }
    }
    return names;
  }
  nlohmann::json ManifestJson() const {
    return nlohmann::json::parse(ReadFile(Path("out/manifest.json")));
  }
  // A small run of each program that draws, and its figures.
  struct Drawing {
    std::string app;
    std::vector<std::string> flags, figures;
  };
  std::vector<Drawing> Drawings() const {
    const std::string out = "--out=" + Path("out");
    const std::string scene = "--scene=straight_street";
    const std::string coarse = "--azimuth_step_deg=2";
    return {
        {"landscape", Files({"--samples=3", "--iterates"}), {"landscape.svg", "iterates.png"}},
        {"register", Files(), {"iterates.svg", "iterates.png"}},
        {"covariance",
         {scene, coarse, "--metrics=point_to_plane", "--draws=4", out},
         {"covariance.svg", "covariance.png"}},
        {"filter_bias",
         {scene, coarse, "--metrics=point_to_plane", "--steps=2", "--samples=3", out},
         {"filter_bias.svg", "filter_bias.png"}},
        {"paper_figures",
         {"--figure=01_320_improved", coarse, "--samples=3", out},
         {"01_320_improved.svg", "01_320_improved.png"}},
        {"evaluate",
         {"--estimate=" + Path("kitti/poses/00.txt"),
          "--ground_truth=" + Path("kitti/poses/00.txt"), out},
         {"trajectory.svg", "trajectory.png"}},
    };
  }
};

TEST_F(RunOfAProgram, ListsWhatItWroteAndLeavesNoFigureWhereDrawingFails) {
  for (const Drawing& drawing : Drawings()) {
    std::filesystem::remove_all(Path("out"));
    const Outcome outcome = RunProgram(drawing.app, drawing.flags);
    ASSERT_EQ(outcome.code, 0) << drawing.app << ": " << outcome.err;
    std::set<std::string> listed;
    const nlohmann::json manifest = ManifestJson();
    for (const std::string name : manifest["files"]) {
      listed.insert(name);
    }
    EXPECT_THAT(listed, IsSupersetOf(drawing.figures)) << drawing.app;
    EXPECT_THAT(outcome.out, HasSubstr("\ntime: ")) << drawing.app;
    const std::size_t written = outcome.out.find("\nwritten: " + Path("out") + "/");
    ASSERT_NE(written, std::string::npos) << outcome.out;
    for (const std::string& name : listed) {
      const std::string folder = std::filesystem::path(name).parent_path().string();
      EXPECT_NE(outcome.out.find(folder.empty() ? name : folder + "/", written), std::string::npos)
          << name;
    }
    listed.insert("manifest.json");
    EXPECT_EQ(Out(), listed) << drawing.app;

    // Where drawing fails no figure is listed, and none of the earlier run is left.
    const FakeMatplotlib broken("raise ImportError\n");
    const Outcome without = RunProgram(drawing.app, drawing.flags);
    EXPECT_EQ(without.code, 0) << drawing.app;
    EXPECT_THAT(without.err, HasSubstr("No figures: ")) << drawing.app;
    for (const std::string& name : Out()) {
      EXPECT_THAT(name, AllOf(Not(HasSubstr(".svg")), Not(HasSubstr(".png")))) << drawing.app;
    }
    EXPECT_THAT(without.out, AllOf(Not(HasSubstr(".svg")), Not(HasSubstr(".png")))) << drawing.app;
  }
}

TEST_F(RunOfAProgram, DrawsTheFormatsThatAreAskedFor) {
  for (const Drawing& drawing : Drawings()) {
    if (drawing.app != "landscape" && drawing.app != "paper_figures") {
      continue;  // Drawing takes seconds, and all scripts save their figures by one function.
    }
    const auto run = [&](const char* formats) {
      std::vector<std::string> flags = drawing.flags;
      flags.push_back(std::string("--figures=") + formats);
      const Outcome outcome = RunProgram(drawing.app, flags);
      EXPECT_EQ(outcome.code, 0) << drawing.app << ": " << outcome.err;
      return outcome;
    };
    const auto has = [&](const char* extension) {
      const std::set<std::string> names = Out();
      return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
        return std::filesystem::path(name).extension() == extension;
      });
    };
    run("svg");
    EXPECT_TRUE(has(".svg") && !has(".png")) << drawing.app;
    run("png");
    EXPECT_TRUE(has(".png") && !has(".svg")) << drawing.app;
    // No Python is started: it would fail, and be told.
    const FakeMatplotlib broken("raise ImportError\n");
    EXPECT_EQ(run("none").err, "") << drawing.app;
    EXPECT_TRUE(!has(".png") && !has(".svg")) << drawing.app;
  }
  testing_support::ExpectRefusal(RunProgram("register", Files({"--figures=pdf"})), 1,
                                 "none, svg, png, all");
}

TEST_F(RunOfAProgram, RemovesWhatAnEarlierRunOfItLeftAndNothingElse) {
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3", "--iterates"})).code, 0);
  ASSERT_THAT(Out(), IsSupersetOf({"symmetric_rmse.txt", "iterates.csv", "iterates.svg"}));
  ASSERT_EQ(RunProgram("evaluate",
                       {"--estimate=" + Path("kitti/poses/00.txt"),
                        "--ground_truth=" + Path("kitti/poses/00.txt"), "--out=" + Path("other")})
                .code,
            0);
  std::filesystem::rename(Path("other/trajectory.csv"), Path("out/trajectory.csv"));
  folder_.Write("out/notes.txt", "mine");
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3", "--metrics=point_to_plane"})).code, 0);
  EXPECT_THAT(Out(), testing::UnorderedElementsAre("curves.csv", "point_to_plane_rmse.txt",
                                                   "landscape.svg", "landscape.png",
                                                   "manifest.json", "notes.txt", "trajectory.csv"));
}

TEST_F(RunOfAProgram, RemovesWhatARunThatDidNotEndHasListed) {
  folder_.Write("out/curves.csv", "old");
  folder_.Write("out/two_plane_rmse.txt", "old");
  folder_.Write("out/notes.txt", "mine");
  folder_.Write("precious.txt", "not in the folder");
  folder_.Write("out/.icpscape-landscape.written",
                "curves.csv\ntwo_plane_rmse.txt\n../precious.txt\n");
  folder_.Write("out/.icpscape-register.written", "notes.txt\n");
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3", "--metrics=symmetric"})).code, 0);
  EXPECT_THAT(Out(), testing::UnorderedElementsAre(
                         "curves.csv", "symmetric_rmse.txt", "landscape.svg", "landscape.png",
                         "manifest.json", "notes.txt", ".icpscape-register.written"));
  EXPECT_EQ(ReadFile(Path("precious.txt")), "not in the folder");
}

TEST_F(RunOfAProgram, ReadsItsInputsBeforeItRemovesThem) {
  ASSERT_EQ(RunProgram("register", Files()).code, 0);
  const double last = std::stod(ReadCsv(Path("out/iterates.csv")).back().at("cost"));
  const Outcome again =
      RunProgram("register", Files({"--initial=" + Path("out/T_target_source.txt")}));
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_NEAR(std::stod(ReadCsv(Path("out/iterates.csv")).front().at("cost")), last, 1e-12 * last);
}

// A run that is refused for its data takes no results away, but the folder is not that of a
// finished run; and the next run still knows them.
TEST_F(RunOfAProgram, KnowsEarlierResultsThroughARefusedRun) {
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3", "--iterates"})).code, 0);
  auto refused = Files({"--samples=3"});
  refused[0] = "--source=" + Path("nothing.ply");
  ASSERT_EQ(RunProgram("landscape", refused).code, 2);
  EXPECT_THAT(Out(), AllOf(Contains("iterates.csv"), Not(Contains("manifest.json"))));
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3"})).code, 0);
  EXPECT_THAT(Out(), AllOf(Not(Contains("iterates.csv")), Contains("manifest.json"),
                           Not(Contains(".icpscape-landscape.written"))));
}

TEST_F(RunOfAProgram, RecordsWhatRegisterPrints) {
  const Outcome outcome = RunProgram("register", Files());
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const SE3d T = ReadTransform(Path("out/T_target_source.txt"));
  const SE3d off = ReadTransform(Path("truth.txt")).Inverse() * T;
  const auto results = ManifestJson()["results"];
  EXPECT_NEAR(results["motion_m"], T.t().norm(), 1e-12);
  EXPECT_NEAR(results["motion_deg"], T.LogRotation().norm() * 180 / M_PI, 1e-10);
  DroppedPoints dropped;
  const PointCloud source = ReadPointFile(Path("source.ply"), &dropped);
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    middle += source.Point(i) / static_cast<double>(source.size());
  }
  const double off_m = (off * middle - middle).norm();
  EXPECT_NEAR(results["off_m"], off_m, 1e-12);
  EXPECT_NEAR(results["off_deg"], off.LogRotation().norm() * 180 / M_PI, 1e-10);
  EXPECT_LT(results["off_m"], 0.02);
  EXPECT_LT(results["off_refined_m"], 0.02);
  char text[64];
  std::snprintf(text, sizeof text, "off the ground truth: %.4f m", off_m);
  EXPECT_THAT(outcome.out, HasSubstr(text));
}

// Two pictures that differ have titles that differ.
TEST_F(RunOfAProgram, NamesChangedFlagsInTitlesAndManifest) {
  const auto title_has = [&](const std::string& app, const std::vector<std::string>& arguments,
                             const std::string& figure, const std::string& text) {
    const Outcome outcome = RunProgram(app, arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return ReadFile(Path("out/" + figure)).find(text) != std::string::npos;
  };
  const std::vector<std::string> cost = {"--samples=3", "--column=cost", "--loss=huber"};
  auto scaled = cost;
  scaled.push_back("--loss_scale_m=0.05");
  EXPECT_FALSE(title_has("landscape", Files(cost), "landscape.svg", "-loss_scale_m"));
  EXPECT_TRUE(title_has("landscape", Files(scaled), "landscape.svg", "-loss_scale_m=0.05"));
  const auto manifest = ManifestJson();
  EXPECT_EQ(manifest["changed_flags"]["loss_scale_m"], "0.05");
  EXPECT_FALSE(manifest["changed_flags"].contains("out"));
  EXPECT_FALSE(manifest["changed_flags"].contains("kept_fraction"));
  EXPECT_TRUE(
      title_has("register", Files({"--kept_fraction=0.9"}), "iterates.svg", "-kept_fraction=0.9"));
  for (const std::string flag :
       {"range_noise_m=0.02", "ring_bias_m=0.03", "dropout=0.2", "azimuth_step_deg=3"}) {
    const std::vector<std::string> arguments = {"--scene=right_turn",   "--azimuth_step_deg=2",
                                                "--samples=2",          "--metrics=point_to_point",
                                                "--out=" + Path("out"), "--" + flag};
    EXPECT_TRUE(title_has("landscape", arguments, "landscape.svg", "-" + flag)) << flag;
  }
  // What does not change the picture is not named: the RMSE is without loss.
  EXPECT_FALSE(title_has("landscape", Files({"--samples=3", "--loss=huber"}), "landscape.svg",
                         "-loss=huber"));
}

void WaitFor(const std::function<bool()>& is_true) {
  for (int i = 0; i < 6000 && !is_true(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  ASSERT_TRUE(is_true());
}

void ExpectInterrupted(const Outcome& outcome, int code, const std::string& signal) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(": interrupted by " + signal + " before it was done; "));
}

TEST_F(RunOfAProgram, EndsCleanlyWhereItIsInterruptedAtWork) {
  RunningProgram program("landscape", Files({"--samples=1000000"}));
  WaitFor([&] { return std::filesystem::exists(Path("out")); });
  program.Signal(SIGINT);
  ExpectInterrupted(program.Wait(), 130, "SIGINT");
  EXPECT_THAT(Out(), IsEmpty());
}

TEST_F(RunOfAProgram, EndsCleanlyWhereItIsInterruptedAtAFigure) {
  {
    // Python that draws for an hour.
    const FakeMatplotlib slow("import time\nopen('" + Path("drawing") +
                              "', 'w').close()\ntime.sleep(3600)\n");
    RunningProgram program("landscape", Files({"--samples=3", "--metrics=two_plane"}));
    WaitFor([&] { return std::filesystem::exists(Path("drawing")); });
    program.Signal(SIGTERM);
    ExpectInterrupted(program.Wait(), 143, "SIGTERM");
  }
  EXPECT_THAT(Out(), testing::UnorderedElementsAre("curves.csv", "two_plane_rmse.txt",
                                                   ".icpscape-landscape.written"));
  for (const auto& entry : std::filesystem::directory_iterator(Path("out"))) {
    EXPECT_FALSE(entry.is_directory()) << entry.path();
  }
  EXPECT_EQ(ReadCsv(Path("out/curves.csv")).size(), 3U);
  ASSERT_EQ(RunProgram("landscape", Files({"--samples=3", "--metrics=symmetric"})).code, 0);
  EXPECT_THAT(Out(),
              testing::UnorderedElementsAre("curves.csv", "symmetric_rmse.txt", "landscape.svg",
                                            "landscape.png", "manifest.json"));
}

}  // namespace
}  // namespace icpscape
