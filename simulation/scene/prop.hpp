#pragma once

#include <functional>
#include <vector>

#include "core/pose.hpp"
#include "simulation/scene/mesh.hpp"

namespace stdc::simulation {

/// A rigid object that people move, or that moves by itself: a box, a chair, a balloon. Without moves it is
/// furniture of one preset.
class Prop {
 public:
  /// A motion over a span of time; the object rests between its moves.
  struct Move {
    double begin = 0, end = 0;          ///< [s]
    std::vector<Pose> world_from_prop;  ///< evenly spaced from begin to end
  };

  /// @param mesh   in the object's frame; its materials are those of the room
  /// @param start  pose before the first move
  /// @param moves  ordered by time
  Prop(Mesh mesh, const Pose& start, std::vector<Move> moves, double radius)
      : mesh_(std::move(mesh)), start_(start), moves_(std::move(moves)), radius_(radius) {}

  const Mesh& mesh() const { return mesh_; }
  Pose world_from_prop(double time) const;
  bool moving(double time) const;
  bool ever_moves() const { return !moves_.empty(); }
  /// Radius of the ball that stands for it in soft shadows [m].
  double radius() const { return radius_; }

 private:
  Mesh mesh_;
  Pose start_;
  std::vector<Move> moves_;
  double radius_;
};

/// A move that follows `world_from_prop`, a function of time [s], from `begin` to `end`.
Prop::Move sampled_move(double begin, double end, const std::function<Pose(double)>& world_from_prop);

}  // namespace stdc::simulation
