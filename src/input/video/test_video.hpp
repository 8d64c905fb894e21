#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "input/video/child_process.hpp"

namespace stdc::test {

/// Whether there is an ffmpeg to write and read videos with.
inline bool has_ffmpeg() {
  try {
    ChildProcess ffmpeg({"ffmpeg", "-version"});
    std::vector<std::uint8_t> text(100000);
    ffmpeg.read(text);
    return ffmpeg.finish() == 0;
  } catch (const std::system_error&) {
    return false;
  }
}

constexpr const char* kNeedsFfmpeg = "needs ffmpeg: scripts/packages-optional.txt";

/// Ways to write a video: without loss, and as phones do.
inline const std::vector<std::string> kLossless{"-c:v", "ffv1", "-pix_fmt", "bgr0"};
inline const std::vector<std::string> kLikePhones{"-c:v", "libx264", "-pix_fmt",  "yuv420p",
                                                  "-crf", "18",      "-movflags", "+faststart"};

/// Writes a video of BGR images of one size at 30 Hz, by ffmpeg.
inline void write_video(const std::filesystem::path& path, const std::vector<cv::Mat>& images,
                        const std::vector<std::string>& codec) {
  const std::string raw = path.string() + ".raw";
  std::ofstream file(raw, std::ios::binary);
  for (const cv::Mat& image : images) {
    file.write(reinterpret_cast<const char*>(image.data),
               static_cast<std::streamsize>(image.total() * image.elemSize()));
  }
  file.close();
  std::vector<std::string> words{"ffmpeg",    "-nostdin",
                                 "-loglevel", "error",
                                 "-f",        "rawvideo",
                                 "-pix_fmt",  "bgr24",
                                 "-s",        fmt::format("{}x{}", images.front().cols, images.front().rows),
                                 "-r",        "30",
                                 "-i",        "file:" + raw};
  words.insert(words.end(), codec.begin(), codec.end());
  words.push_back("file:" + path.string());
  ChildProcess ffmpeg(words);
  std::vector<std::uint8_t> output(1000);
  ffmpeg.read(output);
  const auto status = ffmpeg.finish();
  std::filesystem::remove(raw);
  if (status != 0) throw std::runtime_error("ffmpeg: " + ffmpeg.complaints());
}

/// Frame `i` of a made-up video: a pattern that moves, of all colours.
inline cv::Mat video_frame(int i, cv::Size size = {320, 256}) {
  cv::Mat image(size, CV_8UC3);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int there = x + 5 * i;
      image.at<cv::Vec3b>(y, x) = cv::Vec3b(
          cv::saturate_cast<std::uint8_t>(there % 251), cv::saturate_cast<std::uint8_t>((2 * y + i) % 241),
          cv::saturate_cast<std::uint8_t>((there / 16 + y / 16) % 2 == 0 ? 220 : 40));
    }
  }
  return image;
}

inline std::vector<cv::Mat> video_frames(int count, cv::Size size = {320, 256}) {
  std::vector<cv::Mat> frames;
  frames.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) frames.push_back(video_frame(i, size));
  return frames;
}

/// The first part of a file.
inline void cut_file(const std::filesystem::path& path, double share) {
  std::filesystem::resize_file(
      path, static_cast<std::uintmax_t>(share * static_cast<double>(std::filesystem::file_size(path))));
}

}  // namespace stdc::test
