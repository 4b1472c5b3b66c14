// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/roadside.h"

#include <algorithm>
#include <cmath>

namespace icpscape {
namespace {

// x from a towards b, z up, origin at a.
SE3d Along(const Vec3& a, const Vec3& b) {
  return Placement(a.x(), a.y(), a.z(), std::atan2(b.y() - a.y(), b.x() - a.x()));
}

}  // namespace

void AddLamp(const Vec3& foot, double yaw_rad, std::uint16_t instance, Mesh* mesh) {
  const Surface steel{Label::kPole, Material::kSteel, instance};
  const Vec3 arm(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  AddFrustum(foot, foot + Vec3(0, 0, 1.0), 0.09, 0.09, 12, steel, mesh);
  const Vec3 top = foot + Vec3(0, 0, 6);
  AddFrustum(foot + Vec3(0, 0, 1.0), top, 0.065, 0.045, 12, steel, mesh);
  AddFrustum(top, top + arm + Vec3(0, 0, 0.15), 0.03, 0.03, 8, steel, mesh);
  AddFrustum(top + arm, top + 1.6 * arm, 0.12, 0.10, 8, steel, mesh);
}

void AddSign(const Vec3& foot, double yaw_rad, std::uint64_t key, std::uint16_t instance,
             Mesh* mesh) {
  const Surface face{Label::kTrafficSign, Material::kSignFace, instance};
  AddFrustum(foot, foot + Vec3(0, 0, 2.9), 0.03, 0.03, 8,
             {Label::kPole, Material::kSteel, instance}, mesh);
  const SE3d T = Placement(foot.x(), foot.y(), foot.z() + 2.5, yaw_rad);
  const Vec3 front = T * Vec3(0.04, 0, 0);
  switch (key % 3) {
    case 0:  // 600 mm across.
      AddFrustum(front, front + T.R() * Vec3(0.01, 0, 0), 0.30, 0.30, 24, face, mesh);
      break;
    case 1:  // 900 mm a side.
      mesh->AddTriangle(T * Vec3(0.04, -0.45, -0.25), T * Vec3(0.04, 0.45, -0.25),
                        T * Vec3(0.04, 0, 0.53), face);
      break;
    default:
      AddBox(T, Vec3(0.04, -0.42, -0.30), Vec3(0.05, 0.42, 0.30), face, mesh);
  }
}

void AddPicketFence(const Vec3& a, const Vec3& b, double height_m, std::uint16_t instance,
                    Mesh* mesh) {
  const Surface wood{Label::kFence, Material::kWood, instance};
  const SE3d T = Along(a, b);
  const double length = (b - a).norm();
  for (const double z : {0.3, 0.8 * height_m}) {
    AddBox(T, Vec3(0, 0.02, z - 0.04), Vec3(length, 0.06, z + 0.04), wood, mesh);
  }
  for (double x = 0; x + 0.08 < length; x += 0.13) {
    AddBox(T, Vec3(x, 0, 0.08), Vec3(x + 0.08, 0.02, height_m), wood, mesh);
  }
}

void AddLowWall(const Vec3& a, const Vec3& b, double height_m, std::uint16_t instance, Mesh* mesh) {
  const Surface stone{Label::kFence, Material::kConcrete, instance};
  const SE3d T = Along(a, b);
  const double length = (b - a).norm();
  AddBox(T, Vec3(0, -0.125, 0), Vec3(length, 0.125, height_m), stone, mesh);
  AddBox(T, Vec3(0, -0.16, height_m), Vec3(length, 0.16, height_m + 0.06), stone, mesh);
  for (const double x : {0., length - 0.35}) {
    AddBox(T, Vec3(x, -0.175, 0), Vec3(x + 0.35, 0.175, height_m + 0.2), stone, mesh);
  }
}

void AddGuardRail(const Vec3& a, const Vec3& b, std::uint16_t instance, Mesh* mesh) {
  const Surface steel{Label::kFence, Material::kSteel, instance};
  const SE3d T = Along(a, b);
  const double length = (b - a).norm();
  // The beam's section: y outwards from the post, z up from the lower edge.
  constexpr double kSection[8][2] = {{0, 0},         {0.025, 0.02}, {0.08, 0.06}, {0.08, 0.11},
                                     {0.025, 0.155}, {0.08, 0.20},  {0.08, 0.25}, {0, 0.31}};
  constexpr double kLowerEdgeM = 0.44;
  AddPatch(
      std::max(1, static_cast<int>(length / 4)), 7,
      [&](int i, int j) -> Vec3 {
        const double x = length * i / std::max(1, static_cast<int>(length / 4));
        return T * Vec3(x, 0.10 + kSection[j][0], kLowerEdgeM + kSection[j][1]);
      },
      steel, mesh);
  for (double x = 0; x < length; x += 2) {
    AddBox(T, Vec3(x - 0.03, -0.05, -0.1), Vec3(x + 0.03, 0.05, 0.70), steel, mesh);
    AddBox(T, Vec3(x - 0.03, 0.05, 0.50), Vec3(x + 0.03, 0.10, 0.68), steel, mesh);
  }
}

void AddDelineator(const Vec3& foot, std::uint16_t instance, Mesh* mesh) {
  AddFrustum(foot, foot + Vec3(0, 0, 1.0), 0.07, 0.06, 8,
             {Label::kPole, Material::kSignFace, instance}, mesh);
}

}  // namespace icpscape
