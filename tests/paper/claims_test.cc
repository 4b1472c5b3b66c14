// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "icpscape/common/error.h"
#include "icpscape/paper/figures.h"

namespace icpscape {
namespace {

// Minimum `depth_0` deep at 0 and `depth_1` at 1, over a slope of `outer` further out.
Curve Wells(const std::string& metric, double depth_0, double depth_1, double outer = 0.1) {
  const CurveOptions options;
  Curve curve;
  curve.metric = metric;
  for (int i = 0; i < options.samples; ++i) {
    CurvePoint point;
    point.u = options.U(i);
    const double well_0 = depth_0 * std::max(0.0, 1 - 2 * std::abs(point.u));
    const double well_1 = depth_1 * std::max(0.0, 1 - 2 * std::abs(point.u - 1));
    point.rmse = 0.6 + outer * std::abs(point.u - 0.5) - well_0 - well_1;
    curve.points.push_back(point);
  }
  return curve;
}

/// All curves with one well at 1.
ClaimInputs Ideal() {
  ClaimInputs inputs;
  for (const Figure& figure : PaperFigures()) {
    for (const FigureCurve& curve : figure.curves) {
      inputs.curves[curve.file] = Wells(curve.metric, 0, 0.3);
    }
    inputs.motions[figure.name] = SE3d::Exp((Vec6() << 0, 0, -0.04, 0.4, 0, 0).finished());
  }
  return inputs;
}

std::map<std::string, Claim> ById(const ClaimInputs& inputs) {
  std::map<std::string, Claim> result;
  for (const Claim& claim : EvaluateClaims(inputs)) {
    EXPECT_TRUE(result.emplace(claim.id, claim).second) << claim.id;
    EXPECT_THAT(claim.statement + claim.measured, Not(testing::HasSubstr(",")));
    EXPECT_THAT(claim.statement + claim.measured, Not(testing::HasSubstr("|")));
  }
  return result;
}

std::string Outcome(const std::map<std::string, Claim>& claims, const std::string& id) {
  return OutcomeName(claims.at(id).outcome);
}

TEST(Claims, AreAllThere) {
  std::set<std::string> expected;
  const auto add = [&](const std::string& prefix, const std::string& letters) {
    for (const char letter : letters) {
      expected.insert(prefix + letter);
    }
  };
  add("F1", "abcdefghij");
  add("F2", "abcdef");
  add("F3", "abcdefg");
  add("F4", "abcde");
  add("F5", "abcd");
  add("F6", "abcdefg");
  add("C", "123456");
  expected.insert({"F1c+", "F4+"});
  std::set<std::string> ids;
  for (const auto& entry : ById(Ideal())) {
    ids.insert(entry.first);
  }
  EXPECT_EQ(ids, expected);
}

TEST(Claims, WhereEverythingIsIdealOnlyTheGoodOnesHold) {
  const auto claims = ById(Ideal());
  for (const char* id :
       {"F1a", "F1e", "F1i", "F1j", "F2a", "F2f", "F3c", "F3f", "F3g", "F4e", "C1", "F6a", "F6e"}) {
    EXPECT_EQ(Outcome(claims, id), "holds") << id << " " << claims.at(id).measured;
  }
  for (const char* id : {"F1c", "F1c+", "F1f", "F1h", "F3a", "F4a", "F4c", "F4+", "F5a", "F5c",
                         "F6f", "F6g", "C2", "C3", "C4", "C5", "C6"}) {
    EXPECT_EQ(Outcome(claims, id), "does not hold") << id << " " << claims.at(id).measured;
  }
  EXPECT_EQ(claims.at("F1a").measured, "u* = 1.000");
}

TEST(Claims, FollowThePapersHighway) {
  ClaimInputs inputs = Ideal();
  const auto set = [&](const std::string& file, double depth_0, double depth_1) {
    Curve& curve = inputs.curves.at(file);
    curve = Wells(curve.metric, depth_0, depth_1);
  };
  set("1_320_POINT_POINT_rmse", 0.3, 0);
  set("1_320_POINT_POINT_reciprocal", 0.3, 0.1);
  set("1_320_POINT_POINT_blind_spot", 0.3, 0);
  set("1_320_PLANARPLANAR_rmse", 0.3, 0);
  set("1_320_EDGEEDGELINESEGMENT_rmse", 0.3, 0.1);
  set("1_420_EDGEEDGELINESEGMENT_edges", 0.3, 0.2);
  set("1_420_PLANARPLANAR", 0.4, 0);
  set("1_420_SYMM", 0.3, 0);
  set("1_420_POINT_PLANE", 0.3, 0);
  set("1_420_POINT_POINT", 0.4, 0);
  set("1_420_POINT_POINT_ocf_rmse", 0, 0.4);
  const auto claims = ById(inputs);
  for (const char* id :
       {"F3a", "F3b", "F3c", "F3d", "F3e", "F3f", "F4a", "F4b", "F4c", "F4d", "F4e",
        "F4+", "F5a", "F5b", "F5c", "F5d", "F6f", "F6g", "C4",  "C5",  "C6"}) {
    EXPECT_EQ(Outcome(claims, id), "holds") << id << " " << claims.at(id).measured;
  }
  EXPECT_EQ(Outcome(claims, "C3"), "does not hold") << "edge is at 0 as often as planar";
}

TEST(Claims, SymmetricMustBeMoreThanTwiceAsSteepToBeatItsFactor) {
  ClaimInputs inputs = Ideal();
  inputs.curves.at("0_1500_SYMM_rmse") = Wells("symmetric", 0, 0.5);
  auto claims = ById(inputs);
  EXPECT_EQ(Outcome(claims, "F1c"), "holds");
  EXPECT_EQ(Outcome(claims, "F1c+"), "does not hold");
}

TEST(Claims, OfFiguresThatAreNotDrawn) {
  ClaimInputs inputs = Ideal();
  inputs.curves.erase("1_420_SYMM");
  const auto claims = ById(inputs);
  EXPECT_EQ(Outcome(claims, "F5a"), "not drawn");
  EXPECT_EQ(Outcome(claims, "F6g"), "not drawn");
  EXPECT_EQ(Outcome(claims, "C3"), "not drawn");
  EXPECT_EQ(Outcome(claims, "F6a"), "holds");
  EXPECT_EQ(Outcome(claims, "C1"), "holds");
}

TEST(Claims, MarkdownCountsThem) {
  const std::string text = ClaimsMarkdown(EvaluateClaims(Ideal()), "a drawing board");
  EXPECT_THAT(text, testing::StartsWith("# The paper's claims on a drawing board\n"));
  EXPECT_THAT(text, testing::HasSubstr("| F1a | plane: global minimum at u ~ 1 | u* = 1.000 | "
                                       "holds |\n"));
}

TEST(Figures, AreThePapersSix) {
  EXPECT_EQ(FiguresFromName("all").size(), 6U);
  EXPECT_EQ(FiguresFromName("01_420_octree")[0].scene, "highway_overtaking");
  EXPECT_THROW(FiguresFromName("02_1"), UsageError);
}

TEST(Figures, StandaloneLatexReadsTheTablesOfThePaper) {
  const std::string text = StandaloneLatex(FiguresFromName("01_320_improved")[0]);
  EXPECT_THAT(text, testing::HasSubstr("table{data/1_320_POINT_POINT_offlineOverlap_6.txt}"));
  EXPECT_THAT(text, Not(testing::HasSubstr("blind_spot"))) << "our own curve, not the paper's";
  EXPECT_THAT(StandaloneLatex(FiguresFromName("00_1500")[0]),
              testing::HasSubstr("ymin=0.1, ymax=0.9"));
}

}  // namespace
}  // namespace icpscape
