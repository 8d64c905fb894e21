#include "input/layouts/video_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "core/error.hpp"
#include "core/lower_case.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

bool are_frame_numbers(const std::vector<NamedImage>& images) {
  return meaning_of(images) == NameMeaning::frames &&
         std::all_of(images.begin(), images.end(), [](const NamedImage& i) { return i.number.has_value(); });
}

/// The frame that each depth image belongs to; -1: none.
std::vector<int> frames_of_depth(const fs::path& video, const VideoIndex& index,
                                 const std::vector<NamedImage>& depth) {
  std::vector<int> frames(depth.size(), -1);
  if (are_frame_numbers(depth)) {
    const double first = *depth.front().number == 1 ? 1 : 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      const double frame = *depth[i].number - first;
      if (frame >= 0 && frame < index.frames) frames[i] = static_cast<int>(frame);
    }
    return frames;
  }
  if (depth.size() == static_cast<std::size_t>(index.frames)) {
    for (std::size_t i = 0; i < depth.size(); ++i) frames[i] = static_cast<int>(i);
    return frames;
  }
  throw Error(video.string(),
              fmt::format("holds {} frames, but there are {} depth images without frame numbers",
                          index.frames, depth.size()),
              "name the depth images by the numbers of the frames, counted from 0");
}

double time_of_frame(int frame, const VideoIndex& index, std::optional<double> rate) {
  constexpr double kUsualRate = 30;
  if (!rate && !index.times.empty()) return index.times[static_cast<std::size_t>(frame)];
  return frame / rate.value_or(kUsualRate);
}

}  // namespace

bool is_video(const fs::path& path) {
  constexpr std::array kEndings{".mp4", ".m4v", ".mkv", ".mov", ".avi", ".webm"};
  const std::string ending = lower_case(path.extension().string());
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end() && is_file(path);
}

std::vector<fs::path> videos_in(const fs::path& folder) {
  std::vector<fs::path> videos;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (!entry->path().filename().string().starts_with('.') && is_video(entry->path())) {
      videos.push_back(entry->path());
    }
  }
  std::sort(videos.begin(), videos.end());
  return videos;
}

ImageFile video_frame_file(const fs::path& video, int number) {
  return {video.parent_path() / video.stem() / fmt::format("{:06d}", number),
          fmt::format("{} (frame {})", video.string(), number)};
}

void pair_video(const fs::path& video, const VideoIndex& index, const std::vector<NamedImage>& depth,
                std::optional<double> rate, FolderContents& contents) {
  if (depth.empty()) throw Error(contents.where, "holds no depth images", "put them into depth/");
  const std::vector<int> frames = frames_of_depth(video, index, depth);
  int last = -1;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (frames[i] < 0) continue;
    if (frames[i] <= last) {
      throw Error(depth[i].path.string(),
                  fmt::format("has the same number as {}", depth[i - 1].path.filename().string()),
                  "keep one of the two");
    }
    last = frames[i];
    const double time = time_of_frame(last, index, rate);
    contents.frames.push_back(
        {time, time, video_frame_file(video, last), {depth[i].path, depth[i].path.string()}, {}, last});
  }
  if (contents.frames.empty()) {
    throw Error(contents.where, "no depth image belongs to a frame of the video",
                "name the depth images by the numbers of the frames, counted from 0");
  }
  contents.video = VideoFile{video, index.size};
  contents.colour_without_depth = index.frames - static_cast<int>(contents.frames.size());
  if (depth.size() != static_cast<std::size_t>(index.frames)) {
    contents.notes.push_back(fmt::format("{}: holds {} frames, but there are {} depth images: {} have both",
                                         video.string(), index.frames, depth.size(), contents.frames.size()));
  }
  if (!rate && index.times.empty()) {
    contents.notes.push_back(
        fmt::format("{}: has no times: frame n is taken to be at n / 30 s (--rate)", video.string()));
  }
}

}  // namespace stdc
