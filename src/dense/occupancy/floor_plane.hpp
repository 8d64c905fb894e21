#pragma once

#include <optional>

#include "dense/fusion/placed_view.hpp"
#include "dense/mesh/triangle_mesh.hpp"

namespace stdc {

/// Where the floor is.
struct FloorPlane {
  Pose level_from_world;  ///< z up, the floor at z = 0, x as the first camera looks, origin below that camera
  double area = 0;        ///< of the surface that lies in it [m^2]
};

/// Finds the floor: the lowest of the large surfaces that face upwards and lie below the cameras. Upwards is
/// the direction nearest to the cameras' own upwards, or sidewards if they are mounted so, that most surface
/// faces.
/// @param up  in the world, if it is known: then only the height is looked for
/// Nothing if no surface is large enough to be a floor.
std::optional<FloorPlane> find_floor(const TriangleMesh& mesh, const std::vector<PlacedView>& views,
                                     const std::optional<Eigen::Vector3d>& up = std::nullopt);

}  // namespace stdc
