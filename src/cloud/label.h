// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_CLOUD_LABEL_H_
#define ICPSCAPE_SRC_CLOUD_LABEL_H_

#include <cstdint>

namespace icpscape {

/// What an object is, in SemanticKITTI's numbers [Behley et al. 2019], so that its tools read our
/// label files. A point's label is `semantic | instance << 16`, as there.
enum class Label : std::uint16_t {
  kCar = 10,
  kRoad = 40,
  kPavement = 48,
  kBuilding = 50,
  kFence = 51,  ///< Guard rails as well, as in SemanticKITTI.
  kOtherStructure = 52,
  kVegetation = 70,
  kTrunk = 71,
  kTerrain = 72,
  kPole = 80,
  kTrafficSign = 81,
  kOtherObject = 99,
  kMovingCar = 252,
  kMovingTruck = 258,
};

/// The semantic part of a point's label.
inline Label SemanticOf(std::int32_t point_label) {
  return static_cast<Label>(point_label & 0xFFFF);
}

/// Moving in SemanticKITTI's sense.
inline bool IsMoving(Label label) { return static_cast<int>(label) >= 252; }

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_CLOUD_LABEL_H_
