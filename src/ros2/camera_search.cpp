#include "ros2/camera_search.hpp"

#include <fmt/format.h>

#include "input/recordings/messages/ros_messages.hpp"

namespace stdc::ros2 {
namespace {

constexpr int kSeenImages = 6;  // for the rate
constexpr int kTransforms = 100;

/// A damaged first image must not decide.
bool is_readable(const RecordedTopic& topic, Bytes data) {
  if (topic.type == "sensor_msgs/Image") return read_image_message(Serialisation::cdr, data).has_value();
  if (topic.type == "sensor_msgs/CompressedImage") {
    return read_compressed_image_message(Serialisation::cdr, data).has_value();
  }
  return topic.type != "sensor_msgs/CameraInfo" ||
         read_camera_info_message(Serialisation::cdr, data).has_value();
}

LogTime nanoseconds(CameraSearch::Clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch()).count();
}

}  // namespace

CameraSearch::CameraSearch(const std::vector<Topic>& topics_by_stream) {
  for (const Topic& topic : topics_by_stream) messages_.add_topic(topic.name, topic.type);
}

void CameraSearch::add(CameraStream stream, Bytes data, Clock::time_point now) {
  if (!is_readable(messages_.topics()[static_cast<std::size_t>(stream)], data)) return;
  const bool info = stream == CameraStream::colour_info || stream == CameraStream::depth_info;
  const int max = info ? 1 : stream == CameraStream::transforms ? kTransforms : kSeenImages;
  messages_.add(static_cast<int>(stream), nanoseconds(now), data, max);
  if (!first_pair_ && count(CameraStream::colour) > 0 && count(CameraStream::depth) > 0) first_pair_ = now;
}

std::string CameraSearch::missing(bool camera_is_known) const {
  std::string names;
  const auto need = [&](CameraStream stream) {
    if (count(stream) > 0) return;
    names += (names.empty() ? "" : ", ") + messages_.topics()[static_cast<std::size_t>(stream)].name;
  };
  need(CameraStream::colour);
  need(CameraStream::depth);
  if (!camera_is_known) need(CameraStream::colour_info);
  return names;
}

/// Whether depth is registered to colour, or all is there to do it.
bool CameraSearch::registration_is_settled(const RecordingSurvey& survey, const TopicChoice& choice) {
  const auto name = [&](int topic) { return messages_.topics()[static_cast<std::size_t>(topic)].name; };
  const ImageSample &colour = *survey.find(name(choice.colour)), &depth = *survey.find(name(choice.depth));
  if (colour.size == depth.size && (choice.depth_is_registered || colour.frame == depth.frame)) return true;
  return choice.depth_info && read_transforms(messages_).find(colour.frame, depth.frame).has_value();
}

std::optional<FoundCameras> CameraSearch::find(Clock::time_point now, bool camera_is_known) {
  constexpr std::chrono::seconds kPatienceForRate(1), kPatienceForTransforms(10);
  if (!first_pair_ || !missing(camera_is_known).empty()) return std::nullopt;
  if (count(CameraStream::colour) < kSeenImages && now - *first_pair_ < kPatienceForRate) return std::nullopt;
  const RecordingSurvey surveyed = survey(messages_);
  SourceOptions options;
  const auto name = [&](CameraStream stream) {
    return messages_.topics()[static_cast<std::size_t>(stream)].name;
  };
  options.colour_topic = name(CameraStream::colour);
  options.depth_topic = name(CameraStream::depth);
  if (count(CameraStream::colour_info) > 0) options.colour_info_topic = name(CameraStream::colour_info);
  if (count(CameraStream::depth_info) > 0) options.depth_info_topic = name(CameraStream::depth_info);
  const TopicChoice choice = choose_topics(messages_, surveyed, options);
  if (camera_is_known) return FoundCameras();
  if (!registration_is_settled(surveyed, choice) && now - *first_pair_ < kPatienceForTransforms) {
    return std::nullopt;
  }
  return find_cameras(messages_, surveyed, choice);
}

}  // namespace stdc::ros2
