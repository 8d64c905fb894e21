#include "simulation/sequence/preset.hpp"

#include <string>

#include "core/error.hpp"

namespace stdc::simulation {

Preset preset_named(std::string_view name) {
  std::string all;
  for (const auto& [preset, word] : EnumNames<Preset>::values) {
    if (name == word) return preset;
    all += (all.empty() ? "" : ", ") + std::string(word);
  }
  throw Error("preset", "there is no preset \"" + std::string(name) + "\"", "choose one of " + all);
}

MotionKind motion_of(Preset preset) {
  switch (preset) {
    case Preset::static_desk:
      return MotionKind::desk;
    case Preset::static_room:
      return MotionKind::room_loop;
    case Preset::walking_xyz:
      return MotionKind::xyz;
    case Preset::walking_halfsphere:
      return MotionKind::halfsphere;
    case Preset::walking_rpy:
      return MotionKind::rpy;
    case Preset::walking_static:
      return MotionKind::held;
    case Preset::balloon_tracking:
      return MotionKind::follow;
    case Preset::camera_blocked:
      return MotionKind::xyz;
    default:
      return MotionKind::watch;
  }
}

double seconds_of(Preset preset) {
  switch (preset) {
    case Preset::static_room:
      return CameraPath::kLoopSeconds;
    case Preset::walking_xyz:
    case Preset::walking_halfsphere:
    case Preset::walking_rpy:
    case Preset::walking_static:
    case Preset::moving_box:
      return 30;
    default:
      return 20;
  }
}

bool has_visitor_chair(Preset preset) { return preset <= Preset::walking_static; }

}  // namespace stdc::simulation
