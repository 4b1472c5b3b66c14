// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/paper/claim_list.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "icpscape/common/text.h"
#include "icpscape/paper/predicates.h"

namespace icpscape {

FigureView::FigureView(const ClaimInputs& inputs, const std::string& figure) : inputs_(inputs) {
  for (const Figure& candidate : PaperFigures()) {
    if (candidate.name == figure) {
      figure_ = &candidate;
    }
  }
}

bool FigureView::Drawn() const {
  return std::all_of(figure_->curves.begin(), figure_->curves.end(), [&](const FigureCurve& curve) {
    return inputs_.curves.count(curve.file) > 0;
  });
}

const Curve& FigureView::Of(const std::string& metric, Variant variant) const {
  const auto curve = std::find_if(
      figure_->curves.begin(), figure_->curves.end(), [&](const FigureCurve& candidate) {
        return candidate.metric == metric && candidate.variant == variant;
      });
  return inputs_.curves.at(curve->file);
}

const Curve& FigureView::Of(const std::string& metric) const {
  return Of(metric, figure_->curves.front().variant);
}

const SE3d& FigureView::Motion() const { return inputs_.motions.at(figure_->name); }

std::string ShortName(const std::string& metric) {
  const std::map<std::string, std::string> names = {{"edge_to_line", "edge"},
                                                    {"planar_to_patch", "planar"},
                                                    {"symmetric", "symmetric"},
                                                    {"point_to_plane", "plane"},
                                                    {"point_to_point", "point"}};
  return names.at(metric);
}

std::string StarText(const Curve& curve) { return "u* = " + Fixed(ArgminU(curve), 3); }

std::string MinimaText(const Curve& curve) {
  std::vector<std::string> parts;
  for (const LocalMinimum& minimum : LocalMinima(curve)) {
    parts.push_back(Fixed(minimum.u, 2) + " (" + Fixed(1000 * minimum.depth, 2) + "e-3 deep)");
  }
  return parts.empty() ? "no local minimum" : "local minima at " + Join(parts, "; ");
}

double Off(const Curve& curve) { return std::abs(ArgminU(curve) - 1); }

void ClaimList::Add(const std::string& id, const std::string& statement,
                    const std::vector<FigureView>& needs,
                    const std::function<bool(std::string* measured)>& check) {
  Claim claim{id, statement, "-", Claim::Outcome::kNotDrawn};
  if (std::all_of(needs.begin(), needs.end(),
                  [](const FigureView& view) { return view.Drawn(); })) {
    claim.measured.clear();
    claim.outcome = check(&claim.measured) ? Claim::Outcome::kHolds : Claim::Outcome::kDoesNotHold;
  }
  claims_.push_back(std::move(claim));
}

void ClaimList::ArgminNear(const std::string& id, const FigureView& view, const std::string& metric,
                           double x, Variant variant, const std::string& name) {
  Add(id, name + ": global minimum at u ~ " + Number(x), {view}, [=](std::string* measured) {
    *measured = StarText(view.Of(metric, variant));
    return ArgminIsNear(view.Of(metric, variant), x);
  });
}

void ClaimList::ArgminNear(const std::string& id, const FigureView& view, const std::string& metric,
                           double x, Variant variant) {
  ArgminNear(id, view, metric, x, variant, ShortName(metric));
}

void ClaimList::MinimumNear(const std::string& id, const FigureView& view,
                            const std::string& metric, double x) {
  Add(id, ShortName(metric) + ": local minimum at u ~ " + Number(x), {view},
      [=](std::string* measured) {
        *measured = MinimaText(view.Of(metric));
        return HasLocalMinimumNear(view.Of(metric), x);
      });
}

}  // namespace icpscape
