#pragma once

#include <deque>
#include <optional>
#include <string>

#include "core/camera.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

/// What does not change during a run.
struct ViewSubject {
  std::string name = {};  ///< of the input
  Camera camera;
  std::optional<int> expected_frames = {};
  bool can_pause = true;  ///< a live camera does not wait
  bool has_network = false, has_motion = false, has_dense = false;
  std::string version = {};  ///< of the program
};

/// Something that happened at a frame, in words.
struct ViewEvent {
  int frame = 0;
  std::string text;
};

/// What the page says in words, as far as it changes.
struct ViewState {
  bool paused = false, finished = false, has_truth = false;
  int maps = 0, keyframes = 0, landmarks = 0, loops = 0;
  std::optional<double> ate;  ///< [m] RMSE so far, after alignment
  std::size_t mesh_triangles = 0;
  double mesh_voxel = 0;         ///< [m]
  std::deque<ViewEvent> events;  ///< the latest
};

/// As JSON.
std::string encode_state(const ViewSubject& subject, const ViewState& state);

/// Notes what happened at frames: loops, losses, new maps.
class ViewEvents {
 public:
  void add(const TrackingResult& result);
  void add(const LoopReport& loop);
  const std::deque<ViewEvent>& latest() const { return events_; }
  int loops() const { return loops_; }

 private:
  void note(int frame, std::string text);
  std::deque<ViewEvent> events_;
  std::optional<TrackingStatus> last_;
  std::optional<MapId> map_;
  int lost_since_ = 0, loops_ = 0;
};

}  // namespace stdc
