#include "segmentation/mask_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "core/error.hpp"
#include "core/image_list.hpp"
#include "core/text_file.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLayout =
    "name the masks as their colour images (<seconds>.png) or list them in mask.txt";

std::vector<MaskFile> listed_masks(const fs::path& folder, const fs::path& list) {
  std::vector<MaskFile> masks;
  for (const ImageListEntry& entry : parse_image_list(read_file(list, kLayout), list.string())) {
    masks.push_back({entry.timestamp, folder / entry.file, entry.line});
  }
  return masks;
}

std::vector<MaskFile> named_masks(const fs::path& folder) {
  std::error_code problem;
  std::vector<MaskFile> masks;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    const fs::path& path = entry->path();
    if (path.extension() != ".png") continue;
    const std::optional<double> time = parse_number(path.stem().string());
    if (time && std::isfinite(*time)) masks.push_back({*time, path, 0});
  }
  if (problem)
    throw Error(folder.string(), "cannot be read (" + problem.message() + ")",
                "check the path and its permissions");
  // The names decide between equal times, so that the message is the same on every file system.
  std::sort(masks.begin(), masks.end(), [](const MaskFile& a, const MaskFile& b) {
    return std::pair(a.timestamp, a.path) < std::pair(b.timestamp, b.path);
  });
  const auto twin = std::adjacent_find(masks.begin(), masks.end(), [](const MaskFile& a, const MaskFile& b) {
    return a.timestamp == b.timestamp;
  });
  if (twin != masks.end()) {
    throw Error(twin->path.string(),
                fmt::format("has the same time as {}", (twin + 1)->path.filename().string()),
                "keep one of the two");
  }
  return masks;
}

}  // namespace

std::vector<MaskFile> list_masks(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw Error(folder.string(), "is not a folder", "give the folder that holds the masks");
  }
  const fs::path list = folder / "mask.txt";
  std::vector<MaskFile> masks = fs::exists(list, ignored) ? listed_masks(folder, list) : named_masks(folder);
  if (masks.empty()) throw Error(folder.string(), "holds no masks", kLayout);
  return masks;
}

const MaskFile* find_mask(const std::vector<MaskFile>& masks, double timestamp, double tolerance) {
  const auto after =
      std::lower_bound(masks.begin(), masks.end(), timestamp,
                       [](const MaskFile& mask, double time) { return mask.timestamp < time; });
  const MaskFile* nearest = nullptr;
  const auto consider = [&](const MaskFile& mask) {
    const double distance = std::abs(mask.timestamp - timestamp);
    if (distance > tolerance) return;
    if (nearest == nullptr || distance < std::abs(nearest->timestamp - timestamp)) nearest = &mask;
  };
  if (after != masks.begin()) consider(*(after - 1));
  if (after != masks.end()) consider(*after);
  return nearest;
}

}  // namespace stdc
