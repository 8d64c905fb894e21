#include "simulation/scene/prop.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {
namespace {

constexpr double kStep = 0.02;  // between the poses of a move, at most [s]

}  // namespace

Pose Prop::world_from_prop(double time) const {
  Pose pose = start_;
  for (const Move& move : moves_) {
    if (time < move.begin) break;
    const auto last = static_cast<double>(move.world_from_prop.size() - 1);
    const double at = std::clamp((time - move.begin) / (move.end - move.begin), 0.0, 1.0) * last;
    const auto i = static_cast<std::size_t>(at);
    const Pose &a = move.world_from_prop[i],
               &b = move.world_from_prop[std::min(i + 1, move.world_from_prop.size() - 1)];
    const double f = at - static_cast<double>(i);
    pose = Pose(a.rotation.slerp(f, b.rotation), a.translation + f * (b.translation - a.translation));
  }
  return pose;
}

bool Prop::moving(double time) const {
  return std::any_of(moves_.begin(), moves_.end(),
                     [&](const Move& m) { return time > m.begin && time < m.end; });
}

Prop::Move sampled_move(double begin, double end, const std::function<Pose(double)>& world_from_prop) {
  Prop::Move move{begin, end, {}};
  const int steps = std::max(1, static_cast<int>(std::ceil((end - begin) / kStep)));
  for (int i = 0; i <= steps; ++i)
    move.world_from_prop.push_back(world_from_prop(begin + (end - begin) * i / steps));
  return move;
}

}  // namespace stdc::simulation
