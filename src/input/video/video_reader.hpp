#pragma once

#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "input/video/child_process.hpp"

namespace stdc {

/// A video and the size of its images, as stored (VideoIndex).
struct VideoFile {
  std::filesystem::path path;
  cv::Size size;
};

/// Decodes the frames of a video in order, by ffmpeg: each once, not turned, the same bytes each time. One
/// frame at a time is in memory here, a few in ffmpeg, which waits when they are not fetched.
class VideoReader {
 public:
  explicit VideoReader(VideoFile video);

  /// Frame `number`, counted from 0: CV_8UC3, red, green, blue. Passes over the frames before it, and starts
  /// again for one that is already past. Nothing if the video ends before it or is damaged there. Throws
  /// Error if there is no ffmpeg.
  std::optional<cv::Mat> frame(int number);

  /// Why there are no more frames: "Invalid NAL unit size"; "" if the video ended as it should, or has not
  /// yet.
  const std::string& problem() const { return problem_; }

 private:
  void start();
  bool start_another_way();
  bool read_into(cv::Mat& image);
  void end(bool whole);

  VideoFile video_;
  std::string header_;  ///< of each image
  std::unique_ptr<ChildProcess> ffmpeg_;
  int at_ = 0;  ///< the number of the next frame
  bool ended_ = false;
  std::string problem_;
  bool is_new_ffmpeg_ = false;  ///< one that has forgotten the old name of an option
};

}  // namespace stdc
