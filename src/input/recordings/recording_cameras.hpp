#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/recordings/topic_choice.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc {

/// The cameras of the chosen topics.
struct RecordingCameras {
  std::optional<RgbdCameras> cameras;  ///< nothing: not known
  std::string hint;                    ///< what the user can do then
  std::vector<std::string> notes;      ///< what was taken for granted
};

/// By CameraInfo, and for depth that is not registered to colour by tf_static or RealSense's extrinsics.
/// What CameraInfo has no place for comes from kCameraFileTopic, if that is of the same camera.
/// Depth of 16 bits is in millimetres (REP 118) unless a RealSense recording says otherwise. Throws Error for
/// a CameraInfo that makes no sense. Starts the recording anew.
RecordingCameras find_cameras(Recording& recording, const RecordingSurvey& survey, const TopicChoice& choice);

/// Median rate of the stamps of a topic's first images [Hz]; nothing if there are fewer than two.
std::optional<double> rate_of(const ImageSample& sample);

}  // namespace stdc
