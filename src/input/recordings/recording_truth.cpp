#include "input/recordings/recording_truth.hpp"

#include <algorithm>
#include <array>

#include "input/recordings/ros_messages.hpp"
#include "input/recordings/stamp.hpp"

namespace stdc {

namespace {

class TruthReader {
 public:
  TruthReader(const TransformTree& transforms, const std::string& camera_frame)
      : transforms_(transforms), camera_frame_(camera_frame), root_(transforms.root_of(camera_frame)) {}

  void take(const RecordedTopic& topic, Bytes data) {
    if (is_transforms_type(topic.type)) {
      take_transforms(topic, data);
      return;
    }
    ++truth_.rows;
    const auto pose = read_pose_message(topic.type, topic.serialisation, data);
    if (!pose) {
      ++(read_message_header(topic.serialisation, data) ? truth_.without_pose : truth_.malformed);
      return;
    }
    const auto body_from_camera =
        pose->child.empty() ? std::nullopt : transforms_.find(pose->child, camera_frame_);
    add(pose->header.stamp, pose->pose * body_from_camera.value_or(Pose()));
  }

  GroundTruth finish() {
    std::stable_sort(truth_.poses.begin(), truth_.poses.end(),
                     [](const StampedPose& a, const StampedPose& b) { return a.timestamp < b.timestamp; });
    const auto end =
        std::unique(truth_.poses.begin(), truth_.poses.end(),
                    [](const StampedPose& a, const StampedPose& b) { return a.timestamp == b.timestamp; });
    truth_.repeated = static_cast<int>(truth_.poses.end() - end);
    truth_.poses.erase(end, truth_.poses.end());
    return std::move(truth_);
  }

 private:
  void take_transforms(const RecordedTopic& topic, Bytes data) {
    const auto transforms = read_transforms_message(topic.serialisation, data);
    if (!transforms) {
      ++truth_.rows, ++truth_.malformed;
      return;
    }
    for (const TransformMessage& t : *transforms) {
      if (plain_frame(t.header.frame) != root_) continue;
      const auto body_from_camera = transforms_.find(t.child, camera_frame_);
      if (!body_from_camera) continue;
      ++truth_.rows;
      add(t.header.stamp, t.parent_from_child * *body_from_camera);
    }
  }

  void add(std::int64_t stamp, const Pose& pose) { truth_.poses.push_back({seconds_of(stamp), pose}); }

  const TransformTree& transforms_;
  const std::string& camera_frame_;
  std::string root_;
  GroundTruth truth_;
};

}  // namespace

GroundTruth read_recorded_truth(Recording& recording, int topic, const TransformTree& transforms,
                                const std::string& camera_frame) {
  TruthReader reader(transforms, camera_frame);
  recording.start(std::array{topic});
  while (const auto message = recording.next()) {
    reader.take(recording.topics()[static_cast<std::size_t>(topic)], message->data);
  }
  return reader.finish();
}

}  // namespace stdc
