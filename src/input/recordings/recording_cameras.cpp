#include "input/recordings/recording_cameras.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "input/camera_file.hpp"
#include "input/recordings/messages/camera_of_info.hpp"
#include "input/recordings/messages/ros_messages.hpp"
#include "input/recordings/topic_names.hpp"

namespace stdc {
namespace {

/// What a camera was asked for, not what a few stamps that jitter make of it [Hz].
double nominal_rate(double measured) {
  for (const double usual : {5, 6, 10, 15, 20, 25, 30, 60, 90}) {
    if (std::abs(measured - usual) < 0.08 * usual) return usual;
  }
  return std::max(1.0, std::round(measured));
}

bool is_same_lens(const Camera& a, const Camera& b) {
  constexpr double kSame = 1e-6;  // [px]
  const auto same = [](double x, double y) { return std::abs(x - y) <= kSame; };
  return a.width == b.width && a.height == b.height && same(a.fx, b.fx) && same(a.fy, b.fy) &&
         same(a.cx, b.cx) && same(a.cy, b.cy);
}

class CameraFinder {
 public:
  CameraFinder(Recording& recording, const RecordingSurvey& survey, const TopicChoice& choice)
      : recording_(recording),
        survey_(survey),
        choice_(choice),
        colour_(*survey.find(name_of(choice.colour))),
        depth_(*survey.find(name_of(choice.depth))) {}

  RecordingCameras find() {
    if (!choice_.colour_info) {
      result_.hint =
          fmt::format("record camera_info beside {}, name it by --info, or give a camera file with --camera",
                      colour_.name);
      return result_;
    }
    RgbdCameras cameras;
    cameras.colour = camera_of(*choice_.colour_info, colour_);
    take_what_info_lacks(cameras.colour);
    if (!is_registered(cameras.colour) && !add_depth_camera(cameras)) return result_;
    result_.cameras = cameras;
    return result_;
  }

 private:
  const std::string& name_of(int topic) const {
    return recording_.topics()[static_cast<std::size_t>(topic)].name;
  }

  Camera camera_of(int info_topic, const ImageSample& image) const {
    const std::string where = fmt::format("{} ({})", recording_.where(), name_of(info_topic));
    const auto serialisation = recording_.topics()[static_cast<std::size_t>(info_topic)].serialisation;
    const auto info = read_camera_info_message(serialisation, survey_.infos.at(info_topic));
    if (!info) throw Error(where, "the message is damaged", "give a camera file with --camera");
    Camera camera = camera_of_info(*info, is_rectified(image.name), where);
    camera.depth_units_per_metre = depth_units();
    if (const auto rate = rate_of(image)) camera.frames_per_second = nominal_rate(*rate);
    return camera;
  }

  /// From the camera file that `convert` puts beside the images.
  void take_what_info_lacks(Camera& camera) {
    const auto topic = recording_.find_topic(kCameraFileTopic);
    if (!topic) return;
    recording_.start(std::array{*topic});
    const auto message = recording_.next();
    if (!message) return;
    const std::string where = fmt::format("{} ({})", recording_.where(), kCameraFileTopic);
    const RecordedTopic& recorded = recording_.topics()[static_cast<std::size_t>(*topic)];
    try {
      const auto text = read_string_message(recorded.serialisation, message->data);
      if (!text || recorded.type != "std_msgs/String") throw Error(where, "is no std_msgs/String", "");
      const Camera file = parse_camera(*text, where);
      if (!is_same_lens(file, camera)) return;  // of another camera of the recording
      camera.readout_time = file.readout_time;
      camera.rotation = file.rotation;
    } catch (const Error& error) {
      result_.notes.push_back(fmt::format("{}: is left out: {}", where, error.problem()));
    }
  }

  double depth_units() const {
    constexpr double kMillimetres = 1000;
    for (const auto& [sensor, unit] : survey_.depth_units) {
      // In four bytes 0.001 is 0.0010000000475.
      if (depth_.name.starts_with(sensor + "/") && unit > 0) return std::round(1e3 / unit) / 1e3;
    }
    return kMillimetres;
  }

  bool is_registered(const Camera& colour) {
    if (depth_.size != cv::Size(colour.width, colour.height)) return false;
    if (choice_.depth_is_registered || depth_.frame == colour_.frame) return true;
    if (choice_.depth_info && colour_from_depth()) return false;
    result_.notes.push_back(
        fmt::format("{}: depth of {} (frame '{}') is taken as registered to {} (frame '{}'): the recording "
                    "does not say otherwise",
                    recording_.where(), depth_.name, depth_.frame, colour_.name, colour_.frame));
    return true;
  }

  bool add_depth_camera(RgbdCameras& cameras) {
    const std::optional<Pose> pose = choice_.depth_info ? colour_from_depth() : std::nullopt;
    if (!pose) {
      result_.hint = fmt::format(
          "depth of {} ({} x {}) is not registered to {}: record its camera_info and /tf_static as well, or "
          "give a "
          "camera file with depth_camera by --camera",
          depth_.name, depth_.size.width, depth_.size.height, colour_.name);
      return false;
    }
    cameras.depth = DepthCamera{camera_of(*choice_.depth_info, depth_), *pose};
    return true;
  }

  std::optional<Pose> colour_from_depth() const {
    const auto colour = survey_.stream_from_device.find(camera_of_topic(colour_.name));
    const auto depth = survey_.stream_from_device.find(camera_of_topic(depth_.name));
    if (colour != survey_.stream_from_device.end() && depth != survey_.stream_from_device.end()) {
      return colour->second * depth->second.inverse();
    }
    if (colour_.frame.empty() || depth_.frame.empty()) return std::nullopt;
    return read_transforms(recording_).find(colour_.frame, depth_.frame);
  }

  Recording& recording_;
  const RecordingSurvey& survey_;
  const TopicChoice& choice_;
  const ImageSample &colour_, &depth_;
  RecordingCameras result_;
};

}  // namespace

RecordingCameras find_cameras(Recording& recording, const RecordingSurvey& survey,
                              const TopicChoice& choice) {
  return CameraFinder(recording, survey, choice).find();
}

std::optional<double> rate_of(const ImageSample& sample) {
  std::vector<std::int64_t> steps;
  for (std::size_t i = 1; i < sample.stamps.size(); ++i) {
    if (sample.stamps[i] > sample.stamps[i - 1]) steps.push_back(sample.stamps[i] - sample.stamps[i - 1]);
  }
  if (steps.empty()) return std::nullopt;
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2), steps.end());
  return 1e9 / static_cast<double>(steps[steps.size() / 2]);
}

}  // namespace stdc
