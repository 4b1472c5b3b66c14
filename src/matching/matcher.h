// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_MATCHER_H_
#define ICPSCAPE_SRC_MATCHING_MATCHER_H_

#include <cstdint>
#include <utility>
#include <vector>

#include "icpscape/cloud/searchable_cloud.h"
#include "icpscape/residuals/correspondence.h"

namespace icpscape {

/// A line or plane fitted to neighbours in the target, target frame.
struct LocalFit {
  Vec3 anchor;     ///< A point on it (m).
  Vec3 direction;  ///< Unit direction of the line, or unit normal of the plane.

  /// What there is of a kind.
  const Vec3& Of(kind::Point) const { return anchor; }
  const Vec3& Of(kind::Direction) const { return direction; }
};

/// What a matcher found, one entry per source point.
struct Matches {
  /// The closest target point, or -1 where the source point has no match.
  std::vector<std::int32_t> target_index;
  /// Of matchers that fit: valid where target_index >= 0. Empty otherwise.
  std::vector<LocalFit> fits = {};
  /// The pose at which they were found: for what is frozen with the matches, such as weights.
  SE3d T_target_source = {};

  std::size_t Count() const;
};

/// Stage three of the chain [paper fig. 1]: pairs the points of a source with something in a
/// target, for a given pose.
class Matcher {
 public:
  Matcher(SearchableCloud source, SearchableCloud target)
      : source_(std::move(source)), target_(std::move(target)) {
    source_.search();  // Built now, on all threads, and not in the middle of a parallel loop.
    target_.search();
  }
  virtual ~Matcher() = default;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  const PointCloud& source() const { return source_.cloud(); }
  const PointCloud& target() const { return target_.cloud(); }
  const SearchableCloud& searchable_source() const { return source_; }
  const SearchableCloud& searchable_target() const { return target_; }

  /// Union of Needs that the matches satisfy (normals come from the clouds).
  virtual unsigned Provides() const = 0;

  /// |(q_j - q_k) x (q_j - q_l)| of a patch's virtual triangle (m^2), for kTargetPatch.
  virtual double area_patch() const { return 0; }

  /// Matches every source point at the pose. The result does not depend on `threads`; safe from
  /// several threads at once.
  void Match(const SE3d& T_target_source, int threads, Matches* matches) const;

  // The same in parts, for those who go on with each part while it is in the cache.

  /// The source points in the order in which they are matched: near ones together.
  const std::vector<std::int32_t>& Order() const { return source_.search().Order(); }

  /// Matches the source points Order()[begin] to Order()[end - 1]; the entries of `matches` are
  /// theirs, in that order. Allocates only where there are more than ever before.
  void MatchPart(const SE3d& T_target_source, std::size_t begin, std::size_t end,
                 Matches* matches) const;

  /// Makes room for all source points at the pose, without a match yet, and takes over those of one
  /// part.
  void Clear(const SE3d& T_target_source, Matches* matches) const;
  void Keep(const Matches& part, std::size_t begin, std::size_t end, Matches* matches) const;

  /// Whether Reject has to see all parts before any is of use.
  virtual bool Rejects() const { return false; }
  virtual void Reject(const SE3d& /*T_target_source*/, int /*threads*/,
                      Matches* /*matches*/) const {}

 private:
  /// What MatchPart says, but for the pose: target indices, and fits where the matcher makes them.
  virtual void FindPart(const SE3d& T_target_source, std::size_t begin, std::size_t end,
                        Matches* matches) const = 0;

  SearchableCloud source_;
  SearchableCloud target_;
};

/// T p as the neighbour search takes it: moved in double, rounded to float once.
inline Eigen::Vector3f Query(const SE3d& T_target_source, const PointCloud& source, std::size_t i) {
  return (T_target_source * source.Point(i)).cast<float>();
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_MATCHER_H_
