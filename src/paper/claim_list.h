// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_CLAIM_LIST_H_
#define ICPSCAPE_SRC_PAPER_CLAIM_LIST_H_

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "icpscape/paper/claims.h"
#include "icpscape/paper/figures.h"

namespace icpscape {

/// The curves of one figure. The inputs must outlive it.
class FigureView {
 public:
  FigureView(const ClaimInputs& inputs, const std::string& figure);
  FigureView(const ClaimInputs&& inputs, const std::string& figure) = delete;

  bool Drawn() const;
  const Curve& Of(const std::string& metric, Variant variant) const;
  /// Of a figure with one variant.
  const Curve& Of(const std::string& metric) const;
  const SE3d& Motion() const;

 private:
  const ClaimInputs& inputs_;
  const Figure* figure_ = nullptr;
};

/// "edge" for edge_to_line.
std::string ShortName(const std::string& metric);
/// "u* = 1.000".
std::string StarText(const Curve& curve);
/// "local minima at 0.03 (1.20e-3 deep); 1.00 (...)".
std::string MinimaText(const Curve& curve);
/// Distance of u* from 1.
double Off(const Curve& curve);

/// Collects claims in order.
class ClaimList {
 public:
  /// Checks the claim where all figures that it needs are drawn.
  void Add(const std::string& id, const std::string& statement,
           const std::vector<FigureView>& needs,
           const std::function<bool(std::string* measured)>& check);
  /// The global minimum is within 0.1 of x.
  void ArgminNear(const std::string& id, const FigureView& view, const std::string& metric,
                  double x, Variant variant, const std::string& name);
  void ArgminNear(const std::string& id, const FigureView& view, const std::string& metric,
                  double x, Variant variant = Variant::kPlain);
  /// There is a local minimum within 0.15 of x.
  void MinimumNear(const std::string& id, const FigureView& view, const std::string& metric,
                   double x);
  std::vector<Claim> Take() { return std::move(claims_); }

 private:
  std::vector<Claim> claims_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_CLAIM_LIST_H_
