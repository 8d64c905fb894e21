#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/orientation.hpp"
#include "run/sequence_input.hpp"

namespace stdc::app {

/// An image as it is stored.
struct StoredImage {
  cv::Mat colour;                                  ///< CV_8UC3 or CV_8UC1
  Orientation orientation = Orientation::upright;  ///< as its EXIF data say
};

/// An image to be segmented.
struct SegmentImage {
  std::string where;                  ///< for messages
  std::string name;                   ///< of the file, without extension; results are named after it
  std::optional<double> timestamp;    ///< [s], of a sequence
  std::function<StoredImage()> load;  ///< throws Error naming the file
};

/// The images of an input, one after the other: one file; the colour images of an RGB-D recording of any
/// kind; or else all PNG and JPEG files of a folder by name.
class SegmentImages {
 public:
  /// Throws Error if there are none. `input.camera` is not looked at.
  explicit SegmentImages(const InputOptions& input);

  /// The next one of the chosen range; nothing at the end.
  std::optional<SegmentImage> next();
  /// How many are chosen, if that is known.
  std::optional<int> count() const;
  /// Whether they are of a sequence: then they have times, and the camera says which way up they are.
  bool is_sequence() const { return source_ != nullptr; }
  /// The camera of a sequence, if it is known.
  std::optional<Camera> camera() const;

 private:
  std::vector<SegmentImage> files_;
  std::unique_ptr<FrameSource> source_;
  FrameRange range_;
  int at_ = 0;
};

/// Reads an image of any size. Throws Error naming the file.
StoredImage load_segment_image(const std::filesystem::path& path);

}  // namespace stdc::app
