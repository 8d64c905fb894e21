#pragma once

#include <memory>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/recordings/recording.hpp"

namespace stdc {

/// An image topic of a recording.
struct ImageTopic {
  std::string file, name;  ///< for messages
  Serialisation serialisation = Serialisation::ros1;
  bool compressed = false;  ///< sensor_msgs/CompressedImage, else sensor_msgs/Image
};

/// A message with an image, still packed.
struct PackedMessage {
  std::shared_ptr<const ImageTopic> topic;
  std::shared_ptr<const std::vector<std::uint8_t>> data;
  std::int64_t stamp = 0;  ///< [ns]

  /// "run.bag (/camera/color/image_raw at 1700000000.033333)".
  std::string where() const;
};

std::shared_ptr<const PackedImages> pack_images(PackedMessage colour, PackedMessage depth);

}  // namespace stdc
