// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_LOCAL_FIT_MATCHER_H_
#define ICPSCAPE_SRC_MATCHING_LOCAL_FIT_MATCHER_H_

#include <string>
#include <vector>

#include "icpscape/common/names.h"
#include "icpscape/matching/matcher.h"

namespace icpscape {

/// What the sum of squares about the mean is divided by before its eigenvalues are compared with a
/// threshold in m^2. The paper does not say; over five points with 2 cm of noise the rule
/// lambda_3 < 1e-4 lets through 12, 47 or 40 % of the patches.
enum class EigenvalueScale { kScatter, kOverN, kOverNMinusOne };
template <>
struct Names<EigenvalueScale> {
  static constexpr const char* kWhat = "eigenvalue scale";
  static constexpr const char* kNames[] = {"scatter", "over_n", "over_n_minus_one"};
};

/// The anchor of the line or patch: the neighbours' mean (LOAM's mapping stage, A-LOAM) or the
/// nearest of them.
enum class FitAnchor { kCentroid, kNearest };
template <>
struct Names<FitAnchor> {
  static constexpr const char* kWhat = "fit anchor";
  static constexpr const char* kNames[] = {"centroid", "nearest"};
};

/// When neighbours count as a line or a patch; the defaults are the paper's (sec. 4.2).
struct LocalFitOptions {
  int num_neighbors = 5;
  /// Line: lambda_1 > ratio lambda_2. Patch: lambda_2 > ratio lambda_3. LIO-SAM takes 3 as well.
  double eigenvalue_ratio = 3;
  /// Patch: lambda_3 below this (m^2).
  double max_smallest_eigenvalue_m2 = 1e-4;
  EigenvalueScale eigenvalue_scale = EigenvalueScale::kOverN;
  FitAnchor anchor = FitAnchor::kCentroid;
  /// The farthest neighbour may be this far from T p; 0 is no limit. A-LOAM takes 1 m.
  double max_neighbor_distance_m = 0;
  /// Legs of the patch's right-angled virtual triangle (m); the paper gives no size.
  double triangle_leg_m = 0.5;
};

/// Fits a line [LOAM's edge lines; paper sec. 2.4.1] or a patch [sec. 2.4.2] to the nearest target
/// points of T p, for every source point and pose. Points whose neighbours are neither have no
/// match. The sources are features: see cloud/features.h.
class LocalFitMatcher final : public Matcher {
 public:
  enum class Shape { kLine, kPatch };

  LocalFitMatcher(Shape shape, SearchableCloud source, SearchableCloud target,
                  const LocalFitOptions& options = {});

  static constexpr unsigned ProvidedBy(Shape shape) {
    return shape == Shape::kLine ? kTargetLine : kTargetPatch;
  }

  unsigned Provides() const override { return ProvidedBy(shape_); }
  double area_patch() const override { return options_.triangle_leg_m * options_.triangle_leg_m; }

 private:
  void FindPart(const SE3d& T_target_source, std::size_t begin, std::size_t end,
                Matches* matches) const override;
  bool Accepts(const Neighborhoods& neighborhoods, const PrincipalAxes& axes, std::size_t i) const;

  Shape shape_;
  LocalFitOptions options_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_LOCAL_FIT_MATCHER_H_
