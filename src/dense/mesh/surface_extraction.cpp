#include "dense/mesh/surface_extraction.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "dense/mesh/cube_cases.hpp"

namespace stdc {
namespace {

constexpr int kSide = DistanceField::kSide;

/// Which of the 3 x 512 edges that begin at a block's voxels the surface crosses, and the number of the
/// vertex on each: a bit per edge and a running count per word, a fraction of what a table of numbers would
/// take.
class EdgeVertices {
 public:
  static constexpr int kEdges = 3 * DistanceField::kVoxels;

  void set(int edge) { words_[edge / 64] |= std::uint64_t{1} << (edge % 64); }
  bool has(int edge) const { return (words_[edge / 64] >> (edge % 64) & 1U) != 0; }
  void number(std::uint32_t first) {
    first_ = first;
    std::uint16_t count = 0;
    for (int word = 0; word < kWords; ++word) {
      before_[word] = count;
      count = static_cast<std::uint16_t>(count + std::popcount(words_[word]));
    }
  }
  std::uint32_t vertex(int edge) const {
    const std::uint64_t below = words_[edge / 64] & ((std::uint64_t{1} << (edge % 64)) - 1);
    return first_ + before_[edge / 64] + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  static constexpr int kWords = kEdges / 64;
  std::array<std::uint64_t, kWords> words_{};
  std::array<std::uint16_t, kWords> before_{};
  std::uint32_t first_ = 0;
};

/// The distances of a block and of the first layers of the blocks after it.
class BlockCorners {
 public:
  BlockCorners(const DistanceField& field, int min_weight) : field_(field), min_weight_(min_weight) {}

  void set_block(std::size_t block) {
    const BlockKey key = field_.blocks().keys()[block];
    for (int n = 0; n < 8; ++n) {
      neighbours_[n] = field_.blocks().find({key.x + (n & 1), key.y + (n >> 1 & 1), key.z + (n >> 2 & 1)});
    }
    for (int z = 0; z <= kSide; ++z) {
      for (int y = 0; y <= kSide; ++y) {
        for (int x = 0; x <= kSide; ++x) values_[at(x, y, z)] = fetch(x, y, z);
      }
    }
  }
  /// In units of the field; kUnknown where too little is known.
  float value(int x, int y, int z) const { return values_[at(x, y, z)]; }
  /// The block that has a voxel of this one or after it.
  std::uint32_t block_at(int x, int y, int z) const {
    return neighbours_[(x >= kSide ? 1 : 0) | (y >= kSide ? 2 : 0) | (z >= kSide ? 4 : 0)];
  }
  static int voxel(int x, int y, int z) { return ((z % kSide) * kSide + y % kSide) * kSide + x % kSide; }
  static constexpr float kUnknown = 1e9F;

 private:
  static int at(int x, int y, int z) { return (z * (kSide + 1) + y) * (kSide + 1) + x; }
  float fetch(int x, int y, int z) const {
    const std::uint32_t block = block_at(x, y, z);
    if (block == BlockIndex::kNone) return kUnknown;
    const int index = voxel(x, y, z);
    const int weight = field_.weights(block)[index];
    if (weight < min_weight_) return kUnknown;
    return static_cast<float>(field_.sums(block)[index]) / static_cast<float>(weight);
  }

  const DistanceField& field_;
  int min_weight_;
  std::array<std::uint32_t, 8> neighbours_{};
  std::array<float, (kSide + 1) * (kSide + 1) * (kSide + 1)> values_{};
};

bool crosses(float a, float b) {
  return a != BlockCorners::kUnknown && b != BlockCorners::kUnknown && (a < 0) != (b < 0);
}

/// Makes the vertices on the edges that begin in a block.
void add_vertices(const BlockCorners& corners, const Eigen::Vector3f& origin, float voxel,
                  EdgeVertices& edges, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int z = 0, index = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x, ++index) {
        const float here = corners.value(x, y, z);
        for (int axis = 0; axis < 3; ++axis) {
          const float there = corners.value(x + (axis == 0), y + (axis == 1), z + (axis == 2));
          if (!crosses(here, there)) continue;
          edges.set(3 * index + axis);
          Eigen::Vector3f place(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
          place[axis] += std::clamp(here / (here - there), 0.01F, 0.99F);  // so that no triangle vanishes
          mesh.positions.push_back(origin + voxel * place);
        }
      }
    }
  }
  edges.number(first);
}

void add_triangles(const BlockCorners& corners, const std::vector<EdgeVertices>& edges,
                   const CubeCases& cases, TriangleMesh& mesh) {
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        unsigned inside = 0;
        bool known = true;
        for (int c = 0; c < 8; ++c) {
          const float value = corners.value(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
          known = known && value != BlockCorners::kUnknown;
          inside |= static_cast<unsigned>(value < 0) << c;
        }
        if (!known || inside == 0 || inside == 255) continue;
        for (const CubeCases::Triangle& triangle : cases.triangles(inside)) {
          std::array<std::uint32_t, 3> vertices{};
          for (int k = 0; k < 3; ++k) {
            const CubeCases::Edge& edge = CubeCases::edges()[triangle[k]];
            const int ex = x + (edge.corner & 1), ey = y + (edge.corner >> 1 & 1),
                      ez = z + (edge.corner >> 2);
            vertices[k] =
                edges[corners.block_at(ex, ey, ez)].vertex(3 * BlockCorners::voxel(ex, ey, ez) + edge.axis);
          }
          mesh.triangles.push_back(vertices);
        }
      }
    }
  }
}

/// Sets of things that are joined to each other (union-find with path halving).
class Groups {
 public:
  explicit Groups(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }
  std::uint32_t find(std::uint32_t a) {
    while (parents_[a] != a) a = parents_[a] = parents_[parents_[a]];
    return a;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parents_;
};

}  // namespace

TriangleMesh extract_surface(const DistanceField& field, int min_weight) {
  TriangleMesh mesh;
  const CubeCases cases;
  BlockCorners corners(field, std::max(1, min_weight));
  const std::size_t count = field.blocks().size();
  std::vector<EdgeVertices> edges(count);
  for (std::size_t block = 0; block < count; ++block) {
    corners.set_block(block);
    add_vertices(corners, field.origin(field.blocks().keys()[block]), field.voxel(), edges[block], mesh);
  }
  for (std::size_t block = 0; block < count; ++block) {
    corners.set_block(block);
    add_triangles(corners, edges, cases, mesh);
  }
  return mesh;
}

void drop_small_components(TriangleMesh& mesh, double min_area) {
  Groups groups(mesh.positions.size());
  for (const auto& triangle : mesh.triangles) {
    groups.join(triangle[0], triangle[1]);
    groups.join(triangle[0], triangle[2]);
  }
  std::vector<double> areas(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles) areas[groups.find(triangle[0])] += area_of(mesh, triangle);
  std::erase_if(mesh.triangles,
                [&](const auto& triangle) { return areas[groups.find(triangle[0])] < min_area; });
  std::vector<std::uint32_t> numbers(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) numbers[vertex] = 1;
  }
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == 0) continue;
    mesh.positions[next] = mesh.positions[i];
    numbers[i] = next++;
  }
  mesh.positions.resize(next);
  for (auto& triangle : mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex = numbers[vertex];
  }
}

void compute_normals(TriangleMesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : mesh.triangles) {
    const Eigen::Vector3f& a = mesh.positions[triangle[0]];
    const Eigen::Vector3f normal = (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a);
    for (const std::uint32_t vertex : triangle) mesh.normals[vertex] += normal;
  }
  for (Eigen::Vector3f& normal : mesh.normals) {
    const float length = normal.norm();
    normal = length > 0 ? Eigen::Vector3f(normal / length) : Eigen::Vector3f::UnitZ();
  }
}

}  // namespace stdc
