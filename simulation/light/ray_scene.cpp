#include "simulation/light/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace stdc::simulation {

struct RayScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

/// One device for the process would be a global; a device is cheap once Embree is loaded, and with one build
/// thread it starts no workers of its own.
constexpr const char* kDeviceSettings = "threads=1,set_affinity=0,start_threads=0";

void fill_geometry(RTCGeometry geometry, const Mesh& mesh) {
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.positions.size()));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(std::uint32_t), mesh.quads.size()));
  if (vertices == nullptr || indices == nullptr)
    throw std::runtime_error("Embree has no memory for the scene");
  std::memcpy(vertices, mesh.positions.data(), mesh.positions.size() * sizeof(Eigen::Vector3f));
  std::memcpy(indices, mesh.quads.data(), mesh.quads.size() * sizeof(mesh.quads[0]));
}

}  // namespace

RayScene::RayScene(const Mesh& mesh, TreeQuality quality)
    : mesh_(&mesh), handles_(std::make_unique<Handles>()) {
  handles_->device = rtcNewDevice(kDeviceSettings);
  if (handles_->device == nullptr) throw std::runtime_error("Embree cannot start on this processor");
  // Embree's robust mode is not asked for: it takes twice the time, and of 12 million rays five differ by
  // more than a thousandth of their length (at the common edge of two quads).
  handles_->scene = rtcNewScene(handles_->device);
  const RTCBuildQuality build =
      quality == TreeQuality::good ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_LOW;
  rtcSetSceneBuildQuality(handles_->scene, build);
  RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_QUAD);
  rtcSetGeometryBuildQuality(geometry, build);
  fill_geometry(geometry, mesh);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(handles_->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(handles_->scene);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;

void RayScene::refine(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, std::uint32_t quad,
                      bool second_half, Hit* hit) const {
  // Embree's quad is the triangles (0, 1, 3) and (2, 3, 1); the second runs backwards from the far corner.
  const auto& q = mesh_->quads[quad];
  const Eigen::Vector3d base = mesh_->positions[q[second_half ? 2 : 0]].cast<double>();
  const Eigen::Vector3d along_u = mesh_->positions[q[second_half ? 3 : 1]].cast<double>() - base;
  const Eigen::Vector3d along_v = mesh_->positions[q[second_half ? 1 : 3]].cast<double>() - base;
  const Eigen::Vector3d d = direction.cast<double>();
  const Eigen::Vector3d from_base = origin.cast<double>() - base;
  const Eigen::Vector3d normal = along_u.cross(along_v);
  const double slope = normal.dot(d);
  if (slope == 0) return;  // edge on: keep what was known
  const Eigen::Vector3d m = from_base.cross(d);
  const double u = std::clamp(-m.dot(along_v) / slope, 0.0, 1.0);
  const double v = std::clamp(m.dot(along_u) / slope, 0.0, 1.0);
  hit->distance = static_cast<float>(-normal.dot(from_base) / slope);
  hit->quad = quad;
  hit->u = static_cast<float>(second_half ? 1 - u : u);
  hit->v = static_cast<float>(second_half ? 1 - v : v);
}

bool RayScene::trace(const Eigen::Vector3f& origin, const Eigen::Vector3f* directions, int count,
                     Hit* hits) const {
  RTCRayHit8 packet;
  alignas(32) int valid[kPacket];
  for (int i = 0; i < kPacket; ++i) {
    const int k = std::min(i, count - 1);
    valid[i] = i < count ? -1 : 0;
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    packet.ray.dir_x[i] = directions[k].x();
    packet.ray.dir_y[i] = directions[k].y();
    packet.ray.dir_z[i] = directions[k].z();
    packet.ray.tnear[i] = 0;
    packet.ray.tfar[i] = hits[k].distance;
    packet.ray.time[i] = 0;
    packet.ray.mask[i] = ~0U;
    packet.ray.id[i] = 0;
    packet.ray.flags[i] = 0;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, handles_->scene, &context, &packet);
  bool changed = false;
  for (int i = 0; i < count; ++i) {
    if (packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    refine(origin, directions[i], packet.hit.primID[i], packet.hit.u[i] + packet.hit.v[i] > 1.0F, &hits[i]);
    changed = true;
  }
  return changed;
}

Hit RayScene::trace(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near,
                    float far) const {
  RTCRayHit ray{};
  ray.ray = {origin.x(), origin.y(), origin.z(), near, direction.x(), direction.y(), direction.z(), 0,
             far,        ~0U,        0,          0};
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(handles_->scene, &context, &ray);
  Hit hit;
  if (ray.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
    refine(origin, direction, ray.hit.primID, ray.hit.u + ray.hit.v > 1.0F, &hit);
  }
  return hit;
}

bool RayScene::occluded(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float far) const {
  RTCRay ray{origin.x(), origin.y(), origin.z(), 0, direction.x(), direction.y(), direction.z(), 0,
             far,        ~0U,        0,          0};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(handles_->scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace stdc::simulation
