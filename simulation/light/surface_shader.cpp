#include "simulation/light/surface_shader.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

template <typename T>
T blend(const std::vector<T>& values, const std::array<std::uint32_t, 4>& quad, float u, float v) {
  return (values[quad[0]] * (1 - u) + values[quad[1]] * u) * (1 - v) +
         (values[quad[3]] * (1 - u) + values[quad[2]] * u) * v;
}

/// Area of the texture that a patch shows, as a fraction of the bitmap (which it may cover many times).
float texture_area(const Mesh& mesh, const Patch& patch) {
  float area = 0;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(patch.columns) * patch.rows; ++i) {
    const auto& q = mesh.quads[patch.first_quad + i];
    const Vector2f a = mesh.uvs[q[2]] - mesh.uvs[q[0]], b = mesh.uvs[q[3]] - mesh.uvs[q[1]];
    area += 0.5F * std::abs(a.x() * b.y() - a.y() * b.x());
  }
  return area;
}

}  // namespace

float infrared_return(const Material& material, float cosine) {
  // The dots fade as the surface turns away and are lost below about 10 degrees of grazing angle.
  const float x = std::clamp((cosine - 0.08F) / 0.27F, 0.0F, 1.0F);
  return material.infrared_return * x * x * (3 - 2 * x);
}

Rgb highlights(const std::vector<AreaLight>& lights, const Material& material, const Vector3f& position,
               const Vector3f& normal, const Vector3f& view) {
  Rgb sum = Rgb::Zero();
  for (const AreaLight& light : lights) {
    const Vector3f centre = light.corner + 0.5F * (light.s_edge + light.t_edge);
    const Vector3f to_light = (centre - position).normalized();
    const float facing = normal.dot((to_light - view).normalized());
    if ((1 - facing) * material.shininess > 7 || to_light.dot(normal) <= 0) continue;  // less than 1/1000
    sum += light.radiance * std::pow(facing, material.shininess);
  }
  return sum * (0.3F * material.gloss);
}

SurfaceShader::SurfaceShader(const World& world, const BakedLight& light) : world_(world), light_(light) {
  for (const Patch& patch : world.mesh.patches) {
    const Texture& texture = world.textures[world.materials[patch.material].texture];
    const float texels =
        texture_area(world.mesh, patch) * static_cast<float>(texture.width() * texture.height());
    texels_per_metre_.push_back(std::sqrt(texels / std::max(1e-8F, patch.width * patch.height)));
  }
}

Vector3f SurfaceShader::normal(const Hit& hit, const Vector3f& direction) const {
  const Mesh& mesh = world_.mesh;
  const auto& quad = mesh.quads[hit.quad];
  const Patch& patch = mesh.patches[mesh.patch_of_quad[hit.quad]];
  const bool flat = patch.columns * patch.rows == 1;
  const Vector3f n = flat ? mesh.normals[quad[0]] : blend(mesh.normals, quad, hit.u, hit.v).normalized();
  return n.dot(direction) > 0 ? Vector3f(-n) : n;
}

bool SurfaceShader::surfaces_differ(const Hit& a, const Hit& b) const {
  const Mesh& mesh = world_.mesh;
  const std::uint32_t patch_a = mesh.patch_of_quad[a.quad], patch_b = mesh.patch_of_quad[b.quad];
  if (patch_a == patch_b) return false;
  const Patch &pa = mesh.patches[patch_a], &pb = mesh.patches[patch_b];
  if (pa.material != pb.material || pa.columns * pa.rows == 1 || pb.columns * pb.rows == 1) return true;
  const Vector3f& na = mesh.normals[mesh.quads[a.quad][0]];
  const Vector3f& nb = mesh.normals[mesh.quads[b.quad][0]];
  return na.dot(nb) < 0.95F;
}

Shade SurfaceShader::shade(const Hit& hit, const Vector3f& origin, const Vector3f& direction,
                           float pixel_angle, float shadow) const {
  const Mesh& mesh = world_.mesh;
  const auto& quad = mesh.quads[hit.quad];
  const std::uint32_t patch_index = mesh.patch_of_quad[hit.quad];
  const Patch& patch = mesh.patches[patch_index];
  const Material& material = world_.materials[patch.material];
  const float length = direction.norm();
  const Vector3f n = normal(hit, direction), view = direction / length;
  const float cosine = std::max(0.02F, -n.dot(view));

  const std::uint32_t local = hit.quad - patch.first_quad;
  const float s = (static_cast<float>(local % patch.columns) + hit.u) / static_cast<float>(patch.columns);
  const float t = (static_cast<float>(local / patch.columns) + hit.v) / static_cast<float>(patch.rows);
  const Rgb light = light_.at(patch_index, s, t) * shadow;

  const Vector2f uv = blend(mesh.uvs, quad, hit.u, hit.v);
  const float seen = pixel_angle * hit.distance * length / std::sqrt(cosine);
  const Rgb surface = world_.textures[material.texture]
                          .sample(uv.x(), uv.y(), seen * texels_per_metre_[patch_index])
                          .cwiseProduct(material.tint);
  Shade result;
  result.colour = surface.cwiseProduct(light) + surface * material.emission;
  if (material.gloss > 0) {
    const float lit = std::min(1.0F, 1.4F * light.y());  // no highlights in the shade
    result.colour += highlights(world_.lights, material, origin + hit.distance * direction, n, view) * lit;
  }
  result.infrared = infrared_return(material, cosine);
  return result;
}

}  // namespace stdc::simulation
