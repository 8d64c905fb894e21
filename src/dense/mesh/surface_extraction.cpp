#include "dense/mesh/surface_extraction.hpp"

#include <algorithm>
#include <numeric>

#include "dense/mesh/block_corners.hpp"

namespace stdc {
namespace {

constexpr int kSide = DistanceField::kSide;

bool crosses(float a, float b) {
  return a != BlockCorners::kUnknown && b != BlockCorners::kUnknown && (a < 0) != (b < 0);
}

/// Makes the vertices on the edges that begin in a block.
void add_block_vertices(const BlockCorners& corners, const Eigen::Vector3f& origin, float voxel,
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

/// Makes the triangles of the cubes that begin in a block.
/// @param edges  gives the vertices of a block by its number
template <typename Edges>
void add_block_triangles(const BlockCorners& corners, const Edges& edges, const CubeCases& cases,
                         TriangleMesh& mesh) {
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
                edges(corners.block_at(ex, ey, ez)).vertex(3 * BlockCorners::voxel(ex, ey, ez) + edge.axis);
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

SurfaceExtraction::SurfaceExtraction(int min_weight) : min_weight_(std::max(1, min_weight)) {}

void SurfaceExtraction::add(const DistanceField& field, BlockRange blocks) {
  // A cube at the end of a block has vertices on edges of the next layer's blocks, so triangles come a layer
  // later.
  for (std::size_t first = blocks.first; first < blocks.last;) {
    const BlockRange layer{first, field.blocks().end_of_layer(first)};
    add_vertices(field, layer);
    add_triangles(field, last_layer_);
    surfaces_.erase(surfaces_.begin(), surfaces_.begin() + static_cast<std::ptrdiff_t>(last_layer_.size()));
    last_layer_ = layer;
    first = layer.last;
  }
  if (blocks.last == field.blocks().size()) {
    add_triangles(field, last_layer_);
  } else if (blocks.last > 0) {
    expect(static_cast<double>(field.blocks().size()) / static_cast<double>(blocks.last));
  }
}

/// Takes memory for all that is to come, which is none until it is used: vectors that double when they are
/// full have three times their size just when there is most in them.
void SurfaceExtraction::expect(double growth) {
  constexpr double kMargin = 1.15;
  const auto make_room = [&](auto& elements) {
    const double expected = growth * static_cast<double>(elements.size());
    if (expected > static_cast<double>(elements.capacity()))
      elements.reserve(static_cast<std::size_t>(kMargin * expected));
  };
  make_room(mesh_.positions);
  make_room(mesh_.triangles);
}

void SurfaceExtraction::add_vertices(const DistanceField& field, BlockRange layer) {
  BlockCorners corners(field, min_weight_);
  for (std::size_t block = layer.first; block < layer.last; ++block) {
    corners.set_block(block);
    BlockSurface& surface = surfaces_.emplace_back();
    surface.may_be_there = corners.may_hold_surface();
    if (!surface.may_be_there) continue;
    add_block_vertices(corners, field.origin(field.blocks().keys()[block]), field.voxel(), surface.edges,
                       mesh_);
  }
}

void SurfaceExtraction::add_triangles(const DistanceField& field, BlockRange layer) {
  BlockCorners corners(field, min_weight_);
  const auto edges = [&](std::size_t block) -> const EdgeVertices& {
    return surfaces_[block - layer.first].edges;
  };
  for (std::size_t block = layer.first; block < layer.last; ++block) {
    if (!surfaces_[block - layer.first].may_be_there) continue;
    corners.set_block(block);
    add_block_triangles(corners, edges, cases_, mesh_);
  }
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
