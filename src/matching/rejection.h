// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_REJECTION_H_
#define ICPSCAPE_SRC_MATCHING_REJECTION_H_

#include "icpscape/cloud/point_cloud.h"
#include "icpscape/matching/matcher.h"

namespace icpscape {

// Each function turns the matches it rejects into -1 and leaves the others. A pair's distance is
// |T p - q|, taken in double at the pose; statistics are over the pairs that came in. All throw
// UsageError for options out of range. Rejectors compose by being called one after the other.

/// Reciprocal correspondences [paper sec. 2.5; Pajdla & Van Gool 1995]: p_i -> q is kept where
/// q -> p_k leads back to it, k = i, or nearly, |p_i - p_k| <= epsilon. q -> p_k is the source
/// point nearest to T^-1 q, which is rounded to float for the search; ties go to the lower index.
/// epsilon_m = 0 is the strict form; copies of a point are then one point. The result does not
/// depend on `threads`.
void RejectNotReciprocal(const SearchableCloud& source, const PointCloud& target,
                         const SE3d& T_target_source, double epsilon_m, int threads,
                         Matches* matches);

/// Rejects pairs further apart than max_distance_m.
void RejectDistant(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   double max_distance_m, Matches* matches);

/// Rejects pairs whose normals R n_p and n_q form more than max_angle_rad (0 to pi), and pairs
/// without a normal at either end. The signs count: normals look at their sensor, so the two sides
/// of a thin wall do not match. Throws InputError where a cloud has no normals.
void RejectByNormalAngle(const PointCloud& source, const PointCloud& target,
                         const SE3d& T_target_source, double max_angle_rad, Matches* matches);

/// Rejects pairs further apart than factor times the median distance (the lower of the two middle
/// ones).
void RejectBeyondMedian(const PointCloud& source, const PointCloud& target,
                        const SE3d& T_target_source, double factor, Matches* matches);

/// Keeps the closest share of the pairs, their number times kept_fraction (0 to 1) rounded to the
/// nearest whole, and rejects the others [trimmed ICP, Chetverikov et al. 2002]. Equally distant
/// pairs go by source index.
void RejectTrimmed(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   double kept_fraction, Matches* matches);

struct RegionOptions {
  double region_size_m = 10;
  /// Regions whose mean distance is beyond this multiple of the median region's are dropped.
  double median_factor = 2;
};

/// Rejects whole regions that match badly, such as moving objects [Bengtsson & Baerveldt 1999,
/// cited in paper sec. 2.7]: the source frame is split into cubes from the origin, and all pairs of
/// a cube are dropped where their mean distance is beyond median_factor times the median (the lower
/// one) of the cubes' means. The original's regions are those of a planar scan; the cubes are ours.
void RejectRegions(const PointCloud& source, const PointCloud& target, const SE3d& T_target_source,
                   const RegionOptions& options, Matches* matches);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_REJECTION_H_
