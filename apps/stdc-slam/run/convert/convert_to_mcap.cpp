#include "run/convert/convert_to_mcap.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "atlas/storage/map_file.hpp"
#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/camera_file.hpp"
#include "input/recordings/containers/mcap_writer.hpp"
#include "input/recordings/messages/message_definitions.hpp"
#include "input/recordings/messages/ros2_messages.hpp"
#include "input/recordings/messages/stamp.hpp"
#include "input/recordings/topic_names.hpp"
#include "segmentation/mask_list.hpp"

namespace stdc::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCameraFrame = "camera_color_optical_frame";
constexpr const char* kMapFrame = "map";

/// Topics, each made when something is first written to it.
class McapTopics {
 public:
  explicit McapTopics(const fs::path& path) : writer_(path) {}

  void write(const std::string& name, const std::string& type, std::int64_t stamp,
             const ros2::Message& message) {
    auto found = topics_.find(name);
    if (found == topics_.end()) {
      found = topics_.emplace(name, writer_.add_topic(name, type, message_definition(type))).first;
    }
    writer_.write(found->second, stamp, message);
  }
  void commit() { writer_.commit(); }

 private:
  McapWriter writer_;
  std::map<std::string, std::uint16_t> topics_;
};

/// Metres, since 16 bits would be read as millimetres (REP 118), of which the input may have parts.
cv::Mat depth_to_write(const cv::Mat& depth, double units_per_metre) {
  constexpr double kMillimetres = 1000;
  if (depth.type() != CV_16UC1 || units_per_metre == kMillimetres) return depth;
  cv::Mat metres(depth.size(), CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    const auto* from = depth.ptr<std::uint16_t>(y);
    auto* to = metres.ptr<float>(y);
    for (int x = 0; x < depth.cols; ++x) to[x] = static_cast<float>(from[x] / units_per_metre);
  }
  return metres;
}

/// Once: the camera does not change.
void write_camera_file(const LoadedFrame& frame, const Camera& camera, McapTopics& topics) {
  topics.write(kCameraFileTopic, "std_msgs/msg/String", stamp_of_seconds(frame.timestamp),
               ros2::string_message(format_camera(camera)));
}

void write_frame(const LoadedFrame& frame, const Camera& camera, McapTopics& topics) {
  const std::int64_t stamp = stamp_of_seconds(frame.timestamp),
                     depth_stamp = stamp_of_seconds(frame.depth_timestamp);
  const ros2::Header header{stamp, kCameraFrame}, depth_header{depth_stamp, kCameraFrame};
  for (const ImuSample& sample : frame.imu) {
    const std::int64_t when = stamp_of_seconds(sample.timestamp);
    topics.write(
        "/camera/imu", "sensor_msgs/msg/Imu", when,
        ros2::imu_message({when, "camera_imu_optical_frame"}, sample.gyroscope, sample.acceleration));
  }
  const auto file = frame.packed->colour_file();
  if (file && (is_png(*file) || is_jpeg(*file))) {
    topics.write("/camera/color/image_raw/compressed", "sensor_msgs/msg/CompressedImage", stamp,
                 ros2::compressed_image_message(header, is_png(*file) ? "png" : "jpeg", *file));
  } else {
    topics.write("/camera/color/image_raw", "sensor_msgs/msg/Image", stamp,
                 ros2::image_message(header, frame.image->colour));
  }
  topics.write("/camera/color/camera_info", "sensor_msgs/msg/CameraInfo", stamp,
               ros2::camera_info_message(header, camera));
  topics.write(
      "/camera/aligned_depth_to_color/image_raw", "sensor_msgs/msg/Image", depth_stamp,
      ros2::image_message(depth_header, depth_to_write(frame.image->depth, camera.depth_units_per_metre)));
  topics.write("/camera/aligned_depth_to_color/camera_info", "sensor_msgs/msg/CameraInfo", depth_stamp,
               ros2::camera_info_message(depth_header, camera));
}

/// Results of a run, given out with the frames that they belong to.
class ResultMessages {
 public:
  explicit ResultMessages(const McapResults& results) {
    if (results.folder) read_trajectory_of(*results.folder);
    if (results.masks) masks_ = list_masks(*results.masks);
    if (results.map) read_landmarks(*results.map);
  }

  void write(double time, McapTopics& topics) {
    const std::int64_t stamp = stamp_of_seconds(time);
    write_whole(stamp, topics);
    constexpr double kSame = 1e-4;  // [s]
    const auto pose = std::lower_bound(trajectory_.begin(), trajectory_.end(), time - kSame,
                                       [](const StampedPose& p, double t) { return p.timestamp < t; });
    if (pose != trajectory_.end() && pose->timestamp < time + kSame) {
      const std::array transform{ros2::Transform{{stamp, kMapFrame}, kCameraFrame, pose->world_from_cam}};
      topics.write("/tf", "tf2_msgs/msg/TFMessage", stamp, ros2::transforms_message(transform));
    }
    const MaskFile* mask = find_mask(masks_, time, kSame);
    if (mask == nullptr) return;
    topics.write("/stdc_slam/dynamic_mask/compressed", "sensor_msgs/msg/CompressedImage", stamp,
                 ros2::compressed_image_message({stamp, kCameraFrame}, "png", read_bytes(mask->path)));
  }

 private:
  void read_trajectory_of(const fs::path& folder) {
    trajectory_ = read_trajectory(folder / "trajectory.txt");
  }

  void read_landmarks(const fs::path& path) {
    const StoredMap map = load_map(path);
    for (const LandmarkId id : map.atlas.landmark_ids())
      landmarks_.push_back(map.atlas.landmark(id).position);
  }

  static std::vector<std::uint8_t> read_bytes(const fs::path& path) {
    const std::string bytes = read_file(path, "give the folder of run --save-masks");
    return {bytes.begin(), bytes.end()};
  }

  /// What stays as it is: at the first frame.
  void write_whole(std::int64_t stamp, McapTopics& topics) {
    if (wrote_whole_) return;
    wrote_whole_ = true;
    if (!trajectory_.empty()) {
      std::vector<ros2::StampedPathPose> path;
      for (const StampedPose& pose : trajectory_)
        path.push_back({stamp_of_seconds(pose.timestamp), pose.world_from_cam});
      topics.write("/stdc_slam/path", "nav_msgs/msg/Path", stamp,
                   ros2::path_message({stamp, kMapFrame}, path));
    }
    if (!landmarks_.empty()) {
      topics.write("/stdc_slam/landmarks", "sensor_msgs/msg/PointCloud2", stamp,
                   ros2::cloud_message({stamp, kMapFrame}, landmarks_));
    }
  }

  Trajectory trajectory_;
  std::vector<MaskFile> masks_;
  std::vector<Eigen::Vector3d> landmarks_;
  bool wrote_whole_ = false;
};

void write_true_poses(const SequenceInput& input, McapTopics& topics) {
  if (!input.truth()) return;
  for (const StampedPose& pose : *input.truth()) {
    const std::int64_t stamp = stamp_of_seconds(pose.timestamp);
    topics.write("/ground_truth/pose", "geometry_msgs/msg/PoseStamped", stamp,
                 ros2::pose_message({stamp, "world"}, pose.world_from_cam));
  }
}

void check_mcap_place(const SequenceInput& input, const fs::path& path, bool overwrite) {
  std::error_code problem;
  if (fs::equivalent(path, input.source().where(), problem))
    throw Error(path.string(), "is the input itself", "give another --output");
  if (fs::exists(path, problem) && !overwrite)
    throw Error(path.string(), "is there already", "choose another --output, or give --overwrite");
}

}  // namespace

ConvertReport convert_to_mcap(const SequenceInput& input, const fs::path& path, bool overwrite,
                              const McapResults& results, bool quiet, const InterruptWatch& interrupts) {
  check_mcap_place(input, path, overwrite);
  ResultMessages result_messages(results);
  McapTopics topics(path);
  const bool has_more_than_info = input.camera.readout_time != 0 || input.camera.rotation != 0;
  const ConvertReport report =
      convert_frames(input, quiet, interrupts, [&](const LoadedFrame& frame, ConvertReport& so_far) {
        if (has_more_than_info && so_far.frames == 0) write_camera_file(frame, input.camera, topics);
        write_frame(frame, input.camera, topics);
        result_messages.write(frame.timestamp, topics);
      });
  write_true_poses(input, topics);
  topics.commit();
  return report;
}

}  // namespace stdc::app
