#pragma once

#include <map>
#include <vector>

#include "input/recordings/messages/message_image.hpp"
#include "input/recordings/recording.hpp"
#include "input/recordings/transform_tree.hpp"

namespace stdc {

/// What the first image of a topic tells of it.
struct ImageSample {
  int topic = 0;
  std::string name, encoding;  ///< of the topic; of the image, or the format of a compressed one
  bool compressed = false;
  PixelMeaning meaning = PixelMeaning::unknown;
  cv::Size size;  ///< empty if it cannot be told
  std::string frame;
  std::int64_t stamp = 0;            ///< of the first image [ns]
  LogTime log_time = 0;              ///< of the first image
  std::vector<std::int64_t> stamps;  ///< of the first few images
};

/// What a recording holds, as far as its beginning tells.
struct RecordingSurvey {
  std::vector<ImageSample> images;                 ///< topics with at least one image, in the order of names
  std::map<int, std::vector<std::uint8_t>> infos;  ///< first CameraInfo message by topic
  std::map<std::string, double> depth_units;       ///< RealSense: by sensor, "/device_0/sensor_0" [m]
  std::map<std::string, Pose> stream_from_device;  ///< RealSense: by stream, "/device_0/sensor_0/Depth_0"

  const ImageSample* find(std::string_view name) const;
};

/// Reads the beginning, until each image topic has shown some images and what describes cameras has been
/// seen; camera info wherever it is. Starts the recording anew.
RecordingSurvey survey(Recording& recording);

/// Reads the transforms of the first seconds: tf_static, and tf where that says nothing. Not part of the
/// survey: it takes longer, and most recordings can do without. Starts the recording anew.
TransformTree read_transforms(Recording& recording);

}  // namespace stdc
