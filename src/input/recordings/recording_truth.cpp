#include "input/recordings/recording_truth.hpp"

#include <algorithm>
#include <array>

#include "input/recordings/messages/ros_messages.hpp"
#include "input/recordings/messages/stamp.hpp"
#include "input/recordings/recording_survey.hpp"

namespace stdc {
namespace {

void put_in_order(GroundTruth& truth) {
  std::stable_sort(truth.poses.begin(), truth.poses.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.timestamp < b.timestamp; });
  const auto end =
      std::unique(truth.poses.begin(), truth.poses.end(),
                  [](const StampedPose& a, const StampedPose& b) { return a.timestamp == b.timestamp; });
  truth.repeated = static_cast<int>(truth.poses.end() - end);
  truth.poses.erase(end, truth.poses.end());
}

/// The transforms of a topic that lead from the tree's root towards the camera.
GroundTruth truth_of_transforms(Recording& recording, int topic, const TransformTree& transforms,
                                const std::string& camera_frame) {
  GroundTruth truth;
  const std::string root = transforms.root_of(camera_frame);
  const Serialisation serialisation = recording.topics().at(static_cast<std::size_t>(topic)).serialisation;
  recording.start(std::array{topic});
  while (const auto message = recording.next()) {
    const auto list = read_transforms_message(serialisation, message->data);
    if (!list) ++truth.rows, ++truth.malformed;
    for (const TransformMessage& t : list.value_or(std::vector<TransformMessage>())) {
      if (plain_frame(t.header.frame) != root) continue;
      const auto body_from_camera = transforms.find(t.child, camera_frame);
      if (!body_from_camera) continue;
      ++truth.rows;
      truth.poses.push_back({seconds_of(t.header.stamp), t.parent_from_child * *body_from_camera});
    }
  }
  put_in_order(truth);
  return truth;
}

}  // namespace

void RecordedTruth::take(const RecordedTopic& topic, Bytes message) {
  ++counts_.rows;
  const auto pose = read_pose_message(topic.type, topic.serialisation, message);
  if (!pose) {
    ++(read_message_header(topic.serialisation, message) ? counts_.without_pose : counts_.malformed);
    return;
  }
  if (rows_.empty()) child_ = pose->child;
  rows_.push_back({pose->header.stamp, pose->pose});
}

GroundTruth RecordedTruth::trajectory(const TransformTree& transforms,
                                      const std::string& camera_frame) const {
  GroundTruth truth = counts_;
  const Pose body_from_camera =
      child_.empty() ? Pose() : transforms.find(child_, camera_frame).value_or(Pose());
  for (const Row& row : rows_) truth.poses.push_back({seconds_of(row.stamp), row.pose * body_from_camera});
  put_in_order(truth);
  return truth;
}

GroundTruth read_recorded_truth(Recording& recording, int topic, const std::string& camera_frame) {
  const RecordedTopic& recorded = recording.topics().at(static_cast<std::size_t>(topic));
  if (is_transforms_type(recorded.type)) {
    return truth_of_transforms(recording, topic, read_transforms(recording), camera_frame);
  }
  RecordedTruth truth;
  recording.start(std::array{topic});
  while (const auto message = recording.next()) truth.take(recorded, message->data);
  return truth.trajectory(truth.names_what_moves() ? read_transforms(recording) : TransformTree(),
                          camera_frame);
}

}  // namespace stdc
