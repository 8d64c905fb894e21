#include "input/layouts/image_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <system_error>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_size.hpp"
#include "input/association.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
  return text;
}

/// The last number of a name, with its fraction if it has one.
std::optional<double> number_in(const std::string& stem) {
  auto end = std::find_if(stem.rbegin(), stem.rend(), is_digit).base();
  if (end == stem.begin()) return std::nullopt;
  const auto run_before = [&](std::string::const_iterator last) {
    while (last != stem.begin() && is_digit(*(last - 1))) --last;
    return last;
  };
  auto first = run_before(end);
  if (first - stem.begin() >= 2 && *(first - 1) == '.' && is_digit(*(first - 2)))
    first = run_before(first - 1);
  return parse_number(std::string(first, end));
}

/// "0000012-000000399999": a frame number and the time in microseconds, as the Redwood scans have it.
bool has_microseconds(const std::string& stem) {
  constexpr std::size_t kDigits = 12;
  const std::size_t dash = stem.rfind('-');
  return dash != std::string::npos && dash > 0 && stem.size() - dash - 1 == kDigits &&
         is_digit(stem[dash - 1]) &&
         std::all_of(stem.begin() + static_cast<std::ptrdiff_t>(dash) + 1, stem.end(), is_digit);
}

const char* name_of(NameMeaning meaning) {
  constexpr std::array kNames{"frame numbers", "seconds", "milliseconds", "microseconds", "nanoseconds"};
  return kNames[static_cast<std::size_t>(meaning)];
}

using Pairs = std::vector<std::pair<int, int>>;

Pairs pair_by_number(const std::vector<NamedImage>& colour, const std::vector<NamedImage>& depth) {
  std::map<double, int> by_number;
  for (std::size_t i = 0; i < depth.size(); ++i) by_number[*depth[i].number] = static_cast<int>(i);
  Pairs pairs;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const auto found = by_number.find(*colour[i].number);
    if (found != by_number.end()) pairs.emplace_back(static_cast<int>(i), found->second);
  }
  return pairs;
}

std::vector<double> times_of(const std::vector<NamedImage>& images, NameMeaning meaning, double rate) {
  std::vector<double> times;
  times.reserve(images.size());
  for (const NamedImage& image : images) times.push_back(time_of(*image.number, meaning, rate));
  return times;
}

bool all_numbered(const std::vector<NamedImage>& images) {
  return std::all_of(images.begin(), images.end(), [](const NamedImage& i) { return i.number.has_value(); });
}

/// Numbers that increase: two files of one number have no order in time.
void check_increasing(const std::vector<NamedImage>& images) {
  for (std::size_t i = 1; i < images.size(); ++i) {
    if (*images[i].number > *images[i - 1].number) continue;
    throw Error(images[i].path.string(),
                fmt::format("has the same number as {}", images[i - 1].path.filename().string()),
                "keep one of the two");
  }
}

}  // namespace

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::optional<fs::path> first_folder(const fs::path& parent, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (is_folder(parent / name)) return parent / name;
  }
  return std::nullopt;
}

std::vector<NamedImage> list_images(const fs::path& folder, std::initializer_list<std::string_view> endings) {
  std::vector<NamedImage> images;
  std::error_code problem;
  for (fs::directory_iterator entry(folder, problem), end; !problem && entry != end;
       entry.increment(problem)) {
    const std::string name = lower(entry->path().filename().string());
    const bool wanted =
        name.front() != '.' && std::any_of(endings.begin(), endings.end(), [&](std::string_view e) {
          return name.size() > e.size() && name.ends_with(e);
        });
    if (wanted) images.push_back({entry->path(), number_in(entry->path().stem().string())});
  }
  if (problem) {
    throw Error(folder.string(), fmt::format("cannot be read ({})", problem.message()),
                "check the path and its permissions");
  }
  std::sort(images.begin(), images.end(), [](const NamedImage& a, const NamedImage& b) {
    return std::tuple(a.number.value_or(-1), a.path) < std::tuple(b.number.value_or(-1), b.path);
  });
  return images;
}

std::vector<NamedImage> list_colour_images(const fs::path& folder) {
  return list_images(folder, {".png", ".jpg", ".jpeg"});
}

std::vector<NamedImage> list_depth_images(const fs::path& folder) {
  return list_images(folder, {".png", ".tif", ".tiff", ".exr", ".npy"});
}

NameMeaning meaning_of(const std::vector<NamedImage>& images) {
  double largest = 0;
  bool fraction = false, stamped = !images.empty();
  for (const NamedImage& image : images) {
    const double number = image.number.value_or(0);
    largest = std::max(largest, number);
    fraction = fraction || number != std::floor(number);
    stamped = stamped && has_microseconds(image.path.stem().string());
  }
  // The year 2001 in each unit.
  if (largest > 1e18) return NameMeaning::nanoseconds;
  if (largest > 1e15 || stamped) return NameMeaning::microseconds;
  if (largest > 1e12) return NameMeaning::milliseconds;
  return fraction || largest > 1e9 ? NameMeaning::seconds : NameMeaning::frames;
}

double time_of(double number, NameMeaning meaning, double rate) {
  switch (meaning) {
    case NameMeaning::seconds:
      return number;
    case NameMeaning::milliseconds:
      return number * 1e-3;
    case NameMeaning::microseconds:
      return number * 1e-6;
    case NameMeaning::nanoseconds:
      return number * 1e-9;
    case NameMeaning::frames:
      break;
  }
  return number / rate;
}

void pair_images(const std::vector<NamedImage>& colour, const std::vector<NamedImage>& depth, double rate,
                 FolderContents& contents) {
  constexpr double kMaxDifference = 0.02;  // [s] as in TUM folders
  if (colour.empty()) throw Error(contents.where, "holds no colour images", "give PNG or JPEG files");
  if (depth.empty()) {
    throw Error(contents.where, "holds no depth images",
                "give 16-bit PNG or TIFF files, or EXR or NPY with metres");
  }
  const bool numbered = all_numbered(colour) && all_numbered(depth);
  NameMeaning meaning = NameMeaning::frames;
  Pairs pairs;
  if (numbered && meaning_of(colour) == meaning_of(depth)) {
    check_increasing(colour);
    check_increasing(depth);
    meaning = meaning_of(colour);
    pairs = meaning == NameMeaning::frames ? pair_by_number(colour, depth)
                                           : associate_times(times_of(colour, meaning, rate),
                                                             times_of(depth, meaning, rate), kMaxDifference);
  } else if (colour.size() == depth.size()) {
    for (int i = 0; i < static_cast<int>(colour.size()); ++i) pairs.emplace_back(i, i);
    contents.notes.push_back(contents.where +
                             ": the names of colour and depth images have nothing in common: "
                             "they are paired in the order of their names");
    if (all_numbered(colour)) meaning = meaning_of(colour);
  }
  if (pairs.empty()) {
    throw Error(contents.where, "no depth image belongs to a colour image",
                fmt::format("name them by the same numbers, or by times at most {:.0f} ms apart",
                            1e3 * kMaxDifference));
  }
  const auto time = [&](const std::vector<NamedImage>& images, int i) {
    const auto& number = images[static_cast<std::size_t>(i)].number;
    return time_of(number && all_numbered(images) ? *number : i, meaning, rate);
  };
  for (const auto& [c, d] : pairs) {
    const fs::path& colour_path = colour[static_cast<std::size_t>(c)].path;
    const fs::path& depth_path = depth[static_cast<std::size_t>(d)].path;
    const double at = time(colour, c);
    const bool own_time = meaning != NameMeaning::frames && numbered && meaning_of(depth) == meaning;
    contents.frames.push_back({at,
                               own_time ? time(depth, d) : at,
                               {colour_path, colour_path.string()},
                               {depth_path, depth_path.string()}});
  }
  contents.colour_without_depth = static_cast<int>(colour.size() - pairs.size());
  if (meaning == NameMeaning::frames) {
    contents.notes.push_back(
        fmt::format("{}: has no times: frame n is taken to be at n / {:g} s (--rate)", contents.where, rate));
  } else if (meaning != NameMeaning::seconds) {
    contents.notes.push_back(
        fmt::format("{}: the names of the images are read as {}", contents.where, name_of(meaning)));
  }
}

cv::Size size_of_image(const fs::path& path) {
  constexpr std::size_t kMaxImage = std::size_t{1} << 28U;
  const std::string text = read_file(path, "restore the image", kMaxImage);
  const auto size = image_size(Bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  if (!size)
    throw Error(path.string(), "is neither a PNG nor a JPEG, or its header is damaged", "restore the image");
  return *size;
}

}  // namespace stdc
