// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/mesh.h"

#include <cmath>

namespace icpscape {
namespace {

std::array<float, 3> ToFloat(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

void Mesh::AddTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Surface& surface) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {ToFloat(a), ToFloat(b), ToFloat(c)});
  triangles.push_back({first, first + 1, first + 2});
  surfaces.push_back(surface);
}

void Mesh::AddQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                   const Surface& surface) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  vertices.insert(vertices.end(), {ToFloat(a), ToFloat(b), ToFloat(c), ToFloat(d)});
  triangles.push_back({first, first + 1, first + 2});
  triangles.push_back({first, first + 2, first + 3});
  surfaces.insert(surfaces.end(), 2, surface);
}

void Mesh::Append(const Mesh& other, const SE3d& T_this_other) {
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (std::uint32_t i = 0; i < other.vertices.size(); ++i) {
    vertices.push_back(ToFloat(T_this_other * other.Vertex(i)));
  }
  for (const auto& triangle : other.triangles) {
    triangles.push_back({first + triangle[0], first + triangle[1], first + triangle[2]});
  }
  surfaces.insert(surfaces.end(), other.surfaces.begin(), other.surfaces.end());
}

SE3d Placement(double x, double y, double z, double yaw_rad) {
  const Mat3 R = Eigen::AngleAxisd(yaw_rad, Vec3::UnitZ()).toRotationMatrix();
  return SE3d(R, Vec3(x, y, z));
}

void AddBox(const SE3d& T_mesh_box, const Vec3& low, const Vec3& high, const Surface& surface,
            Mesh* mesh) {
  Vec3 corner[8];
  for (unsigned i = 0; i < 8; ++i) {
    corner[i] =
        T_mesh_box * Vec3((i & 1U) != 0 ? high.x() : low.x(), (i & 2U) != 0 ? high.y() : low.y(),
                          (i & 4U) != 0 ? high.z() : low.z());
  }
  constexpr int kFaces[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};
  for (const auto& face : kFaces) {
    mesh->AddQuad(corner[face[0]], corner[face[1]], corner[face[2]], corner[face[3]], surface);
  }
}

void AddFrustum(const Vec3& a, const Vec3& b, double radius_a_m, double radius_b_m, int sides,
                const Surface& surface, Mesh* mesh) {
  const Vec3 axis = (b - a).normalized();
  const Vec3 helper = std::abs(axis.z()) < 0.9 ? Vec3::UnitZ() : Vec3::UnitX();
  const Vec3 u = axis.cross(helper).normalized();
  const Vec3 v = axis.cross(u);
  const auto rim = [&](int i) -> Vec3 {
    const double angle = 2 * M_PI * i / sides;
    return std::cos(angle) * u + std::sin(angle) * v;
  };
  for (int i = 0; i < sides; ++i) {
    const Vec3 r0 = rim(i);
    const Vec3 r1 = rim(i + 1);
    mesh->AddQuad(a + radius_a_m * r0, a + radius_a_m * r1, b + radius_b_m * r1,
                  b + radius_b_m * r0, surface);
    mesh->AddTriangle(a, a + radius_a_m * r0, a + radius_a_m * r1, surface);
    mesh->AddTriangle(b, b + radius_b_m * r0, b + radius_b_m * r1, surface);
  }
}

void AddPatch(int rows, int columns, const std::function<Vec3(int, int)>& point,
              const Surface& surface, Mesh* mesh, const std::function<bool(int, int)>& skip) {
  const auto first = static_cast<std::uint32_t>(mesh->vertices.size());
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      mesh->vertices.push_back(ToFloat(point(i, j)));
    }
  }
  const auto index = [&](int i, int j) {
    return first + static_cast<std::uint32_t>(i * (columns + 1) + j);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (skip && skip(i, j)) {
        continue;
      }
      mesh->triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh->triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
      mesh->surfaces.insert(mesh->surfaces.end(), 2, surface);
    }
  }
}

}  // namespace icpscape
