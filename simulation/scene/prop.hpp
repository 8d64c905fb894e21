#pragma once

#include <vector>

#include "core/pose.hpp"
#include "simulation/scene/mesh.hpp"

namespace stdc {

/// A rigid thing that is moved about: a box, a chair.
class Prop {
 public:
  /// A stretch of time in which the thing goes the way `world_from_prop` gives; between stretches it rests.
  struct Move {
    double begin = 0, end = 0;          ///< [s]
    std::vector<Pose> world_from_prop;  ///< evenly spaced from begin to end
  };

  /// @param mesh   in the thing's own frame; its materials are those of the room
  /// @param start  where it is before the first move
  /// @param moves  in order of time
  Prop(Mesh mesh, const Pose& start, std::vector<Move> moves, double radius)
      : mesh_(std::move(mesh)), start_(start), moves_(std::move(moves)), radius_(radius) {}

  const Mesh& mesh() const { return mesh_; }
  Pose world_from_prop(double time) const;
  bool moving(double time) const;
  /// Of a ball about its middle [m]; for soft shadows.
  double radius() const { return radius_; }

 private:
  Mesh mesh_;
  Pose start_;
  std::vector<Move> moves_;
  double radius_;
};

}  // namespace stdc
