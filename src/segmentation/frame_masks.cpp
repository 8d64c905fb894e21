#include "segmentation/frame_masks.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "segmentation/mask_file_segmenter.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

/// Masks by the position of their frame in the list.
using ByFrame = std::map<std::size_t, fs::path>;

/// How far off a time may be that is written like this [s].
double tolerance_of(const std::string& stem) {
  const std::size_t point = stem.find('.');
  if (point == std::string::npos) return MaskFileSegmenter::kTolerance;
  const auto decimals = static_cast<double>(stem.size() - point - 1);
  return std::clamp(std::pow(10.0, -decimals), MaskFileSegmenter::kTolerance, 0.01);
}

ByFrame by_name(const std::vector<fs::path>& files, const std::vector<MaskedFrame>& frames) {
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].name.empty()) places.emplace(frames[i].name, i);
  }
  ByFrame found;
  for (const fs::path& file : files) {
    if (const auto place = places.find(file.stem().string()); place != places.end())
      found.emplace(place->second, file);
  }
  return found;
}

/// Position of the frame nearest to a time, of a list that is not empty.
std::size_t nearest_frame(const std::vector<MaskedFrame>& frames, double time) {
  const auto after =
      std::lower_bound(frames.begin(), frames.end(), time,
                       [](const MaskedFrame& frame, double stamp) { return frame.timestamp < stamp; });
  const auto place = static_cast<std::size_t>(after - frames.begin());
  if (place == 0) return 0;
  if (after == frames.end()) return place - 1;
  return after->timestamp - time < time - (after - 1)->timestamp ? place : place - 1;
}

ByFrame by_time(const std::vector<fs::path>& files, const std::vector<MaskedFrame>& frames) {
  ByFrame found;
  std::map<std::size_t, double> distances;
  for (const fs::path& file : files) {
    const std::optional<double> time = time_of_mask(file);
    if (!time) continue;
    const std::size_t place = nearest_frame(frames, *time);
    const double distance = std::abs(frames[place].timestamp - *time);
    if (distance > tolerance_of(file.stem().string())) continue;
    const auto rival = distances.find(place);
    if (rival != distances.end() && rival->second <= distance) continue;
    distances[place] = distance;
    found[place] = file;
  }
  return found;
}

/// The number at the end of a name: 12 of "mask_0012".
std::optional<long> number_of(const std::string& stem) {
  constexpr std::size_t kMaxDigits = 9;
  std::size_t begin = stem.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(stem[begin - 1])) != 0) --begin;
  const bool are_decimals = begin > 0 && stem[begin - 1] == '.';
  if (begin == stem.size() || stem.size() - begin > kMaxDigits || are_decimals) return std::nullopt;
  return std::stol(stem.substr(begin));
}

ByFrame by_number(const std::vector<fs::path>& files, const std::vector<MaskedFrame>& frames, int first) {
  std::unordered_map<long, std::size_t> places;
  for (std::size_t i = 0; i < frames.size(); ++i) places.emplace(frames[i].number + first, i);
  ByFrame found;
  for (const fs::path& file : files) {
    const auto number = number_of(file.stem().string());
    if (!number) continue;
    if (const auto place = places.find(*number); place != places.end()) found.emplace(place->second, file);
  }
  return found;
}

/// Whether frames are counted from 1: no mask has number 0, and one has that of the frame after the last.
bool counts_from_one(const std::vector<fs::path>& files, const std::vector<MaskedFrame>& frames) {
  std::set<long> numbers;
  for (const fs::path& file : files) {
    if (const auto number = number_of(file.stem().string())) numbers.insert(*number);
  }
  return !numbers.empty() && *numbers.begin() > 0 && numbers.contains(frames.back().number + 1L);
}

std::vector<MaskFile> masks_of(const ByFrame& found, const std::vector<MaskedFrame>& frames) {
  std::vector<MaskFile> masks;
  for (const auto& [place, path] : found) masks.push_back({frames[place].timestamp, path, 0});
  return masks;
}

FrameMasks listed(const fs::path& folder, const std::vector<MaskedFrame>& frames) {
  const std::vector<MaskFile> all = list_masks(folder);
  FrameMasks result{{}, static_cast<int>(all.size()), "the times in mask.txt"};
  for (const MaskedFrame& frame : frames) {
    if (const MaskFile* mask = find_mask(all, frame.timestamp, MaskFileSegmenter::kTolerance)) {
      result.masks.push_back({frame.timestamp, mask->path, mask->line});
    }
  }
  return result;
}

}  // namespace

FrameMasks find_frame_masks(const fs::path& folder, const std::vector<MaskedFrame>& frames) {
  std::error_code ignored;
  if (fs::exists(folder / "mask.txt", ignored)) return listed(folder, frames);
  const std::vector<fs::path> files = mask_files(folder);
  FrameMasks result;
  result.files = static_cast<int>(files.size());
  if (files.empty() || frames.empty()) return result;
  const bool from_one = counts_from_one(files, frames);
  ByFrame names = by_name(files, frames);
  const ByFrame times = by_time(files, frames);
  const ByFrame numbers = by_number(files, frames, from_one ? 1 : 0);
  const bool has_names = !names.empty();
  for (const auto& [place, path] : times) names.emplace(place, path);
  // A whole number may be both seconds and a frame's: what fits more of them is meant.
  const bool use_numbers = !has_names && numbers.size() > names.size();
  result.masks = masks_of(use_numbers ? numbers : names, frames);
  result.found_by = use_numbers ? (from_one ? "number, counted from 1" : "number, counted from 0")
                    : has_names ? "the name of the colour image"
                                : "time";
  return result;
}

}  // namespace stdc
