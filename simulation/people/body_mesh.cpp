#include "simulation/people/body_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/light/ray_scene.hpp"
#include "simulation/people/surface_nets.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

float distance_to_bone(const Skeleton& skeleton, Bone bone, const Vector3f& p) {
  const Vector3f a = skeleton.joint(bone).cast<float>(),
                 axis = (skeleton.end(bone) - skeleton.joint(bone)).cast<float>();
  const float h = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0F, 1.0F);
  return (p - a - h * axis).norm() - static_cast<float>(skeleton.radius(bone));
}

/// Sets the skinning weights: they fall off with the distance beyond that of the nearest bone.
void bind(const Skeleton& skeleton, const std::vector<Bone>& bones, BodyMesh::Vertex* vertex) {
  constexpr float kSoftness = 0.016F;  // [m]
  std::vector<std::pair<float, Bone>> candidates;
  for (const Bone bone : bones)
    candidates.emplace_back(distance_to_bone(skeleton, bone, vertex->position), bone);
  std::sort(candidates.begin(), candidates.end());
  float sum = 0;
  for (std::size_t i = 0; i < vertex->bones.size(); ++i) {
    const auto& [distance, bone] = candidates[std::min(i, candidates.size() - 1)];
    const float farther = (distance - candidates[0].first) / kSoftness;
    const float weight = i < candidates.size() ? std::exp(-farther * farther) : 0;
    vertex->bones[i] = static_cast<std::uint8_t>(index(bone));
    vertex->weights[i] = weight;
    sum += weight;
  }
  for (float& weight : vertex->weights) weight /= sum;
}

}  // namespace

BodyMesh::BodyMesh(const Skeleton& skeleton, const PersonAppearance& appearance) {
  for (int i = 0; i < kBones; ++i) joints_[i] = skeleton.joint(static_cast<Bone>(i)).cast<float>();
  for (const BodyPart& part : body_parts(skeleton, appearance)) add_part(skeleton, part);
  find_sky_visibility();
}

void BodyMesh::add_part(const Skeleton& skeleton, const BodyPart& part) {
  const QuadSurface surface = surface_of(part.solid, part.cell);
  const auto first = static_cast<std::uint32_t>(vertices_.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    Vertex vertex;
    vertex.position = surface.positions[i];
    vertex.normal = surface.normals[i];
    bind(skeleton, part.bones, &vertex);
    vertices_.push_back(vertex);
  }
  for (auto quad : surface.quads) {
    for (std::uint32_t& corner : quad) corner += first;
    quads_.push_back(quad);
    regions_.push_back(part.region);
  }
}

void BodyMesh::find_sky_visibility() {
  constexpr int kDirections = 12;
  constexpr float kReach = 0.3F, kOffset = 0.004F;  // [m]
  Mesh mesh;
  for (const Vertex& v : vertices_) mesh.positions.push_back(v.position);
  mesh.quads = quads_;
  const RayScene scene(mesh, TreeQuality::fast);
  for (Vertex& v : vertices_) {
    const Vector3f side = v.normal.unitOrthogonal(), other = v.normal.cross(side);
    float open = 0;
    for (int i = 0; i < kDirections; ++i) {  // cosine-weighted, on Vogel's spiral
      const float square = (static_cast<float>(i) + 0.5F) / kDirections, radius = std::sqrt(square);
      const float angle = static_cast<float>(i) * std::numbers::pi_v<float> * 0.763932F;
      const Vector3f direction =
          radius * (std::cos(angle) * side + std::sin(angle) * other) + std::sqrt(1 - square) * v.normal;
      if (!scene.occluded(v.position + kOffset * v.normal, direction, kReach)) open += 1.0F / kDirections;
    }
    v.sky_visibility = 0.25F + 0.75F * open;
  }
}

void BodyMesh::append(const BodyPose& pose, Mesh& mesh) const {
  struct Transform {
    Eigen::Matrix3f rotation;
    Vector3f shift;
  };
  std::array<Transform, kBones> transforms;
  for (int i = 0; i < kBones; ++i) {
    transforms[i].rotation = pose.bones[i].rotation_matrix().cast<float>();
    transforms[i].shift = pose.bones[i].translation.cast<float>() - transforms[i].rotation * joints_[i];
  }
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.reserve(first + vertices_.size());
  mesh.normals.reserve(first + vertices_.size());
  for (const Vertex& v : vertices_) {
    Vector3f position = Vector3f::Zero(), normal = Vector3f::Zero();
    for (std::size_t i = 0; i < v.bones.size(); ++i) {
      if (v.weights[i] < 1e-3F) continue;
      const Transform& t = transforms[v.bones[i]];
      position += v.weights[i] * (t.rotation * v.position + t.shift);
      normal += v.weights[i] * (t.rotation * v.normal);
    }
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal.normalized());
  }
  mesh.quads.reserve(mesh.quads.size() + quads_.size());
  for (auto quad : quads_) {
    for (std::uint32_t& corner : quad) corner += first;
    mesh.quads.push_back(quad);
  }
}

}  // namespace stdc::simulation
