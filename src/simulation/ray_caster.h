// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_RAY_CASTER_H_
#define ICPSCAPE_SRC_SIMULATION_RAY_CASTER_H_

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "icpscape/simulation/mesh.h"

namespace icpscape {

/// Where a ray ends.
struct RayHit {
  double range_m = 0;
  double cos_incidence = 0;  ///< Of the angle between the ray and the surface's normal, 0 to 1.
  Surface surface{};
};

/// First hits of rays with a mesh, through Embree. Safe to use from many threads at once.
///
/// The tree is built by one thread with only SSE2 code, so that a mesh gives the same hits on every
/// machine. While a caster lives, Embree holds oneTBB to one thread in the whole process: cast from
/// threads of your own, and keep casters short-lived.
class RayCaster {
 public:
  explicit RayCaster(Mesh mesh) : RayCaster(std::move(mesh), {}) {}
  /// A mesh that moves: `vertices_at_end` are its vertices at the end of a span of time, and each
  /// goes there in a straight line. None: it stands still.
  RayCaster(Mesh mesh, std::vector<std::array<float, 3>> vertices_at_end);
  ~RayCaster();
  RayCaster(RayCaster&&) noexcept;
  RayCaster& operator=(RayCaster&&) noexcept;

  /// The nearest hit with range in [0, max_range_m]; false where there is none. `direction` has
  /// unit length. `share` of the span of time has passed, 0 to 1.
  bool Cast(const Vec3& origin, const Vec3& direction, double max_range_m, RayHit* hit,
            double share = 0) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_RAY_CASTER_H_
