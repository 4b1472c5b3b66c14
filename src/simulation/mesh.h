// SPDX-License-Identifier: BSD-3-Clause
#ifndef ICPSCAPE_SRC_SIMULATION_MESH_H_
#define ICPSCAPE_SRC_SIMULATION_MESH_H_

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "icpscape/residuals/lie.h"
#include "icpscape/simulation/surface.h"

namespace icpscape {

/// Triangles with a surface each; metres. Both sides of a triangle are solid.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Surface> surfaces;  ///< One per triangle.

  std::size_t size() const { return triangles.size(); }
  Vec3 Vertex(std::uint32_t i) const { return {vertices[i][0], vertices[i][1], vertices[i][2]}; }

  void AddTriangle(const Vec3& a, const Vec3& b, const Vec3& c, const Surface& surface);
  /// The corners in order around the quadrilateral.
  void AddQuad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Surface& surface);
  /// All of another mesh, moved.
  void Append(const Mesh& other, const SE3d& T_this_other);
};

/// A pose on the ground: x, y, z in metres, turned about z by yaw_rad.
SE3d Placement(double x, double y, double z, double yaw_rad);

/// The box [low, high] in the frame of T_mesh_box.
void AddBox(const SE3d& T_mesh_box, const Vec3& low, const Vec3& high, const Surface& surface,
            Mesh* mesh);

/// A frustum about the segment from a to b, with caps, of `sides` sides.
void AddFrustum(const Vec3& a, const Vec3& b, double radius_a_m, double radius_b_m, int sides,
                const Surface& surface, Mesh* mesh);

/// A patch of rows x columns quadrilaterals between the points point(i, j), i in [0, rows], j in
/// [0, columns]. Cells for which skip(i, j) is true are left out; no skip keeps all.
void AddPatch(int rows, int columns, const std::function<Vec3(int, int)>& point,
              const Surface& surface, Mesh* mesh,
              const std::function<bool(int, int)>& skip = nullptr);

}  // namespace icpscape

#endif  // ICPSCAPE_SRC_SIMULATION_MESH_H_
