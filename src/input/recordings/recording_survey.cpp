#include "input/recordings/recording_survey.hpp"

#include <algorithm>
#include <set>

#include "input/recordings/messages/ros_messages.hpp"

namespace stdc {
namespace {

constexpr std::size_t kStamps = 6;                     // of each topic, for the rate
constexpr LogTime kPatience = 1'000'000'000;           // [ns] to wait for a topic after the first image
constexpr LogTime kPatienceForFirst = 20'000'000'000;  // [ns] to wait for the second image topic

bool is_image(const RecordedTopic& topic) {
  return topic.type == "sensor_msgs/Image" || topic.type == "sensor_msgs/CompressedImage";
}

bool readable(const RecordedTopic& topic) {
  return topic.serialisation != Serialisation::other && topic.count.value_or(1) > 0;
}

/// Whether a PNG is one of 16 bits and one channel.
bool is_depth_png(Bytes bytes) {
  return is_png(bytes) && bytes.size() > 25 && bytes[24] == 16 && bytes[25] == 0;
}

PixelMeaning meaning_of_compressed(const CompressedImageMessage& image) {
  if (is_compressed_depth(image.format)) return PixelMeaning::depth;
  if (is_depth_png(image.data)) return PixelMeaning::sixteen_bits;
  if (is_png(image.data) || is_jpeg(image.data)) {
    return image.format.starts_with("mono") ? PixelMeaning::grey : PixelMeaning::colour;
  }
  return PixelMeaning::unknown;
}

/// Takes what the image tells; false if the message is damaged.
bool look_at(const RecordedTopic& topic, const RecordedMessage& message, ImageSample& sample) {
  MessageHeader header;
  if (topic.type == "sensor_msgs/CompressedImage") {
    const auto image = read_compressed_image_message(topic.serialisation, message.data);
    if (!image) return false;
    header = image->header;
    sample.compressed = true;
    sample.encoding = image->format;
    sample.meaning = meaning_of_compressed(*image);
    sample.size = size_of(*image).value_or(cv::Size());
  } else {
    const auto image = read_image_message(topic.serialisation, message.data);
    if (!image) return false;
    header = image->header;
    sample.encoding = image->encoding;
    sample.meaning = meaning_of(image->encoding);
    constexpr std::uint32_t kMaxSurveyedSide = 16384;
    if (image->width <= kMaxSurveyedSide && image->height <= kMaxSurveyedSide) {
      sample.size = {static_cast<int>(image->width), static_cast<int>(image->height)};
    }
  }
  sample.name = topic.name;
  sample.topic = message.topic;
  sample.frame = header.frame;
  sample.stamp = header.stamp;
  sample.log_time = message.log_time;
  return true;
}

/// Gives the topics that a condition holds for.
template <typename Condition>
std::vector<int> topics_where(const Recording& recording, const Condition& condition) {
  std::vector<int> topics;
  for (std::size_t i = 0; i < recording.topics().size(); ++i) {
    const RecordedTopic& topic = recording.topics()[i];
    if (readable(topic) && condition(topic)) topics.push_back(static_cast<int>(i));
  }
  return topics;
}

void look_at_images(Recording& recording, RecordingSurvey& result) {
  const std::vector<int> topics = topics_where(recording, is_image);
  std::map<int, ImageSample> samples;
  recording.start(topics);
  std::optional<LogTime> first;
  while (const auto message = recording.next()) {
    const RecordedTopic& topic = recording.topics()[static_cast<std::size_t>(message->topic)];
    ImageSample& sample = samples[message->topic];
    if (sample.stamps.empty() && !look_at(topic, *message, sample)) {
      samples.erase(message->topic);
      continue;
    }
    const auto header = read_message_header(topic.serialisation, message->data);
    if (header && sample.stamps.size() < kStamps) sample.stamps.push_back(header->stamp);
    if (!first) first = message->log_time;
    const LogTime waited = message->log_time - *first;
    const bool all = samples.size() == topics.size() &&
                     std::all_of(samples.begin(), samples.end(),
                                 [](const auto& entry) { return entry.second.stamps.size() == kStamps; });
    if (all || waited > kPatienceForFirst || (samples.size() > 1 && waited > kPatience)) break;
  }
  for (const int topic : topics) {
    if (const auto found = samples.find(topic); found != samples.end())
      result.images.push_back(found->second);
  }
}

/// "/device_0/sensor_0" of "/device_0/sensor_0/option/Depth_Units/value"; nothing if it does not end so.
std::optional<std::string> before(const std::string& name, std::string_view end) {
  if (!name.ends_with(end)) return std::nullopt;
  return name.substr(0, name.size() - end.size());
}

constexpr std::string_view kDepthUnits = "/option/Depth_Units/value", kStreamPose = "/tf/0";

/// Whether a topic describes a camera, all in one message.
bool describes_camera(const RecordedTopic& topic) {
  return topic.type == "sensor_msgs/CameraInfo" || before(topic.name, kDepthUnits) ||
         (topic.type == "geometry_msgs/Transform" && before(topic.name, kStreamPose));
}

void take(const RecordedTopic& topic, const RecordedMessage& message, RecordingSurvey& result) {
  if (topic.type == "sensor_msgs/CameraInfo") {
    result.infos.try_emplace(message.topic, message.data.begin(), message.data.end());
  } else if (const auto sensor = before(topic.name, kDepthUnits)) {
    const auto unit = read_number_message(topic.type, topic.serialisation, message.data);
    if (unit) result.depth_units.try_emplace(*sensor, *unit);
  } else if (const auto stream = before(topic.name, kStreamPose)) {
    const auto pose = read_transform_message(topic.serialisation, message.data);
    if (pose) result.stream_from_device.try_emplace(*stream, *pose);
  }
}

/// Reads one message of each topic.
void look_at(Recording& recording, const std::vector<int>& topics, LogTime until, RecordingSurvey& result) {
  std::set<int> open(topics.begin(), topics.end());
  if (!topics.empty()) recording.start(topics, Recording::kBegin, until);
  while (!open.empty()) {
    const auto message = recording.next();
    if (!message) return;
    if (open.erase(message->topic) == 0) continue;
    take(recording.topics()[static_cast<std::size_t>(message->topic)], *message, result);
  }
}

/// What lies within this time from the first message on is the beginning [ns].
constexpr LogTime kBeginning = 5'000'000'000;

LogTime end_of_beginning(const Recording& recording) {
  return recording.first_time().value_or(0) + kBeginning;
}

void look_at_descriptions(Recording& recording, RecordingSurvey& result) {
  look_at(recording, topics_where(recording, describes_camera), end_of_beginning(recording), result);
  if (!result.infos.empty()) return;
  const auto is_info = [](const RecordedTopic& topic) { return topic.type == "sensor_msgs/CameraInfo"; };
  look_at(recording, topics_where(recording, is_info), Recording::kEnd, result);
}

}  // namespace

const ImageSample* RecordingSurvey::find(std::string_view name) const {
  const auto found =
      std::find_if(images.begin(), images.end(), [&](const ImageSample& s) { return s.name == name; });
  return found == images.end() ? nullptr : &*found;
}

RecordingSurvey survey(Recording& recording) {
  RecordingSurvey result;
  look_at_images(recording, result);
  look_at_descriptions(recording, result);
  return result;
}

TransformTree read_transforms(Recording& recording) {
  TransformTree tree;
  // What stands still first: of a child the first word counts.
  for (const bool still : {true, false}) {
    const std::vector<int> topics = topics_where(recording, [&](const RecordedTopic& topic) {
      return is_transforms_type(topic.type) && topic.name.ends_with("tf_static") == still;
    });
    recording.start(topics, Recording::kBegin, end_of_beginning(recording));
    while (const auto message = recording.next()) {
      const auto serialisation = recording.topics()[static_cast<std::size_t>(message->topic)].serialisation;
      const auto transforms = read_transforms_message(serialisation, message->data);
      for (const TransformMessage& t : transforms.value_or(std::vector<TransformMessage>())) {
        tree.add(t.header.frame, t.child, t.parent_from_child);
      }
    }
  }
  return tree;
}

}  // namespace stdc
