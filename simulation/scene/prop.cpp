#include "simulation/scene/prop.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {

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

}  // namespace stdc::simulation
