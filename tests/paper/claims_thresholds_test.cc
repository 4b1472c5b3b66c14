// SPDX-License-Identifier: BSD-3-Clause
// Which curve each claim is about, and the value at which it turns. Curves have samples at every
// hundredth of u.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "icpscape/paper/claims.h"
#include "icpscape/paper/figures.h"

namespace icpscape {
namespace {

// A valley with its floor at u*, and no other minimum. `slope` is that of both sides.
Curve Valley(double u_star, double slope = 0.1, double floor = 0.3) {
  CurveOptions options;
  options.samples = 301;
  Curve curve;
  for (int i = 0; i < options.samples; ++i) {
    CurvePoint point;
    point.u = options.U(i);
    point.rmse = floor + slope * std::abs(point.u - u_star);
    curve.points.push_back(point);
  }
  return curve;
}

// All claims on curves of which those in `changed` differ from a valley at 1.
std::map<std::string, std::string> OutcomesWith(const std::map<std::string, Curve>& changed,
                                                const std::map<std::string, SE3d>& motions = {}) {
  ClaimInputs inputs;
  for (const Figure& figure : PaperFigures()) {
    for (const FigureCurve& curve : figure.curves) {
      inputs.curves[curve.file] = Valley(1);
    }
    inputs.motions[figure.name] = SE3d();
  }
  for (const auto& [file, curve] : changed) {
    EXPECT_EQ(inputs.curves.count(file), 1U) << file;
    inputs.curves[file] = curve;
  }
  for (const auto& [figure, motion] : motions) {
    inputs.motions[figure] = motion;
  }
  std::map<std::string, std::string> outcomes;
  for (const Claim& claim : EvaluateClaims(inputs)) {
    outcomes[claim.id] = OutcomeName(claim.outcome);
  }
  return outcomes;
}

bool Holds(const std::string& id, const std::map<std::string, Curve>& changed) {
  return OutcomesWith(changed).at(id) == "holds";
}

// "Global minimum at u ~ x": within 0.1 of it.
TEST(ClaimThresholds, GlobalMinimaAreThoseOfTheirCurves) {
  struct OfCurve {
    const char* id;
    const char* file;
    double x;
  };
  for (const OfCurve& claim : {
           OfCurve{"F1a", "0_1500_POINT_PLANE_rmse", 1},
           OfCurve{"F1b", "0_1500_SYMM_rmse", 1},
           OfCurve{"F1d", "0_1500_EDGEEDGELINESEGMENT_rmse", 1},
           OfCurve{"F1e", "0_1500_PLANARPLANAR_rmse", 1},
           OfCurve{"F2a", "0_100_EDGEEDGELINESEGMENT_rmse", 1},
           OfCurve{"F2b", "0_100_PLANARPLANAR_rmse", 1},
           OfCurve{"F2c", "0_100_SYMM_rmse", 1},
           OfCurve{"F2d", "0_100_POINT_PLANE_rmse", 1},
           OfCurve{"F2e", "0_100_POINT_POINT_rmse", 1},
           OfCurve{"F3a", "1_320_POINT_POINT_rmse", 0},
           OfCurve{"F3b", "1_320_PLANARPLANAR_rmse", 0},
           OfCurve{"F3c", "1_320_POINT_PLANE_rmse", 1},
           OfCurve{"F3d", "1_320_SYMM_rmse", 1},
           OfCurve{"F3e", "1_320_EDGEEDGELINESEGMENT_rmse", 0},
           OfCurve{"F4a", "1_320_POINT_POINT_rmse", 0},
           OfCurve{"F4b", "1_320_POINT_POINT_reciprocal", 0},
           OfCurve{"F4e", "1_320_POINT_POINT_offlineOverlap_6", 1},
           OfCurve{"F4+", "1_320_POINT_POINT_blind_spot", 0},
           OfCurve{"F6a", "1_420_EDGEEDGELINESEGMENT_ocf_rmse", 1},
           OfCurve{"F6b", "1_420_PLANARPLANAR_ocf_rmse", 1},
           OfCurve{"F6c", "1_420_SYMM_ocf_rmse", 1},
           OfCurve{"F6d", "1_420_POINT_PLANE_ocf_rmse", 1},
           OfCurve{"F6e", "1_420_POINT_POINT_ocf_rmse", 1},
       }) {
    for (const double off : {0.0, 0.1, -0.1}) {
      EXPECT_TRUE(Holds(claim.id, {{claim.file, Valley(claim.x + off)}})) << claim.id << off;
    }
    for (const double off : {0.11, -0.11, 0.5}) {
      EXPECT_FALSE(Holds(claim.id, {{claim.file, Valley(claim.x + off)}})) << claim.id << off;
    }
  }
}

// "Local minimum at u ~ x": within 0.15 of it.
TEST(ClaimThresholds, LocalMinimaAreThoseOfTheirCurves) {
  struct OfCurve {
    const char* id;
    const char* file;
    double x;
  };
  for (const OfCurve& claim : {OfCurve{"F1f", "0_1500_EDGEEDGELINESEGMENT_rmse", 0},
                               OfCurve{"F1g", "0_1500_PLANARPLANAR_rmse", 0},
                               OfCurve{"F3f", "1_320_EDGEEDGELINESEGMENT_rmse", 1},
                               OfCurve{"F5b", "1_420_EDGEEDGELINESEGMENT_edges", 1}}) {
    for (const double off : {0.15, -0.15}) {
      EXPECT_TRUE(Holds(claim.id, {{claim.file, Valley(claim.x + off)}})) << claim.id << off;
    }
    for (const double off : {0.16, -0.16, 0.5}) {
      EXPECT_FALSE(Holds(claim.id, {{claim.file, Valley(claim.x + off)}})) << claim.id << off;
    }
  }
}

TEST(ClaimThresholds, PointIsALittleOffInAStraightStreet) {
  const std::string point = "0_1500_POINT_POINT_rmse";
  for (const double side : {1.0, -1.0}) {
    const auto holds = [&](const std::string& id, double off) {
      return Holds(id, {{point, Valley(1 + side * off)}});
    };
    EXPECT_FALSE(holds("F1h", 0.02));
    EXPECT_TRUE(holds("F1h", 0.03));
    EXPECT_TRUE(holds("F1h", 0.3));
    EXPECT_FALSE(holds("F1h", 0.31));
    EXPECT_FALSE(holds("C2", 0));
    EXPECT_TRUE(holds("C2", 0.01));
    EXPECT_TRUE(holds("C2", 0.3));
    EXPECT_FALSE(holds("C2", 0.31));
  }
  Curve two = Valley(1);
  for (CurvePoint& p : two.points) {
    p.rmse = std::min(p.rmse, 0.35 + 0.1 * std::abs(p.u));
  }
  EXPECT_TRUE(Holds("F1i", {}));
  EXPECT_FALSE(Holds("F1i", {{point, two}}));
}

TEST(ClaimThresholds, ValuesOfTheStraightStreetAreWithinATenthAndNineTenths) {
  for (const char* file : {"0_1500_EDGEEDGELINESEGMENT_rmse", "0_1500_POINT_POINT_rmse"}) {
    const auto holds = [&](double low, double high) {
      return Holds("F1j", {{file, Valley(-1, (high - low) / 3, low)}});
    };
    EXPECT_TRUE(holds(0.101, 0.899)) << file;
    EXPECT_FALSE(holds(0.099, 0.899)) << file;
    EXPECT_FALSE(holds(0.101, 0.901)) << file;
  }
}

TEST(ClaimThresholds, TheTurnIsToTheRightWithLittleTranslation) {
  const auto holds = [](double yaw_rad, double length_m) {
    const SE3d motion(Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix(),
                      Vec3(0.6, -0.8, 0) * length_m);
    return OutcomesWith({}, {{"00_100", motion}}).at("F2f") == "holds";
  };
  EXPECT_TRUE(holds(-0.01, 0.49));
  EXPECT_FALSE(holds(-0.01, 0.51));
  EXPECT_FALSE(holds(0.01, 0.49));
}

TEST(ClaimThresholds, InATurnMinimaLieWithinATenth) {
  const auto holds = [](double low, double high) {
    return Holds("C1",
                 {{"0_100_SYMM_rmse", Valley(low)}, {"0_100_POINT_POINT_rmse", Valley(high)}});
  };
  EXPECT_TRUE(holds(0.95, 1.05));
  EXPECT_FALSE(holds(0.95, 1.06));
}

// Slopes of both flanks.
TEST(ClaimThresholds, SteepestAreToldByTheirFlanks) {
  const auto street = [](const std::string& id, double symmetric) {
    return Holds(id, {{"0_1500_SYMM_rmse", Valley(1, symmetric)}});
  };
  EXPECT_TRUE(street("F1c", 0.11));
  EXPECT_FALSE(street("F1c", 0.09));
  EXPECT_TRUE(street("F1c+", 0.21));
  EXPECT_FALSE(street("F1c+", 0.19));
  const auto filtered = [](double point, double plane, double symmetric) {
    return Holds("F6f", {{"1_420_POINT_POINT_ocf_rmse", Valley(1, point)},
                         {"1_420_POINT_PLANE_ocf_rmse", Valley(1, plane)},
                         {"1_420_SYMM_ocf_rmse", Valley(1, symmetric)}});
  };
  EXPECT_TRUE(filtered(0.2, 0.19, 0.1));
  EXPECT_TRUE(filtered(0.2, 0.1, 0.19));
  EXPECT_FALSE(filtered(0.2, 0.21, 0.1));
  EXPECT_FALSE(filtered(0.2, 0.1, 0.21));
}

// A bump on the way of either of the two.
TEST(ClaimThresholds, DescentsAreMonotonic) {
  Curve bumpy = Valley(1);
  for (CurvePoint& p : bumpy.points) {
    p.rmse += p.u > 0.4 && p.u < 0.45 ? 0.02 : 0;
  }
  EXPECT_TRUE(Holds("F3g", {}));
  EXPECT_FALSE(Holds("F3g", {{"1_320_POINT_PLANE_rmse", bumpy}}));
  EXPECT_FALSE(Holds("F3g", {{"1_320_SYMM_rmse", bumpy}}));
}

// The rise from 0 to 1 is -0.1 for a valley at 1, and 0.1 for one at 0.
TEST(ClaimThresholds, ReciprocalPairsRiseLess) {
  const auto holds = [](double reciprocal, double plain) {
    return Holds("F4d", {{"1_320_POINT_POINT_reciprocal", Valley(0, reciprocal)},
                         {"1_320_POINT_POINT_rmse", Valley(0, plain)}});
  };
  EXPECT_TRUE(holds(0.1, 0.11));
  EXPECT_FALSE(holds(0.11, 0.1));
}

TEST(ClaimThresholds, TheEgoFilterMovesPointByOverHalf) {
  const auto holds = [](double baseline_off, double filtered_off) {
    return Holds("C5", {{"1_320_POINT_POINT_blind_spot", Valley(1 - baseline_off)},
                        {"1_320_POINT_POINT_offlineOverlap_6", Valley(1 - filtered_off)}});
  };
  EXPECT_TRUE(holds(0.4, 0.19));
  EXPECT_FALSE(holds(0.4, 0.21));
  EXPECT_TRUE(holds(0.8, 0.39));
}

constexpr const char* kMetricsOf420[] = {"EDGEEDGELINESEGMENT", "PLANARPLANAR", "SYMM",
                                         "POINT_PLANE", "POINT_POINT"};

TEST(ClaimThresholds, TheOctreeFilterHelpsAllOrNone) {
  std::map<std::string, Curve> curves;
  for (const std::string metric : kMetricsOf420) {
    curves["1_420_" + metric + (metric[0] == 'E' ? "_edges" : "")] = Valley(0.5);
  }
  EXPECT_TRUE(Holds("F6g", curves));  // From 0.5 to 1, all of them.
  EXPECT_TRUE(Holds("C6", curves));
  for (const std::string metric : kMetricsOf420) {
    auto changed = curves;
    Curve& filtered = changed["1_420_" + metric + "_ocf_rmse"];
    filtered = Valley(0.5);  // As before.
    EXPECT_FALSE(Holds("F6g", changed)) << metric;
    EXPECT_TRUE(Holds("C6", changed)) << metric;
    filtered = Valley(0.49);  // Farther.
    EXPECT_FALSE(Holds("F6g", changed)) << metric;
    EXPECT_FALSE(Holds("C6", changed)) << metric;
  }
  EXPECT_FALSE(Holds("C6", {}));  // None farther, but none closer either.
}

TEST(ClaimThresholds, OvertakingDeceivesAllFive) {
  std::map<std::string, Curve> curves;
  for (const std::string metric : kMetricsOf420) {
    curves["1_420_" + metric + (metric[0] == 'E' ? "_edges" : "")] = Valley(0.1);
  }
  EXPECT_TRUE(Holds("F5a", curves));
  EXPECT_FALSE(Holds("F5c", curves));
  for (const auto& entry : curves) {
    auto changed = curves;
    changed[entry.first] = Valley(0.11);
    EXPECT_FALSE(Holds("F5a", changed)) << entry.first;
    // Of the five one alone has a minimum near 1: edge must be it.
    changed[entry.first] = Valley(1);
    EXPECT_EQ(Holds("F5c", changed), entry.first == "1_420_EDGEEDGELINESEGMENT_edges");
  }
  // rmse(1) / rmse(0) grows with the slope: point and planar must be the first two.
  const auto steep = [&](const std::string& first, const std::string& second) {
    auto changed = curves;
    changed[first] = Valley(0, 0.3);
    changed[second] = Valley(0, 0.2);
    return Holds("F5d", changed);
  };
  EXPECT_TRUE(steep("1_420_POINT_POINT", "1_420_PLANARPLANAR"));
  EXPECT_TRUE(steep("1_420_PLANARPLANAR", "1_420_POINT_POINT"));
  EXPECT_FALSE(steep("1_420_POINT_POINT", "1_420_SYMM"));
  EXPECT_FALSE(steep("1_420_POINT_PLANE", "1_420_POINT_POINT"));
  EXPECT_FALSE(steep("1_420_PLANARPLANAR", "1_420_POINT_PLANE"));
}

// Means over the straight street, the turn, the highway and overtaking, without filters.
TEST(ClaimThresholds, MeansAreOverTheFourScenes) {
  const std::vector<std::string> scenes = {"0_1500_", "0_100_", "1_320_", "1_420_"};
  const auto file = [](const std::string& scene, const std::string& metric) {
    const bool of_overtaking = scene == "1_420_";
    return scene + metric + (!of_overtaking ? "_rmse" : metric[0] == 'E' ? "_edges" : "");
  };
  for (const std::string& scene : scenes) {
    // Planar is off by 0.2 in one scene, in turn.
    std::map<std::string, Curve> curves = {{file(scene, "PLANARPLANAR"), Valley(0.8)}};
    EXPECT_TRUE(Holds("C3", curves)) << scene;
    EXPECT_TRUE(Holds("C4", curves)) << scene;
    for (const std::string& other : scenes) {
      auto changed = curves;
      changed[file(other, "EDGEEDGELINESEGMENT")] = Valley(0.79);
      EXPECT_FALSE(Holds("C3", changed)) << scene << other;
      for (const char* metric : {"SYMM", "POINT_PLANE"}) {
        changed = curves;
        changed[file(other, metric)] = Valley(0.79);
        EXPECT_FALSE(Holds("C4", changed)) << scene << other << metric;
      }
    }
  }
}

}  // namespace
}  // namespace icpscape
