#include "simulation/light/baked_light.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "simulation/light/float4.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kOffset = 1e-3F;           // start of a ray above its surface [m]
constexpr float kMinNodeSpacing = 0.014F;  // [m]
constexpr float kCoarsestNode = 0.055F;
constexpr int kCellsAcross = 32;  // a patch gets about so many nodes along a side between those limits

// A node is four 16-bit numbers: square roots of red, green, blue, and a mark that it is known.
constexpr float kMaxLight = 16.0F;
constexpr float kCodeScale = 65535.0F;
constexpr std::uint64_t kKnown = 1ULL << 63U;

std::uint64_t encode(const Rgb& colour) {
  std::uint64_t code = kKnown;
  for (int i = 0; i < 3; ++i) {
    const float root = std::sqrt(std::clamp(colour[i] / kMaxLight, 0.0F, 1.0F));
    code |= static_cast<std::uint64_t>(root * kCodeScale + 0.5F) << static_cast<unsigned>(16 * i);
  }
  return code;
}

/// Light in units of kMaxLight / kCodeScale^2.
Float4 decode(std::uint64_t code) {
  const Float4 root = floats_of_shorts(code);
  return root * root;
}

int cell_count(float length) {
  const float node = std::clamp(length / kCellsAcross, kMinNodeSpacing, kCoarsestNode);
  return std::clamp(static_cast<int>(std::ceil(length / node)), 1, 400);
}

}  // namespace

BakedLight::BakedLight(const World& world, const RayScene& scene) : world_(world), scene_(scene) {
  constexpr int kDirections = 24;
  for (int i = 0; i < kDirections; ++i) {  // cosine-weighted, on Vogel's spiral
    const double square = (i + 0.5) / kDirections, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(square);
    hemisphere_.emplace_back(
        Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - square))
            .cast<float>());
  }
  std::uint32_t count = 0;
  for (const Patch& patch : world.mesh.patches) {
    Grid grid;
    grid.first = count;
    grid.columns = static_cast<std::uint16_t>(cell_count(patch.width));
    grid.rows = static_cast<std::uint16_t>(cell_count(patch.height));
    count += (grid.columns + 1U) * (grid.rows + 1U);
    grids_.push_back(grid);
  }
  nodes_ = std::make_unique<std::atomic<std::uint64_t>[]>(count);
  for (const Material& m : world.materials) {
    material_means_.push_back(world.textures[m.texture].mean().cwiseProduct(m.tint));
  }
}

Rgb BakedLight::at(std::uint32_t patch, float s, float t) const {
  const Grid& grid = grids_[patch];
  const float x = s * static_cast<float>(grid.columns), y = t * static_cast<float>(grid.rows);
  const int column = std::clamp(static_cast<int>(x), 0, grid.columns - 1);
  const int row = std::clamp(static_cast<int>(y), 0, grid.rows - 1);
  const float fx = x - static_cast<float>(column), fy = y - static_cast<float>(row);
  const auto value = [&](int c, int r) { return decode(node(grid, patch, c, r)); };
  const Float4 top = value(column, row) * (1 - fx) + value(column + 1, row) * fx;
  const Float4 bottom = value(column, row + 1) * (1 - fx) + value(column + 1, row + 1) * fx;
  const Float4 light = top * (1 - fy) + bottom * fy;
  return Rgb(light[0], light[1], light[2]) * (kMaxLight / (kCodeScale * kCodeScale));
}

std::uint64_t BakedLight::node(const Grid& grid, std::uint32_t patch, int column, int row) const {
  const std::uint32_t index = grid.first + row * (grid.columns + 1U) + column;
  const std::uint64_t known = nodes_[index].load(std::memory_order_relaxed);
  return known != 0 ? known : compute(grid, patch, column, row, index);
}

std::uint64_t BakedLight::compute(const Grid& grid, std::uint32_t patch_index, int column, int row,
                                  std::uint32_t index) const {
  const Patch& patch = world_.mesh.patches[patch_index];
  // Nodes on the border look from just inside, not from within the neighbour they touch.
  const auto place = [](int i, int cells, int quads) {
    const float at = std::clamp(static_cast<float>(i) / static_cast<float>(cells), 0.004F, 0.996F);
    return at * static_cast<float>(quads);
  };
  const float x = place(column, grid.columns, patch.columns), y = place(row, grid.rows, patch.rows);
  const int qx = std::min(static_cast<int>(x), patch.columns - 1),
            qy = std::min(static_cast<int>(y), patch.rows - 1);
  const auto& q = world_.mesh.quads[patch.first_quad + static_cast<std::uint32_t>(qy * patch.columns + qx)];
  const float u = x - static_cast<float>(qx), v = y - static_cast<float>(qy);
  const auto blend = [&](const std::vector<Vector3f>& values) -> Vector3f {
    return (values[q[0]] * (1 - u) + values[q[1]] * u) * (1 - v) +
           (values[q[3]] * (1 - u) + values[q[2]] * u) * v;
  };
  const Vector3f normal = blend(world_.mesh.normals).normalized();
  const Rgb light = gather(blend(world_.mesh.positions) + kOffset * normal, normal, index);
  const std::uint64_t code = encode(light);
  nodes_[index].store(code, std::memory_order_relaxed);
  return code;
}

Rgb BakedLight::gather(const Vector3f& position, const Vector3f& normal, std::uint64_t seed) const {
  return direct(position, normal, seed) + indirect(position, normal);
}

Rgb BakedLight::direct(const Vector3f& position, const Vector3f& normal, std::uint64_t seed) const {
  constexpr int kAcross = 4, kDown = 3;  // strata on each light
  constexpr double kJitter =
      0.35;  // of a stratum: hides the steps that a fixed pattern leaves in half shadows
  Random random(seed, 2);
  Rgb sum = Rgb::Zero();
  for (const AreaLight& light : world_.lights) {
    const Vector3f facing = light.s_edge.cross(light.t_edge);
    for (int i = 0; i < kAcross * kDown; ++i) {
      const auto s = static_cast<float>((i % kAcross + 0.5 + kJitter * (random.uniform() - 0.5)) / kAcross);
      const auto t = static_cast<float>((i / kAcross + 0.5 + kJitter * (random.uniform() - 0.5)) / kDown);
      const Vector3f direction = light.corner + s * light.s_edge + t * light.t_edge - position;
      const float cosine = direction.dot(normal),
                  emitted = -direction.dot(facing);  // times distance (and area)
      if (cosine <= 0 || emitted <= 0) continue;
      if (scene_.occluded(position, direction, 0.995F)) continue;
      const float square = direction.squaredNorm();
      const float weight = cosine * emitted / (std::numbers::pi_v<float> * square * square);
      sum += light.radiance * (weight / static_cast<float>(kAcross * kDown));
    }
  }
  return sum;
}

Rgb BakedLight::indirect(const Vector3f& position, const Vector3f& normal) const {
  constexpr float kWallLight = 0.55F;    // light on a typical wall
  constexpr float kOpenDistance = 0.8F;  // nearer surfaces lie in each other's shade [m]
  const Vector3f side = normal.unitOrthogonal(), other = normal.cross(side);
  Rgb sum = Rgb::Zero();
  // The same directions at every node, so that neighbours agree and walls have no blotches.
  for (const Vector3f& local : hemisphere_) {
    const Hit hit = scene_.trace(position, local.x() * side + local.y() * other + local.z() * normal, 0, 50);
    if (!hit.valid()) continue;
    const auto& patch = world_.mesh.patches[world_.mesh.patch_of_quad[hit.quad]];
    if (world_.materials[patch.material].emission > 0) continue;  // counted as direct light
    const float open = std::min(1.0F, 0.15F + 0.85F * hit.distance / kOpenDistance);
    sum += material_means_[patch.material] * (kWallLight * open);
  }
  return sum / static_cast<float>(hemisphere_.size());
}

}  // namespace stdc::simulation
