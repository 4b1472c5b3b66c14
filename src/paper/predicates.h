// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_PAPER_PREDICATES_H_
#define ICPSCAPE_SRC_PAPER_PREDICATES_H_

#include <vector>

#include "icpscape/landscape/curve.h"

namespace icpscape {

/// How the claims about curves are decided. All on rmse over u; distances in u.
inline constexpr double kArgminTolerance = 0.1;         ///< "u* ~ 1", "u* ~ 0".
inline constexpr double kLocalMinimumTolerance = 0.15;  ///< "a local minimum at x".
inline constexpr double kFlankWidth = 0.3;              ///< Of FlankSlope.
inline constexpr double kSampleSlack = 1e-9;            ///< For bounds that a sample meets exactly.

/// u of the least sample: u*.
double ArgminU(const Curve& curve);

/// |u* - x| <= 0.1.
bool ArgminIsNear(const Curve& curve, double x);

/// rmse at u, linear between the samples; u must lie within the curve.
double ValueAt(const Curve& curve, double u);

/// The samples' rmse after a median over three neighbours, which removes single outliers; the ends
/// stay.
std::vector<double> MedianOfThree(const Curve& curve);

/// A minimum between higher samples on both sides, after MedianOfThree.
struct LocalMinimum {
  double u = 0;     ///< Of the least unsmoothed sample there.
  double rmse = 0;  ///< Unsmoothed.
  /// What must be climbed to leave it: the lower of the two highest samples between it and lower
  /// ground, or the end of the curve, to either side; over the smoothed minimum (units of rmse).
  double depth = 0;
};
/// All of them by u. However shallow: the paper names no least depth.
std::vector<LocalMinimum> LocalMinima(const Curve& curve);

/// A local minimum within 0.15 of x.
bool HasLocalMinimumNear(const Curve& curve, double x);

/// Mean rise per unit of u from x to x - 0.3 and to x + 0.3: how sharp the minimum at x is.
double FlankSlope(const Curve& curve, double x);

/// No smoothed sample between the two u is above the one before it, and there are at least two.
bool DescendsMonotonically(const Curve& curve, double from_u, double to_u);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_PAPER_PREDICATES_H_
