#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "input/survey/depth_warnings.hpp"
#include "input/survey/input_survey.hpp"

namespace stdc {
namespace {

using Lines = std::vector<std::string>;

void warn_of_times(const InputSurvey& survey, Lines& lines) {
  const SurveyTimes& times = survey.times;
  if (times.frames == 0) {
    lines.emplace_back("there is not one frame with colour and depth");
    return;
  }
  if (times.frames < 2) return;
  constexpr double kMinRate = 4.5, kMaxRate = 95;
  if (times.rate() < kMinRate) {
    lines.push_back(
        fmt::format("{:.1f} frames a second: a moving camera will be lost between them", times.rate()));
  }
  if (times.rate() > kMaxRate) {
    lines.push_back(fmt::format("{:.0f} frames a second: are the times in seconds?", times.rate()));
  }
  if (times.jitter > 0.3 * times.interval) {
    lines.push_back(
        fmt::format("the time from frame to frame varies by {:.0f} ms: are these the times of the camera, or "
                    "those at which the images arrived?",
                    1e3 * times.jitter));
  }
  if (times.gaps > 0) {
    lines.push_back(
        fmt::format("{} gap{}, the longest of {:.2f} s after {:.3f} s: tracking may be lost there",
                    times.gaps, times.gaps > 1 ? "s" : "", times.longest_gap, times.gap_at - times.first));
  }
  if (times.backwards > 0) {
    lines.push_back(
        fmt::format("{} frames are not later than the one before: they will be skipped", times.backwards));
  }
  constexpr double kMaxOffset = 0.012;
  if (std::abs(times.depth_offset) > kMaxOffset && times.depth_offset_spread < kMaxOffset / 2) {
    lines.push_back(
        fmt::format("depth is always {:.0f} ms {} than colour: are both stamped by the same clock?",
                    1e3 * std::abs(times.depth_offset), times.depth_offset > 0 ? "later" : "earlier"));
  }
  const int colour = times.frames + survey.colour_without_depth;
  if (survey.colour_without_depth > colour / 10) {
    lines.push_back(
        fmt::format("{} of {} colour images have no depth image near them in time: they are left out",
                    survey.colour_without_depth, colour));
  }
}

void warn_of_depth(const InputSurvey& survey, Lines& lines) {
  const SurveyImages& images = survey.images;
  if (images.sampled == 0) return;
  std::optional<double> units;
  if (survey.cameras && !images.depth_in_metres) units = survey.cameras->colour.depth_units_per_metre;
  const Lines found = depth_warnings(
      {images.median_depth, images.far_depth, images.valid_share, images.saturated_share}, units);
  lines.insert(lines.end(), found.begin(), found.end());
}

/// "11 pixels right of", "4 pixels above"
std::string direction(const EdgeShift& shift) {
  const bool across = std::abs(shift.x) >= std::abs(shift.y);
  const double pixels = across ? shift.x : shift.y;
  const char* const words = across ? (pixels > 0 ? "right of" : "left of") : (pixels > 0 ? "below" : "above");
  return fmt::format("{:.0f} pixels {}", std::abs(pixels), words);
}

bool is_off(const std::optional<EdgeShift>& shift, int width) {
  constexpr double kMinShift = 4.0 / 640, kMinGain = 0.08, kMinClarity = 2.5;
  return shift && std::hypot(shift->x, shift->y) >= kMinShift * width && shift->gain > kMinGain &&
         shift->clarity > kMinClarity;
}

void warn_of_registration(const InputSurvey& survey, Lines& lines) {
  const SurveyImages& images = survey.images;
  if (images.sampled == 0) return;
  const bool has_depth_camera = survey.cameras && survey.cameras->depth;
  if (images.colour_size != images.depth_size && !has_depth_camera) {
    lines.push_back(
        fmt::format("depth images have {} x {} pixels and colour images {} x {}: not registered; give the "
                    "depth_camera in a camera file (docs/inputs.md)",
                    images.depth_size.width, images.depth_size.height, images.colour_size.width,
                    images.colour_size.height));
    return;
  }
  const int width = images.colour_size.width;
  const bool left = is_off(images.left_edges, width), right = is_off(images.right_edges, width);
  if (left && right && images.left_edges->x * images.right_edges->x < 0) {
    lines.push_back(
        fmt::format("at the left depth edges lie {} colour edges and at the right {}: has the depth camera "
                    "another focal length, and is it not registered?",
                    direction(*images.left_edges), direction(*images.right_edges)));
  } else if (is_off(images.edges, width)) {
    lines.push_back(fmt::format("depth edges lie {} colour edges: {}", direction(*images.edges),
                                has_depth_camera ? "is the depth_camera right?" : "not registered?"));
  }
}

void warn_of_camera(const InputSurvey& survey, Lines& lines) {
  if (!survey.cameras) {
    lines.push_back("the camera is not known: " + survey.camera_hint);
    return;
  }
  const Camera& camera = survey.cameras->colour;
  const cv::Size size = survey.images.colour_size;
  if (survey.images.sampled > 0 && size != cv::Size(camera.width, camera.height)) {
    lines.push_back(fmt::format("the images have {} x {} pixels, but the camera has {} x {}", size.width,
                                size.height, camera.width, camera.height));
    return;
  }
  const double view = 2 * std::atan(0.5 * camera.width / camera.fx) * 180 / M_PI;
  if (camera.lens != LensModel::equidistant && (view < 35 || view > 120)) {
    lines.push_back(fmt::format("fx = {:.0f} means a view of {:.0f} degrees: is it of another image size?",
                                camera.fx, view));
  }
  if (std::abs(camera.fx / camera.fy - 1) > 0.1) {
    lines.push_back(fmt::format("fx and fy differ by {:.0f} %: pixels are square on most cameras",
                                100 * std::abs(camera.fx / camera.fy - 1)));
  }
  const double off = std::hypot(camera.cx / camera.width - 0.5, camera.cy / camera.height - 0.5);
  if (off > 0.12) {
    lines.push_back(fmt::format(
        "cx, cy lie {:.0f} % of the image off its middle: are they of another image size?", 100 * off));
  }
  const double rate = survey.times.rate();
  if (survey.times.frames > 10 && std::abs(rate / camera.frames_per_second - 1) > 0.25) {
    lines.push_back(fmt::format("frames come {:.1f} times a second, the camera says frames_per_second {:g}",
                                rate, camera.frames_per_second));
  }
}

void warn_of_images(const InputSurvey& survey, Lines& lines) {
  const SurveyImages& images = survey.images;
  if (images.unreadable > 0) {
    lines.push_back(fmt::format("{} of {} frames looked at cannot be read, such as {}", images.unreadable,
                                images.unreadable + images.sampled, images.first_problem));
  }
  if (images.other_sizes > 0) {
    lines.push_back(fmt::format("{} of {} frames looked at have another size than the first",
                                images.other_sizes, images.sampled));
  }
  if (images.sampled == 0) return;
  if (images.brightness < 20)
    lines.push_back(fmt::format("the images are dark (mean {:.0f} of 255)", images.brightness));
  if (images.brightness > 235)
    lines.push_back(fmt::format("the images are overexposed (mean {:.0f} of 255)", images.brightness));
  if (images.grey) {
    lines.emplace_back(
        "the images are grey: the network that finds people was trained on colour; --segmentation off and "
        "--motion map need none");
  }
}

}  // namespace

std::vector<std::string> survey_warnings(const InputSurvey& survey) {
  Lines lines = survey.faults;
  if (!survey.truth_problem.empty()) lines.push_back(survey.truth_problem);
  warn_of_times(survey, lines);
  warn_of_images(survey, lines);
  warn_of_camera(survey, lines);
  warn_of_depth(survey, lines);
  warn_of_registration(survey, lines);
  return lines;
}

}  // namespace stdc
