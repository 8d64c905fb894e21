#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/setting.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/sequence/dynamic_scene.hpp"

namespace stdc::simulation {

/// What is pasted into a recording.
enum class PastedMover { board, box, person };

/// A recorded camera path: one pose per frame. The world's z axis is up and its floor at z = 0.
struct RecordedPath {
  std::vector<double> times;  ///< [s], increasing
  std::vector<Pose> world_from_cam;
};

struct PassageSettings {
  PastedMover mover = PastedMover::board;
  double share = 0.6;   ///< of the view that the board covers, mean over `frames`
  int frames = 140;     ///< that the board covers so much, or that the box takes through the view
  int start = -1;       ///< frame in which the passage begins; < 0: so that it is in the middle
  double distance = 1;  ///< of the mover from the camera [m]
  std::uint64_t seed = 1;
};

/// A mover that passes through the view of a recorded camera, once. It moves in the world: it is led by the
/// path of the camera only on average (over about a second for board and box, over the passage for the
/// person), not by the camera itself.
class Passage {
 public:
  /// `room` gives materials and light; it and `light` must outlive this. `camera` is for the share of the
  /// view. Throws Error if the recording is too short for it.
  Passage(const PassageSettings& settings, const RecordedPath& path, const Camera& camera, const Room& room,
          const BakedLight& light);

  /// Frames in which the mover may be seen: [first, last).
  int first() const { return first_; }
  int last() const { return last_; }
  /// Pose of a frame's camera in the frame in which `mover` is: that of the room, so that the light fits.
  const Pose& room_from_cam(int frame) const { return room_from_cam_[frame]; }
  /// The mover at a frame from first() to last() - 1. Refers to this object. Thread-safe.
  std::unique_ptr<MovingObjects> mover(int frame) const;

 private:
  std::vector<Pose> room_from_cam_;
  std::vector<double> times_;  ///< [s] since the first frame of the passage
  int first_ = 0, last_ = 0;
  std::unique_ptr<DynamicScene> scene_;
};

}  // namespace stdc::simulation

template <>
struct stdc::EnumNames<stdc::simulation::PastedMover> {
  using PastedMover = stdc::simulation::PastedMover;
  static constexpr std::array values{
      std::pair{PastedMover::board, "board"},
      std::pair{PastedMover::box, "box"},
      std::pair{PastedMover::person, "person"},
  };
};
