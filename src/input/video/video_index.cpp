#include "input/video/video_index.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "input/video/ffmpeg.hpp"

namespace stdc {
namespace {

constexpr std::int64_t kMaxFrames = 10'000'000;  // two days at 60 Hz

constexpr const char* kVideoHint = "restore the file or record it again";

/// The whole number at the start of a text, without the blanks before it; `rest` is what follows.
std::optional<std::int64_t> take_number(std::string_view text, std::string_view& rest) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  std::int64_t number = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (fault != std::errc()) return std::nullopt;
  rest = text.substr(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// "1/15360", "640x480".
std::optional<std::array<std::int64_t, 2>> take_two(std::string_view text, char between) {
  const auto first = take_number(text, text);
  if (!first || !text.starts_with(between)) return std::nullopt;
  const auto second = take_number(text.substr(1), text);
  if (!second || *first <= 0 || *second <= 0) return std::nullopt;
  return std::array{*first, *second};
}

}  // namespace

void VideoIndexReader::add(std::string_view line) {
  constexpr std::string_view kSize = "#dimensions 0:", kUnit = "#tb 0:";
  if (line.starts_with(kSize)) {
    const auto size = take_two(line.substr(kSize.size()), 'x');
    if (size) width_ = (*size)[0], height_ = (*size)[1];
  } else if (line.starts_with(kUnit)) {
    const auto unit = take_two(line.substr(kUnit.size()), '/');
    if (unit) unit_ = static_cast<double>((*unit)[0]) / static_cast<double>((*unit)[1]);
  } else if (!line.starts_with('#')) {
    add_packet(line);
  }
}

/// "0, <decoded at>, <shown at>, <for>, <bytes>, <checksum>"
void VideoIndexReader::add_packet(std::string_view line) {
  std::int64_t shown = 0;
  for (int column = 0; column < 3; ++column) {
    const auto number = take_number(line, line);
    if (!number || !line.starts_with(',')) return;
    line.remove_prefix(1);
    shown = *number;
  }
  if (frames_++ < kMaxFrames) shown_.push_back(shown);
}

VideoIndex VideoIndexReader::result(const std::string& where) const {
  constexpr std::int64_t kMaxSide = 16384;
  if (width_ > kMaxSide || height_ > kMaxSide || width_ * height_ > kMaxVideoPixels) {
    throw Error(where, fmt::format("says that its images are {} x {} pixels", width_, height_), kVideoHint);
  }
  if (frames_ > kMaxFrames) throw Error(where, fmt::format("holds {} frames", frames_), "cut it into parts");
  VideoIndex index;
  index.size = cv::Size(static_cast<int>(width_), static_cast<int>(height_));
  index.frames = static_cast<int>(frames_);
  std::vector<std::int64_t> shown = shown_;
  std::sort(shown.begin(), shown.end());  // frames that need later ones come after them in the file
  const bool known = unit_ > 0 && !shown.empty() &&
                     shown.front() != std::numeric_limits<std::int64_t>::min() &&
                     std::adjacent_find(shown.begin(), shown.end()) == shown.end();
  if (!known) return index;
  index.times.reserve(shown.size());
  for (const std::int64_t time : shown) index.times.push_back(static_cast<double>(time) * unit_);
  return index;
}

VideoIndex read_video_index(const std::filesystem::path& video) {
  const auto ffmpeg = start_ffmpeg(video, {"-c:v", "copy", "-f", "framecrc", "pipe:1"});
  VideoIndexReader reader;
  std::array<char, 1 << 16> text{};
  std::string line;  // what there is of one
  constexpr std::size_t kMaxLine = 1000;
  for (std::size_t got = text.size(); got == text.size();) {
    got = ffmpeg->read({reinterpret_cast<std::uint8_t*>(text.data()), text.size()});
    for (const char c : std::string_view(text.data(), got)) {
      if (c != '\n' && line.size() < kMaxLine) line += c;
      if (c != '\n') continue;
      reader.add(line);
      line.clear();
    }
  }
  ffmpeg->finish();
  VideoIndex index = reader.result(video.string());
  if (index.frames > 0 && !index.size.empty()) return index;
  const std::string complaint = first_complaint(ffmpeg->complaints(), video);
  throw Error(
      video.string(),
      fmt::format("holds no video that ffmpeg can read{}", complaint.empty() ? "" : " (" + complaint + ")"),
      kVideoHint);
}

}  // namespace stdc
