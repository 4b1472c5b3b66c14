// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
#define ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_

#include <string>

#include "kinds.h"
#include "lie.h"

namespace icpscape {

/// What a metric needs of a pair besides the two points; a metric's kNeeds is a union of these.
enum Needs : unsigned {
  kPointsOnly = 0,
  kSourceNormal = 1U << 0,
  kTargetNormal = 1U << 1,
  kTargetLine = 1U << 2,
  kTargetPatch = 1U << 3,
};

/// Their names.
struct NamedNeed {
  Needs need;
  const char* name;
};
inline constexpr NamedNeed kNamedNeeds[] = {
    {kSourceNormal, "source normals"},
    {kTargetNormal, "target normals"},
    {kTargetLine, "line through neighbours"},
    {kTargetPatch, "patch through neighbours"},
};

/// A union of Needs in words: "source normals, target normals"; "" for kPointsOnly.
inline std::string NeedsText(unsigned needs) {
  std::string text;
  for (const NamedNeed& row : kNamedNeeds) {
    if ((needs & row.need) != 0) {
      text += (text.empty() ? "" : ", ") + std::string(row.name);
    }
  }
  return text;
}

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

/// All that a metric can get to know of one pair. Built on the fly from the clouds, never stored in
/// arrays; what a metric does not need may be left unset. Each member has a row in Quantities.
template <class Scalar>
struct CorrespondenceOf {
  Vec<Scalar, 3> p_source;  ///< Point, source frame (m).
  Vec<Scalar, 3> q_target;  ///< Its match, target frame (m).

  /// R of the pose at which the two were matched: for weights that are frozen with the match, such
  /// as (C_q + R C_p R^T)^-1. The pose at which a metric is evaluated is another.
  Mat<Scalar, 3, 3> R_matched;

  Vec<Scalar, 3> n_source;  ///< Unit normal at p_source, source frame (kSourceNormal).
  Vec<Scalar, 3> n_target;  ///< Unit normal at q_target, target frame (kTargetNormal).

  Vec<Scalar, 3> a_line;  ///< A point on the line fitted to neighbours in the target (kTargetLine).
  Vec<Scalar, 3> d_line;  ///< The line's unit direction, target frame.

  Vec<Scalar, 3> q_patch;  ///< Corner of the patch fitted in the target (kTargetPatch).
  Vec<Scalar, 3> n_patch;  ///< The patch's unit normal, target frame.
  Scalar area_patch{0};    ///< |(q_j - q_k) x (q_j - q_l)| of its virtual triangle (m^2).
};
using Correspondence = CorrespondenceOf<double>;

/// Where a quantity comes from, and with it the frame that it is in.
enum class Origin {
  kSourceCloud,  ///< What the source cloud carries at the point; source frame.
  kTargetCloud,  ///< What the target cloud carries at the match; target frame.
  kFit,          ///< What the matcher fits to the target for each pair; target frame.
  kMatching,     ///< The same for all pairs that were matched together; target frame.
};

/// One row of the list. Quantities of one origin and kind are the same numbers under two names: a
/// cloud carries one direction at a point, its normal, and a fit has one direction.
template <auto kMemberOf, Needs kNeedOf, class KindOf, Origin kOriginOf>
struct Quantity {
  static constexpr auto kMember = kMemberOf;    ///< Of CorrespondenceOf<Scalar>.
  static constexpr unsigned kNeed = kNeedOf;    ///< Who asks for this gets it; kPointsOnly: all.
  using Kind = KindOf;                          ///< One of namespace kind.
  static constexpr Origin kOrigin = kOriginOf;  ///< Where it comes from.

  /// In the source frame, else in the target frame.
  static constexpr bool kInSourceFrame = kOrigin == Origin::kSourceCloud;

  static constexpr bool IsNeededBy(unsigned needs) {
    return kNeed == kPointsOnly || (needs & kNeed) != 0;
  }
  /// A cloud can be without it at some of its points, which then take no part where it is needed.
  static constexpr bool kCanBeMissing =
      kNeed != kPointsOnly && (kInSourceFrame || kOrigin == Origin::kTargetCloud);
};

template <class... Rows>
struct QuantityList {};

/// The quantities that a correspondence can carry. Storing, loading and differentiating pairs,
/// changes of frame, checks and texts follow from this list and from the names of the needs.
template <class Scalar, class C = CorrespondenceOf<Scalar>>
using Quantities =
    QuantityList<Quantity<&C::p_source, kPointsOnly, kind::Point, Origin::kSourceCloud>,
                 Quantity<&C::q_target, kPointsOnly, kind::Point, Origin::kTargetCloud>,
                 Quantity<&C::R_matched, kPointsOnly, kind::Rotation, Origin::kMatching>,
                 Quantity<&C::n_source, kSourceNormal, kind::Direction, Origin::kSourceCloud>,
                 Quantity<&C::n_target, kTargetNormal, kind::Direction, Origin::kTargetCloud>,
                 Quantity<&C::a_line, kTargetLine, kind::Point, Origin::kFit>,
                 Quantity<&C::d_line, kTargetLine, kind::Direction, Origin::kFit>,
                 Quantity<&C::q_patch, kTargetPatch, kind::Point, Origin::kFit>,
                 Quantity<&C::n_patch, kTargetPatch, kind::Direction, Origin::kFit>,
                 Quantity<&C::area_patch, kTargetPatch, kind::Scalar, Origin::kMatching>>;

namespace internal {

template <class F, class... Rows>
constexpr void VisitRows(QuantityList<Rows...>, F&& f) {
  (f(Rows{}), ...);
}

template <class F, class... FromRows, class... ToRows>
void VisitRows(QuantityList<FromRows...>, QuantityList<ToRows...>, F&& f) {
  (f(FromRows{}, ToRows{}), ...);
}

}  // namespace internal

/// Calls f(Row{}) for every row of Quantities<Scalar>, in the order of the list.
template <class Scalar, class F>
constexpr void ForEachQuantity(F&& f) {
  internal::VisitRows(Quantities<Scalar>{}, f);
}

/// The pair with f(Row{}, value) for each of its values that is needed; Row is of Quantities<From>.
/// Over another scalar, or seen from another frame.
template <class To, class From, class F>
CorrespondenceOf<To> MapQuantities(const CorrespondenceOf<From>& pair, unsigned needs, F&& f) {
  CorrespondenceOf<To> mapped;
  internal::VisitRows(Quantities<From>{}, Quantities<To>{}, [&](auto row, auto to) {
    if (decltype(row)::IsNeededBy(needs)) {
      mapped.*decltype(to)::kMember = f(row, pair.*decltype(row)::kMember);
    }
  });
  return mapped;
}

/// Union of the needs whose quantities come from there.
constexpr unsigned NeedsFrom(Origin origin) {
  unsigned needs = 0;
  ForEachQuantity<double>(
      [&](auto row) { needs |= decltype(row)::kOrigin == origin ? decltype(row)::kNeed : 0U; });
  return needs;
}

}  // namespace icpscape

#endif  // ICPSCAPE_RESIDUALS_CORRESPONDENCE_H_
