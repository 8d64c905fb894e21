#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/recordings/recording_survey.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// The topics of a recording that make an RGB-D sequence: indices into Recording::topics().
struct TopicChoice {
  int colour = 0, depth = 0;
  std::optional<int> colour_info, depth_info, imu, truth;
  bool depth_is_registered = false;  ///< by the topic's name
};

/// Chooses topics: those that the options name, else the one sensible choice. Of a picture that was recorded
/// both raw and compressed the raw one; colour before grey; depth that the driver registered to colour before
/// other depth; depth and CameraInfo of the colour image's own camera. Throws Error, naming the topics that
/// there are and the option, if a named topic is not there or of the wrong kind, if there is no colour or
/// depth, or if several are as sensible.
TopicChoice choose_topics(const Recording& recording, const RecordingSurvey& survey,
                          const SourceOptions& options);

/// "/camera/color" of "/camera/color/image_raw/compressed", "/device_0/sensor_1/Color_0" of RealSense's
/// ".../Color_0/image/data".
std::string camera_of_topic(const std::string& topic);
/// Whether a topic's name says that its images have been undistorted.
bool is_rectified(const std::string& topic);

}  // namespace stdc
