#include "simulation/sequence/dynamic_scene.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

/// A capsule that blocks light.
struct Blocker {
  Vector3f a, b;
  float radius = 0;
};

/// One person or prop within the common mesh.
struct Instance {
  std::uint32_t first_quad = 0, first_vertex = 0;
  const Person* person = nullptr;
  const Prop* prop = nullptr;
  bool moves = true;
  std::vector<Blocker> blockers;
  Eigen::AlignedBox3f reach;  ///< it casts no shadow beyond
};

constexpr float kShadowReach = 0.9F;  // [m]

class SceneSnapshot : public MovingObjects {
 public:
  SceneSnapshot(const World& world, const LightProbes& probes, const std::vector<Person>& people,
                const std::vector<Prop>& props, double time)
      : world_(world) {
    for (const Person& person : people) add(person, probes, time);
    for (const Prop& prop : props) add(prop, probes, time);
    scene_ = std::make_unique<RayScene>(mesh_, TreeQuality::fast);
  }

  bool trace(const Vector3f& origin, const Vector3f* directions, int count, Hit* hits) const override {
    return scene_->trace(origin, directions, count, hits);
  }

  std::uint32_t surface(const Hit& hit) const override {
    const Instance& a = instance_of(hit);
    if (a.person != nullptr)
      return a.first_quad * 16 +
             static_cast<std::uint32_t>(a.person->mesh.regions()[hit.quad - a.first_quad]);
    return a.first_quad * 16 + a.prop->mesh().patch_of_quad[hit.quad - a.first_quad] * 131;
  }

  bool dynamic(const Hit& hit) const override { return instance_of(hit).moves; }

  bool ever_dynamic(const Hit& hit) const override {
    const Instance& a = instance_of(hit);
    return a.prop == nullptr || a.prop->ever_moves();
  }

  float shadow(const Vector3f& position, const Vector3f& normal) const override {
    float light = 1;
    for (const Instance& a : instances_) {
      if (!a.reach.contains(position)) continue;
      for (const Blocker& blocker : a.blockers) {
        const Vector3f axis = blocker.b - blocker.a;
        const float h =
            std::clamp((position - blocker.a).dot(axis) / std::max(1e-6F, axis.squaredNorm()), 0.0F, 1.0F);
        const Vector3f to_blocker = blocker.a + h * axis - position;
        const float square = to_blocker.squaredNorm(), facing = normal.dot(to_blocker);
        if (facing <= 0 || square > kShadowReach * kShadowReach) continue;
        // Share of a cosine-weighted sky that a ball of this size hides, fading to 0 at kShadowReach.
        const float length = std::sqrt(square), fade = 1 - square / (kShadowReach * kShadowReach);
        const float hidden =
            facing / length * std::min(1.0F, blocker.radius * blocker.radius / square) * fade;
        light *= 1 - 0.8F * hidden;
      }
    }
    return light;
  }

  Shade shade(const Hit& hit, const Vector3f& origin, const Vector3f& direction,
              float pixel_angle) const override {
    const Instance& a = instance_of(hit);
    const auto& quad = mesh_.quads[hit.quad];
    const auto blend = [&](const auto& values) { return blended(values, quad, 0, hit); };
    Vector3f n = blend(mesh_.normals).normalized();
    const float length = direction.norm();
    const Vector3f view = direction / length;
    if (n.dot(view) > 0) n = -n;
    const float cosine = std::max(0.05F, -n.dot(view));
    const float seen = pixel_angle * hit.distance * length / std::sqrt(cosine);
    const Rgb light = blend(light_);
    Shade result;
    if (a.person != nullptr) {
      const BodyRegion region = a.person->mesh.regions()[hit.quad - a.first_quad];
      const auto& rest = a.person->mesh.vertices();
      const auto weights = corner_weights(hit);
      Vector3f at = Vector3f::Zero(), normal = Vector3f::Zero();
      for (int i = 0; i < 4; ++i) {
        at += weights[i] * rest[quad[i] - a.first_vertex].position;
        normal += weights[i] * rest[quad[i] - a.first_vertex].normal;
      }
      result.colour = a.person->textures.colour(region, at, normal.normalized(), seen).cwiseProduct(light);
      Material surface;
      surface.infrared_return = region == BodyRegion::hair ? 0.45F : 0.85F;
      result.infrared = infrared_return(surface, cosine);
      return result;
    }
    const Mesh& own = a.prop->mesh();
    const std::uint32_t local = hit.quad - a.first_quad;
    const Material& material = world_.materials[own.patches[own.patch_of_quad[local]].material];
    const Texture& texture = world_.textures[material.texture];
    const Eigen::Vector2f uv = blended(own.uvs, own.quads[local], 0, hit);
    const float texels = seen * texels_per_metre(own, own.quads[local], texture);
    const Rgb surface = texture.sample(uv.x(), uv.y(), texels).cwiseProduct(material.tint);
    result.colour = surface.cwiseProduct(light);
    if (material.gloss > 0)
      result.colour += highlights(world_.lights, material, origin + hit.distance * direction, n, view);
    result.infrared = infrared_return(material, cosine);
    return result;
  }

 private:
  static std::array<float, 4> corner_weights(const Hit& h) {
    return {(1 - h.u) * (1 - h.v), h.u * (1 - h.v), h.u * h.v, (1 - h.u) * h.v};
  }
  template <typename T>
  static T blended(const std::vector<T>& values, const std::array<std::uint32_t, 4>& quad,
                   std::uint32_t first, const Hit& hit) {
    const auto w = corner_weights(hit);
    return w[0] * values[quad[0] - first] + w[1] * values[quad[1] - first] + w[2] * values[quad[2] - first] +
           w[3] * values[quad[3] - first];
  }
  static float texels_per_metre(const Mesh& mesh, const std::array<std::uint32_t, 4>& q,
                                const Texture& texture) {
    const float metres = (mesh.positions[q[2]] - mesh.positions[q[0]]).norm();
    const Eigen::Vector2f uv = mesh.uvs[q[2]] - mesh.uvs[q[0]];
    const float texels = Eigen::Vector2f(uv.x() * static_cast<float>(texture.width()),
                                         uv.y() * static_cast<float>(texture.height()))
                             .norm();
    return texels / std::max(1e-5F, metres);
  }

  const Instance& instance_of(const Hit& hit) const {
    std::size_t i = instances_.size() - 1;
    while (i > 0 && instances_[i].first_quad > hit.quad) --i;
    return instances_[i];
  }

  Instance& begin_instance() {
    Instance a;
    a.first_quad = static_cast<std::uint32_t>(mesh_.quads.size());
    a.first_vertex = static_cast<std::uint32_t>(mesh_.positions.size());
    instances_.push_back(a);
    return instances_.back();
  }

  static void block(Instance& a, const Vector3f& from, const Vector3f& to, float radius) {
    a.blockers.push_back({from, to, radius});
    for (const Vector3f& p : {from, to}) {
      a.reach.extend(Vector3f(p - Vector3f::Constant(kShadowReach)));
      a.reach.extend(Vector3f(p + Vector3f::Constant(kShadowReach)));
    }
  }

  void add(const Person& person, const LightProbes& probes, double time) {
    Instance& a = begin_instance();
    a.person = &person;
    const BodyPose pose = person.motion.pose(time);
    person.mesh.append(pose, mesh_);
    const Skeleton& skeleton = person.motion.skeleton();
    std::array<LightCube, kBones> light;
    for (int i = 0; i < kBones; ++i) {
      const auto bone = static_cast<Bone>(i);
      const Vector3f from = pose.bones[i].translation.cast<float>();
      const Vector3f to = pose.point(skeleton, bone, skeleton.end(bone)).cast<float>();
      light[i] = probes.at(0.5F * (from + to));
      block(a, from, to, static_cast<float>(skeleton.radius(bone)));
    }
    const auto& rest = person.mesh.vertices();
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const Vector3f& n = mesh_.normals[a.first_vertex + i];
      Rgb sum = Rgb::Zero();
      for (std::size_t k = 0; k < rest[i].bones.size(); ++k) {
        if (rest[i].weights[k] > 1e-3F) sum += rest[i].weights[k] * light[rest[i].bones[k]].on(n);
      }
      light_.push_back(sum * rest[i].sky_visibility);
    }
  }

  void add(const Prop& prop, const LightProbes& probes, double time) {
    Instance& a = begin_instance();
    a.prop = &prop;
    a.moves = prop.moving(time);
    const Pose pose = prop.world_from_prop(time);
    const Eigen::Matrix3f rotation = pose.rotation_matrix().cast<float>();
    const Vector3f shift = pose.translation.cast<float>();
    const Mesh& own = prop.mesh();
    Eigen::AlignedBox3f box;
    for (std::size_t i = 0; i < own.positions.size(); ++i) {
      const Vector3f position = rotation * own.positions[i] + shift, normal = rotation * own.normals[i];
      box.extend(position);
      mesh_.positions.push_back(position);
      mesh_.normals.push_back(normal);
      light_.push_back(probes.at(position + 0.05F * normal).on(normal));
    }
    for (auto quad : own.quads) {
      for (std::uint32_t& corner : quad) corner += a.first_vertex;
      mesh_.quads.push_back(quad);
    }
    block(a, box.center(), box.center(), static_cast<float>(prop.radius()));
  }

  const World& world_;
  Mesh mesh_;
  std::vector<Rgb> light_;  ///< on each vertex
  std::vector<Instance> instances_;
  std::unique_ptr<RayScene> scene_;
};

}  // namespace

bool DynamicScene::has_moving_props() const {
  return std::any_of(props_.begin(), props_.end(), [](const Prop& prop) { return prop.ever_moves(); });
}

std::unique_ptr<MovingObjects> DynamicScene::at(double time) const {
  if (people_.empty() && props_.empty()) return nullptr;
  return std::make_unique<SceneSnapshot>(world_, probes_, people_, props_, time);
}

}  // namespace stdc::simulation
