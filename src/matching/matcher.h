// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_MATCHING_MATCHER_H_
#define ICPSCAPE_SRC_MATCHING_MATCHER_H_

#include <cstdint>
#include <vector>

#include "residuals/correspondence.h"
#include "src/cloud/point_cloud.h"

namespace icpscape {

/// A line or plane fitted to neighbours in the target, target frame.
struct LocalFit {
  Vec3 anchor;     ///< A point on it (m).
  Vec3 direction;  ///< Unit direction of the line, or unit normal of the plane.
};

/// What a matcher found, one entry per source point.
struct Matches {
  /// The closest target point, or -1 where the source point has no match.
  std::vector<std::int32_t> target_index;
  /// Of matchers that fit: valid where target_index >= 0. Empty otherwise.
  std::vector<LocalFit> fits = {};
  /// |(q_j - q_k) x (q_j - q_l)| of a patch's virtual triangle (m^2).
  double area_patch = 0;

  std::size_t Count() const;
};

/// Stage three of the chain [paper fig. 1]: pairs the points of a source with something in a
/// target, for a given pose.
class Matcher {
 public:
  /// The clouds must outlive the matcher.
  Matcher(const PointCloud& source, const PointCloud& target) : source_(source), target_(target) {}
  virtual ~Matcher() = default;
  Matcher(const Matcher&) = delete;
  Matcher& operator=(const Matcher&) = delete;

  const PointCloud& source() const { return source_; }
  const PointCloud& target() const { return target_; }

  /// Union of Needs that the matches satisfy (normals come from the clouds).
  virtual unsigned Provides() const = 0;

  /// Matches every source point at the pose. The result does not depend on `threads`; safe from
  /// several threads at once.
  virtual void Match(const SE3d& T_target_source, int threads, Matches* matches) const = 0;

 private:
  const PointCloud& source_;
  const PointCloud& target_;
};

/// T p as the neighbour search takes it: moved in double, rounded to float once.
inline Eigen::Vector3f Query(const SE3d& T_target_source, const PointCloud& source, std::size_t i) {
  return (T_target_source * source.Point(i)).cast<float>();
}

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_MATCHING_MATCHER_H_
