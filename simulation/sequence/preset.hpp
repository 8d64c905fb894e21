#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/setting.hpp"
#include "simulation/sequence/camera_path.hpp"

namespace stdc::simulation {

/// The sequences that can be rendered. The `walking` ones follow the camera motions of the TUM RGB-D
/// benchmark (Sturm et al. 2012) with two people who walk, turn, stop and sit between the camera and the
/// desks. Those after `moving_box` take up themes of the BONN RGB-D Dynamic data set (Palazzolo et al.,
/// "ReFusion", IROS 2019); docs/simulation.md says what differs.
enum class Preset {
  static_desk,
  static_room,  ///< a loop through the room that ends where it began
  walking_xyz,
  walking_halfsphere,
  walking_rpy,
  walking_static,
  moving_box,        ///< a person carries a box, puts it down and pushes a chair
  board,             ///< a board with prints slides before the camera; nobody
  balloon,           ///< a person keeps a balloon in the air
  balloon_tracking,  ///< the same, and the camera looks at the balloon
  box_kidnapped,     ///< a box in view is carried off across the view
  box_placed,        ///< a person brings a box, puts it down and leaves
  box_removed,       ///< a person takes a box away
  crowd,             ///< four people walk
  synchronous,       ///< two people walk side by side in step
  door,              ///< the door of a cupboard opens and closes
  trolley,           ///< a trolley rolls through the room
  camera_blocked,    ///< a board covers the lens for 2 s, twice
};

}  // namespace stdc::simulation

template <>
struct stdc::EnumNames<stdc::simulation::Preset> {
  using Preset = stdc::simulation::Preset;
  static constexpr std::array values{
      std::pair{Preset::static_desk, "static-desk"},
      std::pair{Preset::static_room, "static-room"},
      std::pair{Preset::walking_xyz, "walking-xyz"},
      std::pair{Preset::walking_halfsphere, "walking-halfsphere"},
      std::pair{Preset::walking_rpy, "walking-rpy"},
      std::pair{Preset::walking_static, "walking-static"},
      std::pair{Preset::moving_box, "moving-box"},
      std::pair{Preset::board, "board"},
      std::pair{Preset::balloon, "balloon"},
      std::pair{Preset::balloon_tracking, "balloon-tracking"},
      std::pair{Preset::box_kidnapped, "box-kidnapped"},
      std::pair{Preset::box_placed, "box-placed"},
      std::pair{Preset::box_removed, "box-removed"},
      std::pair{Preset::crowd, "crowd"},
      std::pair{Preset::synchronous, "synchronous"},
      std::pair{Preset::door, "door"},
      std::pair{Preset::trolley, "trolley"},
      std::pair{Preset::camera_blocked, "camera-blocked"},
  };
};

namespace stdc::simulation {

/// Throws Error listing the presets if there is none of that name.
Preset preset_named(std::string_view name);

/// How the camera moves in a preset.
MotionKind motion_of(Preset preset);
/// Default length [s].
double seconds_of(Preset preset);
/// Whether the visitors' chair before the desks is part of the static room.
bool has_visitor_chair(Preset preset);

}  // namespace stdc::simulation
