#include "input/recordings/topic_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <initializer_list>
#include <string_view>

#include "core/lower_case.hpp"

namespace stdc {
namespace {

bool has_any(const std::string& topic, std::initializer_list<std::string_view> parts) {
  const std::string name = lower_case(topic);
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return name.find(part) != std::string::npos; });
}

/// The picture's topic without what a transport puts behind it.
std::string picture_of(const std::string& topic) {
  for (const std::string_view end : {"/compressed", "/compressedDepth"}) {
    if (topic.ends_with(end)) return topic.substr(0, topic.size() - end.size());
  }
  return topic;
}

std::string last_name_of(const std::string& topic) {
  const std::string picture = picture_of(topic);
  return picture.substr(picture.rfind('/') + 1);
}

}  // namespace

std::string camera_of_topic(const std::string& topic) {
  const std::string picture = picture_of(topic);
  constexpr std::string_view kRealSense = "/image/data";
  if (picture.ends_with(kRealSense)) return picture.substr(0, picture.size() - kRealSense.size());
  const std::size_t slash = picture.rfind('/');
  return slash == std::string::npos ? "" : picture.substr(0, slash);
}

int shared_names(const std::string& a, const std::string& b) {
  int shared = 0;
  std::size_t i = 0;
  for (; i < a.size() && i < b.size() && a[i] == b[i]; ++i) shared += a[i] == '/';
  const bool whole = (i == a.size() || a[i] == '/') && (i == b.size() || b[i] == '/');
  return whole ? shared + 1 : shared;
}

bool is_rectified(const std::string& topic) { return last_name_of(topic).starts_with("image_rect"); }

bool is_named_registered(const std::string& topic) {
  return has_any(topic, {"aligned_depth", "depth_aligned", "depth_registered", "registered_depth",
                         "depth_to_color", "depth_to_rgb"});
}

bool is_named_infrared(const std::string& topic) {
  return has_any(topic, {"infra", "/ir/", "_ir", "thermal"});
}

bool is_named_confidence(const std::string& topic) {
  return has_any(topic, {"confidence", "disparity", "variance"});
}

bool is_named_visualisation(const std::string& topic) {
  return has_any(topic, {"depth", "disparity", "debug", "mask", "segment", "overlay", "confidence"});
}

bool is_named_truth(const std::string& topic) {
  return has_any(topic, {"groundtruth", "ground_truth", "/gt", "vicon", "mocap", "optitrack", "qualisys"});
}

int rank_of_name(const std::string& topic) {
  constexpr std::array<std::string_view, 7> kNames{"image_rect", "image_rect_color", "image_rect_raw", "data",
                                                   "image",      "image_raw",        "image_color"};
  const auto* found = std::find(kNames.begin(), kNames.end(), last_name_of(topic));
  return found == kNames.end() ? -1 : static_cast<int>(found - kNames.begin());
}

}  // namespace stdc
