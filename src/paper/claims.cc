// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "icpscape/common/text.h"
#include "icpscape/paper/claim_list.h"
#include "icpscape/paper/predicates.h"

namespace icpscape {
namespace {

void StraightStreet(const FigureView& f1, ClaimList* claims) {
  claims->ArgminNear("F1a", f1, "point_to_plane", 1);
  claims->ArgminNear("F1b", f1, "symmetric", 1);
  for (const double factor : {1.0, 0.5}) {
    claims->Add(factor == 1 ? "F1c" : "F1c+",
                factor == 1 ? "symmetric is steeper than plane near u = 1"
                            : "the same with symmetric divided by its factor 2",
                {f1}, [=](std::string* measured) {
                  const double symmetric = factor * FlankSlope(f1.Of("symmetric"), 1);
                  const double plane = FlankSlope(f1.Of("point_to_plane"), 1);
                  *measured = "slopes " + Fixed(symmetric, 4) + " and " + Fixed(plane, 4);
                  return symmetric > plane;
                });
  }
  claims->ArgminNear("F1d", f1, "edge_to_line", 1);
  claims->ArgminNear("F1e", f1, "planar_to_patch", 1);
  claims->MinimumNear("F1f", f1, "edge_to_line", 0);
  claims->MinimumNear("F1g", f1, "planar_to_patch", 0);
  claims->Add("F1h", "point: global minimum off by 0.03 to 0.3 in u", {f1},
              [=](std::string* measured) {
                *measured = StarText(f1.Of("point_to_point"));
                const double off = Off(f1.Of("point_to_point"));
                return off >= 0.03 - kSampleSlack && off <= 0.3 + kSampleSlack;
              });
  claims->Add("F1i", "point: one local minimum only", {f1}, [=](std::string* measured) {
    *measured = MinimaText(f1.Of("point_to_point"));
    return LocalMinima(f1.Of("point_to_point")).size() == 1;
  });
  claims->Add("F1j", "all values within 0.1 to 0.9", {f1}, [=](std::string* measured) {
    double low = std::numeric_limits<double>::infinity();
    double high = 0;
    for (const std::string& metric : PaperMetrics()) {
      for (const CurvePoint& point : f1.Of(metric).points) {
        low = std::min(low, point.rmse);
        high = std::max(high, point.rmse);
      }
    }
    *measured = Fixed(low, 3) + " to " + Fixed(high, 3);
    return low >= 0.1 && high <= 0.9;
  });
}

void RightTurn(const FigureView& f2, ClaimList* claims) {
  const std::string ids = "abcde";
  for (std::size_t i = 0; i < PaperMetrics().size(); ++i) {
    claims->ArgminNear(std::string("F2") + ids[i], f2, PaperMetrics()[i], 1);
  }
  claims->Add("F2f", "the motion is a turn to the right with little translation (< 0.5 m)", {f2},
              [=](std::string* measured) {
                const double yaw_deg = f2.Motion().LogRotation().z() * 180 / M_PI;
                *measured =
                    Fixed(f2.Motion().t().norm(), 3) + " m; yaw " + Fixed(yaw_deg, 2) + " deg";
                return f2.Motion().t().norm() < 0.5 && yaw_deg < 0;
              });
}

void Highway(const FigureView& f3, ClaimList* claims) {
  claims->ArgminNear("F3a", f3, "point_to_point", 0);
  claims->ArgminNear("F3b", f3, "planar_to_patch", 0);
  claims->ArgminNear("F3c", f3, "point_to_plane", 1);
  claims->ArgminNear("F3d", f3, "symmetric", 1);
  claims->ArgminNear("F3e", f3, "edge_to_line", 0);
  claims->MinimumNear("F3f", f3, "edge_to_line", 1);
  claims->Add(
      "F3g", "plane and symmetric descend monotonically from u = 0 to their minimum", {f3},
      [=](std::string* measured) {
        bool holds = true;
        for (const char* metric : {"point_to_plane", "symmetric"}) {
          const bool descends = DescendsMonotonically(f3.Of(metric), 0, ArgminU(f3.Of(metric)));
          *measured += std::string(measured->empty() ? "" : "; ") + ShortName(metric) +
                       (descends ? " does" : " does not") + " (" + StarText(f3.Of(metric)) + ")";
          holds = holds && descends;
        }
        return holds;
      });
}

void HighwayImproved(const FigureView& f4, ClaimList* claims) {
  const std::string point = "point_to_point";
  claims->ArgminNear("F4a", f4, point, 0, Variant::kPlain, "point");
  claims->ArgminNear("F4b", f4, point, 0, Variant::kReciprocal, "point with reciprocal pairs");
  claims->Add("F4c", "reciprocal pairs give a local minimum at u ~ 1; plain ones none", {f4},
              [=](std::string* measured) {
                const Curve& reciprocal = f4.Of(point, Variant::kReciprocal);
                const Curve& plain = f4.Of(point, Variant::kPlain);
                *measured =
                    "reciprocal: " + MinimaText(reciprocal) + "; plain: " + MinimaText(plain);
                return HasLocalMinimumNear(reciprocal, 1) && !HasLocalMinimumNear(plain, 1);
              });
  claims->Add("F4d", "rmse(1) - rmse(0) is smaller with reciprocal pairs than plain", {f4},
              [=](std::string* measured) {
                const auto rise = [&](Variant variant) {
                  return ValueAt(f4.Of(point, variant), 1) - ValueAt(f4.Of(point, variant), 0);
                };
                *measured = Fixed(rise(Variant::kReciprocal), 4) + " and " +
                            Fixed(rise(Variant::kPlain), 4);
                return rise(Variant::kReciprocal) < rise(Variant::kPlain);
              });
  claims->ArgminNear("F4e", f4, point, 1, Variant::kEgoFilter,
                     "point with the ego blind spot filter");
  claims->ArgminNear("F4+", f4, point, 0, Variant::kBlindSpot,
                     "point with the artificial blind spot but no filter (the fair baseline)");
}

void Overtaking(const FigureView& f5, ClaimList* claims) {
  claims->Add("F5a", "all five: global minimum at u ~ 0", {f5}, [=](std::string* measured) {
    bool holds = true;
    std::vector<std::string> parts;
    for (const std::string& metric : PaperMetrics()) {
      parts.push_back(ShortName(metric) + " " + Fixed(ArgminU(f5.Of(metric)), 3));
      holds = holds && ArgminIsNear(f5.Of(metric), 0);
    }
    *measured = "u*: " + Join(parts, "; ");
    return holds;
  });
  claims->MinimumNear("F5b", f5, "edge_to_line", 1);
  claims->Add("F5c", "of the five only edge has a local minimum at u ~ 1", {f5},
              [=](std::string* measured) {
                std::vector<std::string> with;
                for (const std::string& metric : PaperMetrics()) {
                  if (HasLocalMinimumNear(f5.Of(metric), 1)) {
                    with.push_back(ShortName(metric));
                  }
                }
                *measured = with.empty() ? "none has one" : Join(with, "; ");
                return with == std::vector<std::string>{"edge"};
              });
  claims->Add("F5d", "point and planar have the largest rmse(1) / rmse(0)", {f5},
              [=](std::string* measured) {
                std::vector<std::pair<double, std::string>> ratios;
                for (const std::string& metric : PaperMetrics()) {
                  const Curve& curve = f5.Of(metric);
                  ratios.emplace_back(ValueAt(curve, 1) / ValueAt(curve, 0), ShortName(metric));
                }
                std::sort(ratios.rbegin(), ratios.rend());
                std::vector<std::string> parts;
                parts.reserve(ratios.size());
                for (const auto& [ratio, name] : ratios) {
                  parts.push_back(name + " " + Fixed(ratio, 3));
                }
                *measured = Join(parts, "; ");
                std::array<std::string, 2> worst = {ratios[0].second, ratios[1].second};
                std::sort(worst.begin(), worst.end());
                return worst == std::array<std::string, 2>{"planar", "point"};
              });
}

// How many metrics' u* is closer to 1 with the filter, and how many farther from it.
std::string Improvements(const FigureView& f5, const FigureView& f6, int* closer, int* farther) {
  std::vector<std::string> parts;
  for (const std::string& metric : PaperMetrics()) {
    const double before = Off(f5.Of(metric));
    const double after = Off(f6.Of(metric));
    *closer += after < before - kSampleSlack ? 1 : 0;
    *farther += after > before + kSampleSlack ? 1 : 0;
    parts.push_back(ShortName(metric) + " " + Fixed(before, 3) + " to " + Fixed(after, 3));
  }
  return "distance of u* from 1: " + Join(parts, "; ");
}

void OvertakingFiltered(const FigureView& f5, const FigureView& f6, ClaimList* claims) {
  const std::string ids = "abcde";
  for (std::size_t i = 0; i < PaperMetrics().size(); ++i) {
    claims->ArgminNear(std::string("F6") + ids[i], f6, PaperMetrics()[i], 1, Variant::kOctree);
  }
  claims->Add("F6f", "point is the steepest; above plane and symmetric", {f6},
              [=](std::string* measured) {
                const double point = FlankSlope(f6.Of("point_to_point"), 1);
                const double plane = FlankSlope(f6.Of("point_to_plane"), 1);
                const double symmetric = FlankSlope(f6.Of("symmetric"), 1);
                *measured = "slopes: point " + Fixed(point, 4) + "; plane " + Fixed(plane, 4) +
                            "; symmetric " + Fixed(symmetric, 4);
                return point > std::max(plane, symmetric);
              });
  claims->Add("F6g", "u* comes closer to 1 for every metric", {f5, f6}, [=](std::string* measured) {
    int closer = 0;
    int farther = 0;
    *measured = Improvements(f5, f6, &closer, &farther);
    return closer == static_cast<int>(PaperMetrics().size());
  });
}

void Conclusions(const FigureView& f1, const FigureView& f2, const FigureView& f3,
                 const FigureView& f4, const FigureView& f5, const FigureView& f6,
                 ClaimList* claims) {
  claims->Add("C1", "in a turn the choice of metric matters little (u* within 0.1 of each other)",
              {f2}, [=](std::string* measured) {
                std::vector<double> stars;
                for (const std::string& metric : PaperMetrics()) {
                  stars.push_back(ArgminU(f2.Of(metric)));
                }
                const auto [low, high] = std::minmax_element(stars.begin(), stars.end());
                *measured = "u* from " + Fixed(*low, 3) + " to " + Fixed(*high, 3);
                return *high - *low <= kArgminTolerance + kSampleSlack;
              });
  claims->Add("C2", "in straight motion point is off by a little (by up to 0.3 in u)", {f1},
              [=](std::string* measured) {
                *measured = StarText(f1.Of("point_to_point"));
                const double off = Off(f1.Of("point_to_point"));
                return off > kSampleSlack && off <= 0.3 + kSampleSlack;
              });
  const std::vector<FigureView> unfiltered = {f1, f2, f3, f5};
  const auto mean_off = [=](const std::string& metric) {
    double sum = 0;
    for (const FigureView& view : unfiltered) {
      sum += Off(view.Of(metric));
    }
    return sum / static_cast<double>(unfiltered.size());
  };
  const auto mean_text = [=](const std::string& metric) {
    return ShortName(metric) + " " + Fixed(mean_off(metric), 3);
  };
  claims->Add("C3",
              "edge has better global minima than planar (mean distance of u* from 1; four scenes)",
              unfiltered, [=](std::string* measured) {
                *measured = mean_text("edge_to_line") + "; " + mean_text("planar_to_patch");
                return mean_off("edge_to_line") < mean_off("planar_to_patch");
              });
  claims->Add("C4", "plane and symmetric have better global minima than planar (same mean)",
              unfiltered, [=](std::string* measured) {
                *measured = mean_text("point_to_plane") + "; " + mean_text("symmetric") + "; " +
                            mean_text("planar_to_patch");
                return std::max(mean_off("point_to_plane"), mean_off("symmetric")) <
                       mean_off("planar_to_patch");
              });
  claims->Add(
      "C5",
      "missing overlap matters strongly (the ego blind spot filter halves point's distance from 1)",
      {f4}, [=](std::string* measured) {
        const Curve& baseline = f4.Of("point_to_point", Variant::kBlindSpot);
        const Curve& filtered = f4.Of("point_to_point", Variant::kEgoFilter);
        *measured = StarText(baseline) + "; filtered " + StarText(filtered);
        return Off(filtered) < 0.5 * Off(baseline);
      });
  claims->Add("C6", "the octree filter helps any metric (no u* farther from 1; one closer)",
              {f5, f6}, [=](std::string* measured) {
                int closer = 0;
                int farther = 0;
                *measured = Improvements(f5, f6, &closer, &farther);
                return closer > 0 && farther == 0;
              });
}

}  // namespace

std::string OutcomeName(Claim::Outcome outcome) {
  const std::array<const char*, 3> names = {"holds", "does not hold", "not drawn"};
  return names[static_cast<std::size_t>(outcome)];
}

std::vector<Claim> EvaluateClaims(const ClaimInputs& inputs) {
  const FigureView f1(inputs, "00_1500");
  const FigureView f2(inputs, "00_100");
  const FigureView f3(inputs, "01_320");
  const FigureView f4(inputs, "01_320_improved");
  const FigureView f5(inputs, "01_420");
  const FigureView f6(inputs, "01_420_octree");
  ClaimList claims;
  StraightStreet(f1, &claims);
  RightTurn(f2, &claims);
  Highway(f3, &claims);
  HighwayImproved(f4, &claims);
  Overtaking(f5, &claims);
  OvertakingFiltered(f5, f6, &claims);
  Conclusions(f1, f2, f3, f4, f5, f6, &claims);
  return claims.Take();
}

std::string ClaimsMarkdown(const std::vector<Claim>& claims, const std::string& source) {
  std::map<Claim::Outcome, int> counts;
  std::string rows;
  for (const Claim& claim : claims) {
    ++counts[claim.outcome];
    rows += "| " + claim.id + " | " + claim.statement + " | " + claim.measured + " | " +
            OutcomeName(claim.outcome) + " |\n";
  }
  std::string text = "# The paper's claims on " + source + "\n\n";
  for (const auto& [outcome, count] : counts) {
    text += OutcomeName(outcome) + ": " + std::to_string(count) + ". ";
  }
  return text + "\n\n| id | claim | measured | outcome |\n|---|---|---|---|\n" + rows;
}

}  // namespace icpscape
