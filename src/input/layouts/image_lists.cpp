#include "input/layouts/image_lists.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files/image_list.hpp"
#include "core/files/text_file.hpp"
#include "input/association.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

std::vector<ImageListEntry> read_list(const fs::path& path) {
  return parse_image_list(read_file(path, "restore the list"), path.string());
}

std::vector<double> times_in_list(const std::vector<ImageListEntry>& list) {
  std::vector<double> times;
  times.reserve(list.size());
  for (const ImageListEntry& entry : list) times.push_back(entry.timestamp);
  return times;
}

ImageFile file_of(const fs::path& list, const ImageListEntry& entry) {
  const fs::path path = list.parent_path() / entry.file;
  return {path, fmt::format("{} ({}:{})", path.string(), list.filename().string(), entry.line)};
}

}  // namespace

void pair_lists(const fs::path& colour_list, const fs::path& depth_list, FolderContents& contents) {
  constexpr double kMaxDifference = 0.02;  // [s]
  const auto colour = read_list(colour_list), depth = read_list(depth_list);
  const auto pairs = associate_times(times_in_list(colour), times_in_list(depth), kMaxDifference);
  if (pairs.empty()) {
    throw Error(depth_list.string(),
                fmt::format("no depth image lies within {:.0f} ms of a colour image", 1e3 * kMaxDifference),
                "make both lists with the same clock");
  }
  for (const auto& [c, d] : pairs) {
    const ImageListEntry &c_entry = colour[static_cast<std::size_t>(c)],
                         &d_entry = depth[static_cast<std::size_t>(d)];
    contents.frames.push_back(
        {c_entry.timestamp, d_entry.timestamp, file_of(colour_list, c_entry), file_of(depth_list, d_entry)});
  }
  contents.colour_without_depth = static_cast<int>(colour.size() - pairs.size());
  contents.streams.push_back(
      {colour_list.filename().string(), "colour images", static_cast<int>(colour.size())});
  contents.streams.push_back(
      {depth_list.filename().string(), "depth images", static_cast<int>(depth.size())});
}

}  // namespace stdc
