#include "viewer/view_state.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

namespace stdc {

std::string encode_state(const ViewSubject& subject, const ViewState& state) {
  nlohmann::json events = nlohmann::json::array();
  for (const ViewEvent& event : state.events)
    events.push_back({{"frame", event.frame}, {"text", event.text}});
  const Camera& camera = subject.camera;
  nlohmann::json json = {
      {"name", subject.name},
      {"version", subject.version},
      {"camera",
       {{"width", camera.width},
        {"height", camera.height},
        {"fx", camera.fx},
        {"fy", camera.fy},
        {"cx", camera.cx},
        {"cy", camera.cy},
        {"fps", camera.frames_per_second}}},
      {"can_pause", subject.can_pause},
      {"network", subject.has_network},
      {"motion", subject.has_motion},
      {"dense", subject.has_dense},
      {"truth", state.has_truth},
      {"paused", state.paused},
      {"finished", state.finished},
      {"maps", state.maps},
      {"keyframes", state.keyframes},
      {"landmarks", state.landmarks},
      {"loops", state.loops},
      {"mesh_triangles", state.mesh_triangles},
      {"mesh_voxel", state.mesh_voxel},
      {"events", std::move(events)},
  };
  json["expected_frames"] = subject.expected_frames ? nlohmann::json(*subject.expected_frames) : nullptr;
  json["ate"] = state.ate ? nlohmann::json(*state.ate) : nullptr;
  // A name of a file need not be UTF-8.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void ViewEvents::note(int frame, std::string text) {
  constexpr std::size_t kMax = 100;
  events_.push_back({frame, std::move(text)});
  if (events_.size() > kMax) events_.pop_front();
}

void ViewEvents::add(const LoopReport& loop) {
  ++loops_;
  if (loop.merged) {
    note(loop.frame, fmt::format("two maps joined: the place of frame {} again", loop.matched_frame));
  } else {
    note(loop.frame, fmt::format("loop closed with frame {}: {:.1f} cm of drift over {} keyframes",
                                 loop.matched_frame, 100 * loop.drift, loop.keyframes));
  }
}

void ViewEvents::add(const TrackingResult& result) {
  if (result.loop) add(*result.loop);
  if (result.status == TrackingStatus::skipped) {
    note(result.frame, "frame skipped: it could not be read, or its time is not later than the last");
    return;
  }
  const bool lost = result.status == TrackingStatus::lost;
  const bool was_lost = last_ == TrackingStatus::lost;
  if (lost && !was_lost) {
    lost_since_ = result.frame;
    note(result.frame, "tracking lost: looking for a known place");
  }
  const bool other_map = map_ && has_pose(result.status) && result.map != *map_;
  if (was_lost && has_pose(result.status)) {
    note(result.frame, fmt::format("{} after {} frames", other_map ? "another map started" : "found again",
                                   result.frame - lost_since_));
  } else if (!map_ && has_pose(result.status)) {
    note(result.frame, "the first map is begun");
  }
  const bool uncertain = result.status == TrackingStatus::uncertain;
  if (uncertain && last_ != TrackingStatus::uncertain) {
    note(result.frame, "uncertain: too little of the room agrees with the pose");
  }
  if (has_pose(result.status)) map_ = result.map;
  last_ = result.status;
}

}  // namespace stdc
