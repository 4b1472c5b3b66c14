// SPDX-License-Identifier: BSD-3-Clause
// Verdicts and exit codes of the programs, on small inputs of which one knows what they determine.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "tests/apps/apps_fixture.h"

namespace icpscape {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing_support::AddPoint;
using testing_support::ExpectRefusal;
using testing_support::Outcome;
using testing_support::ReadCsv;
using testing_support::ReadFile;
using testing_support::RunProgram;

class AppsVerdict : public testing_support::AppsFixture {
 protected:
  // Two samplings of a corridor along x, without ends, the second seen from 0.3 m ahead.
  std::vector<std::string> Corridor(std::vector<std::string> more = {}) const {
    for (const unsigned seed : {1U, 2U}) {
      std::mt19937 engine(seed);
      std::uniform_real_distribution<double> unit(0, 1);
      std::normal_distribution<double> noise(0, 0.005);
      PointCloud cloud;
      for (int i = 0; i < 6000; ++i) {
        const double x = 30 * unit(engine) - 15;
        const double across = unit(engine);
        const Vec3 p = i % 2 == 0 ? Vec3(x, i % 4 == 0 ? -2 : 2, 3 * across - 1.7)
                                  : Vec3(x, 4 * across - 2, i % 4 == 1 ? -1.7 : 1.3);
        AddPoint(p + Vec3(seed == 2 ? 0.3 : 0, noise(engine), noise(engine)), &cloud);
      }
      WritePly(Path("corridor" + std::to_string(seed) + ".ply"), cloud);
    }
    more.insert(more.begin(), {"--source=" + Path("corridor2.ply"),
                               "--target=" + Path("corridor1.ply"), "--out=" + Path("out")});
    return more;
  }
};

TEST_F(AppsVerdict, AHealthyPairIsDeterminedAndEndsWithZero) {
  const Outcome outcome = RunProgram("register", Files());
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("verdict: determined, converged, 100 % of the points"));
  const auto results = nlohmann::json::parse(ReadFile(Path("out/manifest.json")))["results"];
  EXPECT_EQ(results["undetermined"], "");
  EXPECT_EQ(results["converged"], "yes");
  EXPECT_EQ(results["matched_share"], 1);
  const auto rows = ReadCsv(Path("out/verdict.csv"));
  ASSERT_EQ(rows.size(), 6U);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("status"), "determined");
    EXPECT_LT(std::stod(row.at("deviation")), 5e-3);
    EXPECT_GT(std::stod(row.at("deviation")), 1e-6);
  }
}

TEST_F(AppsVerdict, ACorridorEndsWithFourUnlessItIsAccepted) {
  const Outcome outcome = RunProgram("register", Corridor());
  ExpectRefusal(outcome, 4, "undetermined: along x;");
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("x undetermined"), HasSubstr("written: ")));
  bool named = false;
  for (const auto& row : ReadCsv(Path("out/verdict.csv"))) {
    if (row.at("is_axis") == "1") {
      EXPECT_EQ(row.at("status"), row.at("direction") == "x" ? "undetermined" : "determined");
    } else {
      named = named || row.at("direction") == "along x";
    }
  }
  EXPECT_TRUE(named);
  EXPECT_EQ(RunProgram("register", Corridor({"--accept=undetermined,limit,cycle"})).code, 0);
  EXPECT_EQ(
      RunProgram("register", Corridor({"--dof=roll,pitch,yaw,y,z", "--accept=limit,cycle"})).code,
      0);
  EXPECT_EQ(RunProgram("register", Files({"--max_iterations=1"})).code, 4);
  EXPECT_EQ(RunProgram("register", Files({"--max_iterations=1", "--accept=cycle"})).code, 4);
  EXPECT_EQ(RunProgram("register", Files({"--max_iterations=1", "--accept=limit"})).code, 0);
  EXPECT_EQ(RunProgram("register", Files({"--tolerance_m=1e-6"})).code, 4);
  ExpectRefusal(RunProgram("register", Files({"--accept=all"})), 1,
                "expected one of undetermined, limit, cycle");
  ExpectRefusal(RunProgram("register", Files({"--tolerance_deg=0"})), 1, "--tolerance_deg=0");
}

TEST_F(AppsVerdict, CovarianceGivesNoDeviationWhereNothingIsDetermined) {
  const Outcome outcome = RunProgram("covariance", Corridor({"--metrics=point_to_plane"}));
  EXPECT_EQ(outcome.code, 4) << outcome.err;
  for (const auto& row : ReadCsv(Path("out/covariance.csv"))) {
    EXPECT_EQ(row.at("sd_tx_m"), "nan") << row.at("estimator");
    if (row.at("estimator") == "gauss_newton") {
      EXPECT_LT(std::stod(row.at("sd_ty_m")), 5e-3);
    }
  }
}

TEST_F(AppsVerdict, CovarianceOfOneCloudWithItselfSaysWhyThereIsNone) {
  const Outcome outcome =
      RunProgram("covariance", {"--source=" + Path("source.ply"), "--target=" + Path("source.ply"),
                                "--metrics=point_to_plane", "--out=" + Path("out")});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("verdict: determined, converged"));
  EXPECT_THAT(outcome.out, HasSubstr("gauss_newton        none: all residuals are zero"));
}

}  // namespace
}  // namespace icpscape
