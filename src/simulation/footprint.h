// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_FOOTPRINT_H_
#define ICPSCAPE_SRC_SIMULATION_FOOTPRINT_H_

#include <algorithm>
#include <utility>
#include <vector>

#include "icpscape/simulation/street_network.h"

namespace icpscape {

/// A rectangle on the ground, as of a house.
struct Footprint {
  Vec2 origin, along, back;  ///< A corner and the two edges (m).

  std::vector<Vec2> Corners() const {
    return {origin, origin + along, origin + along + back, origin + back};
  }

  /// Whether a point lies inside, or outside by less than the margin.
  bool Contains(const Vec2& p, double margin_m) const {
    const double x = (p - origin).dot(along.normalized());
    const double y = (p - origin).dot(back.normalized());
    return x > -margin_m && x < along.norm() + margin_m && y > -margin_m &&
           y < back.norm() + margin_m;
  }

  /// Separating axes: two rectangles overlap unless one of their edges parts them.
  bool Overlaps(const Footprint& other) const {
    const std::vector<Vec2> mine = Corners();
    const std::vector<Vec2> theirs = other.Corners();
    for (const Vec2& axis : {along, back, other.along, other.back}) {
      const auto range = [&axis](const std::vector<Vec2>& corners) {
        double low = corners[0].dot(axis);
        double high = low;
        for (const Vec2& c : corners) {
          low = std::min(low, c.dot(axis));
          high = std::max(high, c.dot(axis));
        }
        return std::make_pair(low, high);
      };
      const auto [low, high] = range(mine);
      const auto [other_low, other_high] = range(theirs);
      if (high <= other_low || other_high <= low) {
        return false;
      }
    }
    return true;
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_FOOTPRINT_H_
