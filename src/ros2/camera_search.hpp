#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "input/recordings/recording_cameras.hpp"
#include "ros2/collected_messages.hpp"

namespace stdc::ros2 {

/// What the messages of a camera are.
enum class CameraStream { colour, depth, colour_info, depth_info, transforms };

using FoundCameras = RecordingCameras;

/// Finds the cameras by the first messages, by the same rules as in a recording: CameraInfo, and tf_static
/// for depth that is not registered.
class CameraSearch {
 public:
  using Clock = std::chrono::steady_clock;

  /// Names of the topics, and whether images are compressed, by stream.
  struct Topic {
    std::string name, type;
  };
  explicit CameraSearch(const std::vector<Topic>& topics_by_stream);

  void add(CameraStream stream, Bytes data, Clock::time_point now);
  /// The cameras, if what came suffices: both images, some stamps for the rate, camera info, and what
  /// registers depth if that may be needed, unless it does not come for seconds.
  /// @param camera_is_known  camera info is not needed; the result has no cameras then
  /// Throws Error as find_cameras() does.
  std::optional<FoundCameras> find(Clock::time_point now, bool camera_is_known);
  /// What is missing, in words: names of topics; empty if nothing is.
  std::string missing(bool camera_is_known) const;

 private:
  int count(CameraStream stream) const { return messages_.count(static_cast<int>(stream)); }
  bool registration_is_settled(const RecordingSurvey& survey, const TopicChoice& choice);

  CollectedMessages messages_;
  std::optional<Clock::time_point> first_pair_;  ///< since when there are both images
};

}  // namespace stdc::ros2
