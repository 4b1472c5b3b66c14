// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_CLAIMS_H_
#define ICPSCAPE_SRC_PAPER_CLAIMS_H_

#include <map>
#include <string>
#include <vector>

#include "icpscape/landscape/curve.h"
#include "icpscape/residuals/lie.h"

namespace icpscape {

/// One assertion of the paper about its figures, and what was found.
struct Claim {
  std::string id;         ///< "F3e": figure 3, fifth assertion; "C1": first conclusion.
  std::string statement;  ///< No commas: the tables separate by them.
  std::string measured;   ///< "-" where not drawn.
  enum class Outcome { kHolds, kDoesNotHold, kNotDrawn } outcome = Outcome::kNotDrawn;
};

/// "holds", "does not hold" or "not drawn".
std::string OutcomeName(Claim::Outcome outcome);

/// The curves and motions on which the claims are checked.
struct ClaimInputs {
  std::map<std::string, Curve> curves;  ///< By the file names of PaperFigures().
  std::map<std::string, SE3d> motions;  ///< T_target_source by the figures' names.
};

/// Every assertion that the paper makes about its six figures and in its conclusions, in its order,
/// decided as in predicates.h. Where a figure's curves are missing its claims are "not drawn".
/// Ids with "+" are ours: the controls that the paper lacks.
std::vector<Claim> EvaluateClaims(const ClaimInputs& inputs);

/// A table in Markdown with one row per claim, and the count of each outcome.
std::string ClaimsMarkdown(const std::vector<Claim>& claims, const std::string& source);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_CLAIMS_H_
