// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/simulation/ray_caster.h"

#include <embree3/rtcore.h>
#include <oneapi/tbb/task_arena.h>

#include <cmath>
#include <string>

#include "icpscape/common/error.h"

namespace icpscape {

struct RayCaster::Impl {
  Mesh mesh;
  std::vector<std::array<float, 3>> vertices_at_end;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Impl(Mesh m, std::vector<std::array<float, 3>> at_end)
      : mesh(std::move(m)), vertices_at_end(std::move(at_end)) {
    // Not "threads=1", which would hold all of oneTBB to one thread while the device lives.
    device = rtcNewDevice("isa=sse2");
    if (device == nullptr) {
      throw ComputationError("Embree does not start: error " +
                             std::to_string(rtcGetDeviceError(nullptr)) + ".");
    }
    scene = rtcNewScene(device);
    // Robust: no ray slips between two triangles of one edge.
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    if (mesh.size() > 0) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      const auto set_vertices = [&](unsigned step, std::vector<std::array<float, 3>>* vertices) {
        vertices->push_back({0, 0, 0});  // Embree reads 16 bytes of the last vertex.
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3,
                                   vertices->data(), 0, sizeof(vertices->front()),
                                   vertices->size() - 1);
      };
      if (!vertices_at_end.empty()) {
        rtcSetGeometryTimeStepCount(geometry, 2);
        set_vertices(1, &vertices_at_end);
      }
      set_vertices(0, &mesh.vertices);
      rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                 mesh.triangles.data(), 0, sizeof(mesh.triangles[0]),
                                 mesh.triangles.size());
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(scene, geometry);
      rtcReleaseGeometry(geometry);
    }
    // Built on one thread: the same tree on every machine.
    tbb::task_arena arena(1);
    arena.execute([&] { rtcJoinCommitScene(scene); });
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
      Release();
      throw ComputationError("Embree cannot build the scene: error " + std::to_string(error) + ".");
    }
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() { Release(); }

  void Release() {
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
};

RayCaster::RayCaster(Mesh mesh, std::vector<std::array<float, 3>> vertices_at_end)
    : impl_(std::make_unique<Impl>(std::move(mesh), std::move(vertices_at_end))) {}
RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

bool RayCaster::Cast(const Vec3& origin, const Vec3& direction, double max_range_m, RayHit* hit,
                     double share) const {
  RTCRayHit query{};
  query.ray.org_x = static_cast<float>(origin.x());
  query.ray.org_y = static_cast<float>(origin.y());
  query.ray.org_z = static_cast<float>(origin.z());
  query.ray.dir_x = static_cast<float>(direction.x());
  query.ray.dir_y = static_cast<float>(direction.y());
  query.ray.dir_z = static_cast<float>(direction.z());
  query.ray.tfar = static_cast<float>(max_range_m);
  query.ray.time = static_cast<float>(share);
  query.ray.mask = 0xFFFFFFFFU;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
    return false;
  }
  const Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  hit->range_m = query.ray.tfar;
  hit->cos_incidence = std::abs(normal.normalized().dot(direction));
  hit->surface = impl_->mesh.surfaces[query.hit.primID];
  return true;
}

}  // namespace icpscape
