// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
#define ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_

#include "residuals/lie.h"

namespace icpscape {

/// What a metric needs of a pair besides the two points; a metric's kNeeds is a union of these.
enum Needs : unsigned {
  kPointsOnly = 0,
  kSourceNormal = 1U << 0,
  kTargetNormal = 1U << 1,
  kTargetLine = 1U << 2,
  kTargetPatch = 1U << 3,
};

/// What the paper sums for its eps(T), given a residual's squared norm s = |r|^2.
enum class Epsilon {
  kSquared,   ///< s: point-to-point, point-to-plane, symmetric.
  kNorm,      ///< sqrt(s): edge point to edge line.
  kSoftNorm,  ///< sqrt(1 + s) - 1: planar point to planar patch, one subtracted from each term.
};

/// The term and its derivative with respect to s. The derivative of kNorm is infinite at s = 0; 0
/// is returned there, the middle of its subgradients.
struct EpsilonTerm {
  double value;
  double derivative;
};
inline EpsilonTerm EvaluateEpsilon(Epsilon epsilon, double s) {
  switch (epsilon) {
    case Epsilon::kSquared:
      return {s, 1};
    case Epsilon::kNorm: {
      const double norm = std::sqrt(s);
      return {norm, norm > 0 ? 0.5 / norm : 0};
    }
    case Epsilon::kSoftNorm: {
      const double root = std::sqrt(1 + s);
      return {s / (root + 1), 0.5 / root};  // root - 1 without cancellation.
    }
  }
  return {0, 0};
}

/// All that a matcher can provide about one pair. Built on the fly from the clouds, never stored in
/// arrays; what a metric does not need may be left unset.
template <class Scalar>
struct CorrespondenceOf {
  Vec<Scalar, 3> p_source;  ///< Point, source frame (m).
  Vec<Scalar, 3> q_target;  ///< Its match, target frame (m).
  Vec<Scalar, 3> n_source;  ///< Unit normal at p_source, source frame (kSourceNormal).
  Vec<Scalar, 3> n_target;  ///< Unit normal at q_target, target frame (kTargetNormal).

  Vec<Scalar, 3> a_line;  ///< A point on the line fitted to neighbours in the target (kTargetLine).
  Vec<Scalar, 3> d_line;  ///< The line's unit direction, target frame.

  Vec<Scalar, 3> q_patch;  ///< Corner of the patch fitted in the target (kTargetPatch).
  Vec<Scalar, 3> n_patch;  ///< The patch's unit normal, target frame.
  Scalar area_patch{0};    ///< |(q_j - q_k) x (q_j - q_l)| of its virtual triangle (m^2).
};
using Correspondence = CorrespondenceOf<double>;

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
