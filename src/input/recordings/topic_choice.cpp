#include "input/recordings/topic_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/recordings/messages/ros_messages.hpp"
#include "input/recordings/topic_names.hpp"

namespace stdc {
namespace {

using Samples = std::vector<const ImageSample*>;

bool shows_depth(const ImageSample& sample) {
  if (is_named_confidence(sample.name)) return false;
  return sample.meaning == PixelMeaning::depth ||
         (sample.meaning == PixelMeaning::sixteen_bits && !is_named_infrared(sample.name));
}

bool shows_colour(const ImageSample& sample) {
  return (sample.meaning == PixelMeaning::colour || sample.meaning == PixelMeaning::grey) &&
         !is_named_visualisation(sample.name);
}

/// Keeps those for which a value is greatest.
template <typename Value>
void keep_best(Samples& samples, const Value& value) {
  if (samples.empty()) return;
  const auto best = value(**std::max_element(
      samples.begin(), samples.end(), [&](const auto* a, const auto* b) { return value(*a) < value(*b); }));
  std::erase_if(samples, [&](const ImageSample* sample) { return value(*sample) < best; });
}

/// Of each camera only its best topic: raw before compressed.
Samples best_of_each_camera(const Samples& samples) {
  const auto rank = [](const ImageSample* s) { return std::pair(rank_of_name(s->name), !s->compressed); };
  Samples best;
  for (const ImageSample* sample : samples) {
    const auto same = std::find_if(best.begin(), best.end(), [&](const ImageSample* other) {
      return camera_of_topic(other->name) == camera_of_topic(sample->name);
    });
    if (same == best.end()) {
      best.push_back(sample);
    } else if (rank(sample) > rank(*same)) {
      *same = sample;
    }
  }
  return best;
}

std::string names_of(const Samples& samples) {
  std::string names;
  for (const ImageSample* sample : samples) names += (names.empty() ? "" : ", ") + sample->name;
  return names;
}

class Chooser {
 public:
  Chooser(const Recording& recording, const RecordingSurvey& survey, const SourceOptions& options)
      : recording_(recording), survey_(survey), options_(options) {}

  TopicChoice choose() const {
    const ImageSample& colour = choose_colour();
    const ImageSample& depth = choose_depth(colour);
    TopicChoice choice;
    choice.colour = colour.topic;
    choice.depth = depth.topic;
    choice.depth_is_registered = is_named_registered(depth.name);
    choice.colour_info = choose_info(colour, options_.colour_info_topic, "--info");
    choice.depth_info = choose_info(depth, options_.depth_info_topic, "--depth-info");
    choice.imu = choose_imu();
    choice.truth = choose_truth();
    return choice;
  }

 private:
  Samples samples_that(bool (*condition)(const ImageSample&)) const {
    Samples samples;
    for (const ImageSample& sample : survey_.images) {
      if (condition(sample)) samples.push_back(&sample);
    }
    return samples;
  }

  [[noreturn]] void fail(const std::string& problem, const std::string& hint) const {
    throw Error(recording_.where(), problem, hint);
  }

  std::string image_topics() const {
    std::string names;
    for (const RecordedTopic& topic : recording_.topics()) {
      if (topic.type == "sensor_msgs/Image" || topic.type == "sensor_msgs/CompressedImage") {
        names += (names.empty() ? "" : ", ") + topic.name;
      }
    }
    return names.empty() ? "none with images" : names;
  }

  const ImageSample& named(const std::string& topic, const char* option) const {
    if (const ImageSample* sample = survey_.find(topic)) return *sample;
    const std::string hint = fmt::format("give another {}; there is {}", option, image_topics());
    if (recording_.find_topic(topic))
      fail(fmt::format("its topic {} gives no image that can be read", topic), hint);
    fail(fmt::format("has no topic {}", topic), hint);
  }

  const ImageSample& only_one(const Samples& samples, const char* what, const char* option) const {
    if (samples.size() == 1) return *samples.front();
    if (samples.empty()) {
      std::string unknown;
      for (const ImageSample& sample : survey_.images) {
        if (sample.meaning == PixelMeaning::unknown) {
          unknown += fmt::format(" ({} has the unknown encoding {})", sample.name, shown(sample.encoding));
        }
      }
      fail(fmt::format("holds no {} images{}", what, unknown),
           fmt::format("record them, or name a topic by {}; there is {}", option, image_topics()));
    }
    fail(fmt::format("holds {} topics with {} images: {}", samples.size(), what, names_of(samples)),
         fmt::format("choose one by {}", option));
  }

  const ImageSample& choose_colour() const {
    if (!options_.colour_topic.empty()) return named(options_.colour_topic, "--color");
    Samples samples = samples_that(shows_colour);
    keep_best(samples, [](const ImageSample& sample) { return sample.meaning == PixelMeaning::colour; });
    samples = best_of_each_camera(samples);
    // A depth topic says by its name or its camera which colour it belongs to.
    if (samples.size() > 1) {
      const Samples depths = options_.depth_topic.empty() ? samples_that(shows_depth)
                                                          : Samples{&named(options_.depth_topic, "--depth")};
      keep_best(samples, [&](const ImageSample& sample) {
        return std::any_of(depths.begin(), depths.end(), [&](const ImageSample* depth) {
          return depth->size == sample.size && depth->frame == sample.frame &&
                 shared_names(camera_of_topic(depth->name), camera_of_topic(sample.name)) > 1;
        });
      });
    }
    return only_one(samples, "colour", "--color");
  }

  const ImageSample& choose_depth(const ImageSample& colour) const {
    if (!options_.depth_topic.empty()) return named(options_.depth_topic, "--depth");
    Samples samples = samples_that(shows_depth);
    std::erase(samples, &colour);
    const std::string camera = camera_of_topic(colour.name);
    keep_best(samples,
              [&](const ImageSample& sample) { return shared_names(camera_of_topic(sample.name), camera); });
    keep_best(samples, [](const ImageSample& sample) { return is_named_registered(sample.name); });
    keep_best(samples, [&](const ImageSample& sample) {
      return sample.size == colour.size && sample.frame == colour.frame;
    });
    samples = best_of_each_camera(samples);
    return only_one(samples, "depth", "--depth");
  }

  std::optional<int> choose_info(const ImageSample& image, const std::string& topic,
                                 const char* option) const {
    if (!topic.empty()) {
      const auto found = recording_.find_topic(topic);
      if (found && survey_.infos.contains(*found)) return found;
      fail(fmt::format("has no camera info on {}", topic),
           fmt::format("give another {}; there is {}", option, info_topics()));
    }
    const std::string camera = camera_of_topic(image.name);
    for (const char* leaf : {"/camera_info", "/info/camera_info"}) {
      const auto found = recording_.find_topic(camera + leaf);
      if (found && survey_.infos.contains(*found)) return found;
    }
    return info_by_frame(image);
  }

  /// Another camera's info may be of the same frame and size: of the colour image for registered depth.
  std::optional<int> info_by_frame(const ImageSample& image) const {
    std::optional<int> found;
    for (const auto& [topic, data] : survey_.infos) {
      const auto info =
          read_camera_info_message(recording_.topics()[static_cast<std::size_t>(topic)].serialisation, data);
      const bool same_size = info && info->width == static_cast<std::uint32_t>(image.size.width) &&
                             info->height == static_cast<std::uint32_t>(image.size.height);
      if (!same_size || (info->header.frame != image.frame && survey_.infos.size() > 1)) continue;
      if (found) return std::nullopt;
      found = topic;
    }
    return found;
  }

  std::string info_topics() const {
    std::string names;
    for (const auto& [topic, data] : survey_.infos) {
      names += (names.empty() ? "" : ", ") + recording_.topics()[static_cast<std::size_t>(topic)].name;
    }
    return names.empty() ? "none" : names;
  }

  std::optional<int> choose_imu() const {
    if (!options_.imu_topic.empty()) {
      const auto found = recording_.find_topic(options_.imu_topic);
      if (found && recording_.topics()[static_cast<std::size_t>(*found)].type == "sensor_msgs/Imu")
        return found;
      fail(fmt::format("has no topic {} with sensor_msgs/Imu", options_.imu_topic), "give another --imu");
    }
    std::optional<int> only;
    for (std::size_t i = 0; i < recording_.topics().size(); ++i) {
      const RecordedTopic& topic = recording_.topics()[i];
      // RealSense's own recordings have one topic for each half of the sensor.
      if (topic.type != "sensor_msgs/Imu" || topic.name.ends_with("/imu/data")) continue;
      if (only) return std::nullopt;
      only = static_cast<int>(i);
    }
    return only;
  }

  std::optional<int> choose_truth() const {
    if (!options_.truth_topic.empty()) {
      const auto found = recording_.find_topic(options_.truth_topic);
      if (found) {
        const std::string& type = recording_.topics()[static_cast<std::size_t>(*found)].type;
        if (is_pose_type(type) || is_transforms_type(type)) return found;
      }
      fail(fmt::format("has no topic {} with poses", options_.truth_topic),
           "give another --truth, of PoseStamped, Odometry, TransformStamped or TFMessage");
    }
    std::optional<int> only;
    for (std::size_t i = 0; i < recording_.topics().size(); ++i) {
      const RecordedTopic& topic = recording_.topics()[i];
      if (!is_pose_type(topic.type) || !is_named_truth(topic.name) || topic.count == std::uint64_t{0})
        continue;
      if (only) return std::nullopt;
      only = static_cast<int>(i);
    }
    return only;
  }

  const Recording& recording_;
  const RecordingSurvey& survey_;
  const SourceOptions& options_;
};

}  // namespace

TopicChoice choose_topics(const Recording& recording, const RecordingSurvey& survey,
                          const SourceOptions& options) {
  return Chooser(recording, survey, options).choose();
}

}  // namespace stdc
