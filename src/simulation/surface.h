// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_SURFACE_H_
#define ICPSCAPE_SRC_SIMULATION_SURFACE_H_

#include <cstdint>

#include "icpscape/cloud/label.h"

namespace icpscape {

/// What a surface is made of: how much of the pulse comes back.
enum class Material : std::uint8_t {
  kAsphalt,
  kConcrete,
  kPlaster,
  kGlass,
  kLightPaint,
  kDarkPaint,
  kRubber,
  kSteel,
  kTarpaulin,
  kSignFace,
  kWood,
  kFoliage,
  kGrass,
};

/// Reflection at the lidar's 905 nm.
struct Reflection {
  double diffuse;   ///< Reflectivity.
  bool rough;       ///< Rough surfaces keep their brightness at grazing incidence.
  double specular;  ///< Added within about 8 degrees of the normal.
};

/// Asphalt and foliage are the two of the HDL-64E's data sheet (0.10 and 0.80); its 50 m for
/// pavement are at grazing incidence, hence `rough`. The others are typical values: black paint
/// and rubber nearly swallow the pulse, glass mirrors it away.
inline Reflection ReflectionOf(Material material) {
  switch (material) {
    case Material::kAsphalt:
      return {0.10, true, 0};
    case Material::kConcrete:
      return {0.30, true, 0};
    case Material::kPlaster:
      return {0.50, true, 0};
    case Material::kGlass:
      return {0.001, false, 0.5};
    case Material::kLightPaint:
      return {0.60, false, 0.5};
    case Material::kDarkPaint:
      return {0.05, false, 0.5};
    case Material::kRubber:
      return {0.05, true, 0};
    case Material::kSteel:
      return {0.40, false, 0.5};
    case Material::kTarpaulin:
      return {0.50, true, 0.2};
    case Material::kSignFace:
      return {0.80, true, 0.5};
    case Material::kWood:
      return {0.40, true, 0};
    case Material::kFoliage:
      return {0.80, true, 0};
    case Material::kGrass:
      return {0.50, true, 0};
  }
  return {0, false, 0};
}

/// The surface of a triangle.
struct Surface {
  Label label;
  Material material;
  std::uint16_t instance = 0;  ///< Number of the object, 1 to 32767; 0 is the ground.

  std::int32_t PointLabel() const {
    return static_cast<std::int32_t>(label) | (static_cast<std::int32_t>(instance) << 16);
  }
};

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_SURFACE_H_
