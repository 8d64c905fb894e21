#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/types.hpp>
#include <string_view>
#include <vector>

namespace stdc {

/// What a video holds, as far as it shows without decoding it.
struct VideoIndex {
  cv::Size size;  ///< as stored: not turned by what the file says about rotation
  int frames = 0;
  std::vector<double>
      times;  ///< when each frame is shown [s], strictly increasing; empty if the file does not say
};

/// Takes ffmpeg's list of packets ("framecrc") line by line.
class VideoIndexReader {
 public:
  void add(std::string_view line);
  /// Throws Error with `where` for a size that no camera's images have and for too many frames.
  VideoIndex result(const std::string& where) const;

 private:
  void add_packet(std::string_view line);

  std::int64_t width_ = 0, height_ = 0, frames_ = 0;
  double unit_ = 0;                  ///< of the times [s]
  std::vector<std::int64_t> shown_;  ///< in the order of the file
};

/// Reads through a video by ffmpeg, without decoding it. Throws Error naming it if it is no video, damaged
/// from the start on, or of a size that no camera's images have, and if there is no ffmpeg.
VideoIndex read_video_index(const std::filesystem::path& video);

}  // namespace stdc
