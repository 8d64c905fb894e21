#include "input/video/ffmpeg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

#include "core/error.hpp"

namespace stdc {

std::unique_ptr<ChildProcess> start_ffmpeg(const std::filesystem::path& video,
                                           const std::vector<std::string>& output) {
  std::vector<std::string> words{"ffmpeg", "-nostdin", "-loglevel", "error"};
  words.insert(words.end(), {"-protocol_whitelist", "file", "-format_whitelist", "mov,matroska,avi"});
  words.insert(words.end(), {"-threads", "1", "-max_pixels", std::to_string(kMaxVideoPixels)});
  words.insert(words.end(), {"-noautorotate", "-i", "file:" + video.string(), "-map", "0:V:0"});
  words.insert(words.end(), output.begin(), output.end());
  try {
    return std::make_unique<ChildProcess>(words);
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::no_such_file_or_directory) {
      throw Error(video.string(),
                  "is a video, and the program ffmpeg, which decodes videos, is not installed",
                  "apt install ffmpeg");
    }
    throw Error(video.string(), fmt::format("ffmpeg cannot be started ({})", error.code().message()),
                "check that the program ffmpeg runs");
  }
}

std::string first_complaint(std::string_view complaints, const std::filesystem::path& video) {
  constexpr std::size_t kMaxLength = 120;
  std::string_view line = complaints.substr(0, complaints.find('\n'));
  // "[h264 @ 0x5581f0] Invalid NAL unit size": who says so differs from run to run.
  while (line.starts_with('[')) {
    const std::size_t end = line.find("] ");
    if (end == std::string_view::npos) break;
    line.remove_prefix(end + 2);
  }
  const std::string name = "file:" + video.string() + ": ";
  if (line.starts_with(name)) line.remove_prefix(name.size());
  std::string text(line.substr(0, kMaxLength));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace stdc
