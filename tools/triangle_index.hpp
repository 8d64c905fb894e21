#pragma once

#include <Eigen/Core>
#include <array>
#include <unordered_map>
#include <vector>

namespace stdc {

/// Answers how far a point is from the nearest of many triangles.
class TriangleIndex {
 public:
  using Triangle = std::array<Eigen::Vector3f, 3>;

  /// @param cell  side of the cells that triangles are sorted into [m]; about the distances of interest
  TriangleIndex(std::vector<Triangle> triangles, float cell);

  struct Nearest {
    float distance = 0;                                ///< [m]; the limit if nothing is nearer
    Eigen::Vector3f point = Eigen::Vector3f::Zero();   ///< on the nearest triangle
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< of that; zero if nothing is near
  };
  /// What is nearest to a point, up to a distance [m].
  Nearest find(const Eigen::Vector3f& point, float limit) const;
  float distance(const Eigen::Vector3f& point, float limit) const { return find(point, limit).distance; }

 private:
  using Key = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      return static_cast<std::size_t>(key[0] * 73856093) ^ static_cast<std::size_t>(key[1] * 19349663) ^
             static_cast<std::size_t>(key[2] * 83492791);
    }
  };
  Key key_of(const Eigen::Vector3f& point) const;

  std::vector<Triangle> triangles_;
  float cell_;
  std::unordered_map<Key, std::vector<std::uint32_t>, Hash> cells_;
};

}  // namespace stdc
