#include "input/video/video_reader.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "input/video/ffmpeg.hpp"

namespace stdc {

VideoReader::VideoReader(VideoFile video)
    : video_(std::move(video)),
      header_(fmt::format("P6\n{} {}\n255\n", video_.size.width, video_.size.height)) {}

void VideoReader::start() {
  // Each frame once, whatever its time. The option got its new name in ffmpeg 5.1.
  std::vector<std::string> output = is_new_ffmpeg_ ? std::vector<std::string>{"-fps_mode", "passthrough"}
                                                   : std::vector<std::string>{"-vsync", "0"};
  // A frame that is lost would give all later ones a wrong number: the first fault ends the video.
  output.emplace_back("-xerror");
  // Images with a header each: a stream of bare pixels would not show that the video changes its size.
  output.insert(output.end(), {"-sws_flags", "bilinear+bitexact+accurate_rnd+full_chroma_int", "-pix_fmt",
                               "rgb24", "-c:v", "ppm", "-threads", "1", "-f", "image2pipe", "pipe:1"});
  ffmpeg_ = start_ffmpeg(video_.path, output);
  at_ = 0;
  ended_ = false;
  problem_.clear();
}

bool VideoReader::start_another_way() {
  if (is_new_ffmpeg_ || at_ > 0 || problem_.find("vsync") == std::string::npos) return false;
  is_new_ffmpeg_ = true;
  start();
  return true;
}

std::optional<cv::Mat> VideoReader::frame(int number) {
  if (!ffmpeg_ || number < at_) start();
  cv::Mat image(video_.size, CV_8UC3);
  while (!ended_) {
    if (read_into(image)) {
      if (at_++ == number) return image;
    } else if (!start_another_way()) {
      break;
    }
  }
  return std::nullopt;
}

bool VideoReader::read_into(cv::Mat& image) {
  std::string header(header_.size(), '\0');
  const std::size_t got = ffmpeg_->read({reinterpret_cast<std::uint8_t*>(header.data()), header.size()});
  if (got == header.size() && header != header_) {
    end(true);
    problem_ = "its images change their size";
    return false;
  }
  const std::size_t bytes = image.total() * image.elemSize();
  if (got == header.size() && ffmpeg_->read({image.data, bytes}) == bytes) return true;
  end(got == 0);
  return false;
}

/// @param whole  whether the last image was
void VideoReader::end(bool whole) {
  ended_ = true;
  const std::optional<int> status = ffmpeg_->finish();
  if (whole && status == 0) return;
  problem_ = first_complaint(ffmpeg_->complaints(), video_.path);
  if (problem_.empty()) problem_ = "ffmpeg gave up";
}

}  // namespace stdc
