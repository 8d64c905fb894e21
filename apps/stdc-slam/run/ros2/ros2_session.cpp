#include "run/ros2/ros2_session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "report/pictures/debug_images.hpp"
#include "run/output_folder.hpp"
#include "run/run_trajectories.hpp"

namespace stdc::app {
namespace {

std::int64_t now_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

std::int64_t nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

}  // namespace

Ros2Session::Ros2Session(const Parts& parts, const Camera& camera, const Settings& settings,
                         LiveSlam::MakeSegmenter make_segmenter)
    : parts_(parts),
      live_(camera, settings, std::move(make_segmenter), parts.options.load_map),
      features_(settings.features) {}

bool Ros2Session::find_mount() {
  const auto mount = parts_.source.transforms().find(parts_.options.names.base, parts_.source.image_frame());
  if (mount) robot_.emplace(*mount);
  return mount.has_value();
}

void Ros2Session::assume_mount() {
  robot_.emplace(ros2::body_from_optical());
  parts_.publisher.publish_mount(now_ns(), parts_.source.image_frame(), ros2::body_from_optical());
}

void Ros2Session::track(const LoadedFrame& frame) {
  constexpr double kRestart = 1;  // [s] back in time, as the source has it
  if (last_time_ && frame.timestamp < *last_time_ - kRestart)
    begin_anew("the stamps of the images began anew");
  last_time_ = frame.timestamp;
  if (frame.error) status_.add_unreadable(frame.error->what());
  Slam& slam = live_.slam();
  const TrackingResult result = frame.image ? slam.track(*frame.image) : slam.skip(frame.timestamp);
  const std::int64_t stamp = parts_.source.stamp_of(frame.timestamp);
  last_stamp_ = stamp;
  if (has_pose(result.status)) {
    publish_pose(stamp, result);
  } else {
    robot_->lose();
    last_located_.reset();
  }
  std::optional<double> latency;
  if (const auto arrival = parts_.source.arrival_of(frame.timestamp); arrival && has_pose(result.status)) {
    latency = std::chrono::duration<double, std::milli>(Clock::now() - *arrival).count();
  }
  status_.add(result, latency);
  if (parts_.options.output) record_.add(result);
  if (frame.image) publish_images(stamp, *frame.image, frame.index, result);
  for (FrameObserver* observer : observers_) {
    observer->on_frame({frame.index, frame.image ? &*frame.image : nullptr, result, frame.packed});
  }
}

/// Both poses as the map has them now: a correction between the two frames is no motion.
ros2::LocatedFrame Ros2Session::located(const TrackingResult& result) const {
  ros2::LocatedFrame frame{result.timestamp, *result.cam_from_world, result.map,
                           result.covariance.value_or(1e6 * Matrix6d::Identity()), std::nullopt};
  for (const FramePose& pose : live_.slam().latest_poses(2)) {
    if (pose.map != result.map) continue;
    if (pose.timestamp == result.timestamp) frame.cam_from_world = pose.world_from_cam.inverse();
    if (pose.timestamp == last_located_) frame.last_cam_from_world = pose.world_from_cam.inverse();
  }
  return frame;
}

void Ros2Session::publish_pose(std::int64_t stamp, const TrackingResult& result) {
  parts_.publisher.publish_pose(stamp, robot_->advance(located(result)));
  last_located_ = result.timestamp;
  map_ = result.map;
}

void Ros2Session::publish_images(std::int64_t stamp, const RgbdImage& image, int number,
                                 const TrackingResult& result) {
  const std::string frame = parts_.source.image_frame();
  if (parts_.options.publish_mask && parts_.publisher.mask_is_wanted()) {
    const cv::Mat none(image.colour.size(), CV_8UC1, cv::Scalar(0));
    parts_.publisher.publish_mask(stamp, frame, result.dynamic_mask.empty() ? none : result.dynamic_mask);
  }
  if (parts_.options.publish_debug_image && parts_.publisher.debug_image_is_wanted()) {
    parts_.publisher.publish_debug_image(stamp, frame, draw_keypoints(image.colour, number, result));
  }
}

void Ros2Session::publish_map() {
  if (!robot_ || last_stamp_ == 0) return;
  const Slam& slam = live_.slam();
  if (parts_.publisher.path_is_wanted()) {
    std::vector<ros2::StampedPathPose> path;
    for (const FramePose& pose : slam.keyframe_trajectory()) {
      if (pose.map != map_) continue;
      path.push_back({nanoseconds(pose.timestamp), robot_->map_from_base(pose.world_from_cam.inverse())});
    }
    parts_.publisher.publish_path(last_stamp_, path);
  }
  if (parts_.publisher.landmarks_are_wanted()) {
    std::vector<Eigen::Vector3d> points = slam.landmark_positions(map_);
    for (Eigen::Vector3d& point : points) point = robot_->map_from_world() * point;
    parts_.publisher.publish_landmarks(last_stamp_, points);
  }
}

void Ros2Session::attend() {
  for (const ros2::Request request : ros2::kRequests) {
    if (parts_.requests.take(request)) answer(request);
  }
  constexpr std::chrono::seconds kInterval(1);
  if (Clock::now() < next_report_) return;
  next_report_ = Clock::now() + kInterval;
  publish_map();
  parts_.publisher.publish_diagnostics(now_ns(), status_.report(parts_.source));
}

/// What cannot be done is said, and is no reason to end.
void Ros2Session::answer(ros2::Request request) {
  std::string outcome;
  try {
    switch (request) {
      case ros2::Request::save_map:
        outcome = save_map();
        break;
      case ros2::Request::reset:
        begin_anew("asked for");
        outcome = "begun anew";
        break;
      case ros2::Request::start_localisation:
      case ros2::Request::start_mapping:
        live_.set_localisation_only(request == ros2::Request::start_localisation);
        outcome = live_.localisation_only() ? "the map stays as it is from now on" : "the map grows again";
        record_ = RunRecord();
        break;
    }
  } catch (const Error& error) {
    outcome = error.what();
  }
  outcome = fmt::format("{}: {}", ros2::request_name(request), outcome);
  status_.set_event(outcome);
  fmt::print(stderr, "stdc-slam: {}\n", outcome);
}

std::string Ros2Session::save_map() {
  if (!parts_.options.save_map) return "no file was given; start with --save-map FILE";
  if (live_.localisation_only()) return "not while the map stays as it is";
  live_.slam().save_map(*parts_.options.save_map);
  return "written to " + parts_.options.save_map->string();
}

void Ros2Session::begin_anew(const std::string& why) {
  live_.reset();
  record_ = RunRecord();
  robot_.emplace(robot_->map_from_world());
  last_time_.reset();
  last_located_.reset();
  const std::string event = fmt::format("a new map is begun: {}", why);
  status_.set_event(event);
  fmt::print(stderr, "stdc-slam: {}\n", event);
}

void Ros2Session::finish() {
  parts_.publisher.flush();
  Slam& slam = live_.slam();
  const std::vector<LoopReport> loops = slam.finish();
  for (const LoopReport& loop : loops) record_.add(loop);
  for (FrameObserver* observer : observers_) observer->on_end(loops);
  if (parts_.options.output) {
    OutputFolder output(*parts_.options.output);
    const std::vector<FramePose> poses =
        live_.localisation_only() ? record_.tracked_poses() : slam.trajectory();
    write_trajectories(by_map(poses, slam.keyframe_trajectory()), output);
    output.write("frames.csv", record_.frames_csv());
    output.commit();
  }
  const bool saves = parts_.options.save_map && !live_.localisation_only() && slam.keyframes() > 0;
  if (saves) slam.save_map(*parts_.options.save_map);
  if (parts_.options.quiet) return;
  fmt::print("{} frames, {} with a pose, {} dropped; latency {}\n", status_.frames(), status_.located(),
             parts_.source.dropped(), status_.latency_text());
  if (parts_.options.output) fmt::print("results: {}\n", parts_.options.output->string());
  if (saves) fmt::print("map: {}\n", parts_.options.save_map->string());
}

}  // namespace stdc::app
