// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_STREET_NETWORK_H_
#define ICPSCAPE_SRC_SIMULATION_STREET_NETWORK_H_

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "icpscape/simulation/mesh.h"

namespace icpscape {

using Vec2 = Eigen::Vector2d;

/// A residential street: two lanes of 2.75 m, a parking strip of 2 m and a pavement on either side
/// (RASt 06, the German guideline for urban streets).
struct Street {
  std::vector<Vec2> centre;    ///< Polyline, m; bends of less than about 25 degrees.
  double half_width_m = 4.75;  ///< Kerb to centre.
  double pavement_m = 2.2;
};

/// A point on a street's centre line.
struct StreetSample {
  Vec2 position;
  Vec2 tangent;  ///< Unit length; the left normal is (-y, x).
};

/// Distance of a point to a polyline (m).
double DistanceToPolyline(const Vec2& p, const std::vector<Vec2>& polyline);

/// Streets that cross on level ground: carriageways with a crown, kerbs, pavements, gardens.
class StreetNetwork {
 public:
  StreetNetwork(std::vector<Street> streets, std::uint64_t key);

  const std::vector<Street>& streets() const { return streets_; }
  /// Points every `step_m` along one street.
  std::vector<StreetSample> Sample(std::size_t street, double step_m) const;

  /// The least of (distance to the centre line - half width) over all streets but one: negative on
  /// a carriageway, infinite where there is no other street. `except` may be past the end.
  double DistanceToKerb(const Vec2& p, std::size_t except = ~std::size_t{0}) const;

  /// Height of the carriageway (m): 2.5 % crown from the kerb at z = 0, and 6 mm of unevenness.
  double RoadHeight(const Vec2& p) const;

  void AddGround(Mesh* mesh) const;

 private:
  void AddStreet(std::size_t street, Mesh* mesh) const;
  std::vector<Street> streets_;
  std::uint64_t key_;
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_STREET_NETWORK_H_
