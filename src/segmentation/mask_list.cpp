#include "segmentation/mask_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <system_error>

#include "core/error.hpp"
#include "core/files/image_list.hpp"
#include "core/files/text_file.hpp"

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
  std::vector<MaskFile> masks;
  for (const fs::path& path : mask_files(folder)) {
    if (const auto time = time_of_mask(path)) masks.push_back({*time, path, 0});
  }
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

void check_folder(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored)) return;
  throw Error(folder.string(), "is not a folder", "give the folder that holds the masks");
}

}  // namespace

std::vector<fs::path> mask_files(const fs::path& folder) {
  check_folder(folder);
  std::error_code problem;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    if (entry->path().extension() == ".png") files.push_back(entry->path());
  }
  if (problem)
    throw Error(folder.string(), "cannot be read (" + problem.message() + ")",
                "check the path and its permissions");
  std::sort(files.begin(), files.end());
  return files;
}

std::optional<double> time_of_mask(const fs::path& file) {
  const std::string stem = file.stem().string();
  const auto time = parse_number(stem);
  if (!time || !std::isfinite(*time)) return std::nullopt;
  const bool whole = stem.find_first_not_of("0123456789") == std::string::npos;
  if (!whole) return time;
  switch (stem.size()) {
    case 13:
      return *time * 1e-3;
    case 16:
      return *time * 1e-6;
    case 19:
      return *time * 1e-9;
    default:
      return time;
  }
}

std::vector<MaskFile> list_masks(const fs::path& folder) {
  check_folder(folder);
  std::error_code ignored;
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
