#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "report/run_record.hpp"
#include "ros2/requests.hpp"
#include "ros2/robot_frames.hpp"
#include "run/frame_loader.hpp"
#include "run/frame_observer.hpp"
#include "run/live_slam.hpp"
#include "run/ros2/ros2_options.hpp"
#include "run/ros2/ros2_status.hpp"

namespace stdc::app {

/// One map being made, or used, in a ROS 2 system: tracks frames, publishes what comes of them, does what it
/// is asked for.
class Ros2Session {
 public:
  /// All must outlive it.
  struct Parts {
    const Ros2Options& options;
    const ros2::Ros2Source& source;
    ros2::SlamPublisher& publisher;
    ros2::Requests& requests;
  };
  Ros2Session(const Parts& parts, const Camera& camera, const Settings& settings,
              LiveSlam::MakeSegmenter make_segmenter);

  /// Somebody else who wants to see each frame; must outlive the session.
  void add_observer(FrameObserver& observer) { observers_.push_back(&observer); }
  /// Finds how the camera is mounted on the robot, by /tf_static; false if that does not say it yet.
  bool find_mount();
  /// Takes it to be at the base's place, looking forward, and publishes that.
  void assume_mount();

  void track(const LoadedFrame& frame);
  /// Requests, and what is published once a second: to be called often.
  void attend();
  /// Ends as a run does: the map is saved, results are written. Says so on stdout.
  void finish();

  const Ros2Status& status() const { return status_; }
  /// The present one: another after it was begun anew.
  const Slam& slam() const { return live_.slam(); }

 private:
  using Clock = std::chrono::steady_clock;

  void publish_pose(std::int64_t stamp, const TrackingResult& result);
  void publish_images(std::int64_t stamp, const RgbdImage& image, int number, const TrackingResult& result);
  void publish_map();
  void answer(ros2::Request request);
  std::string save_map();
  void begin_anew(const std::string& why);
  ros2::LocatedFrame located(const TrackingResult& result) const;

  Parts parts_;
  LiveSlam live_;
  FeatureSettings features_;
  std::optional<ros2::RobotFrames> robot_;
  Ros2Status status_;
  RunRecord record_;
  std::vector<FrameObserver*> observers_;
  std::optional<double> last_time_, last_located_;  ///< of frames [s]
  MapId map_{0};                                    ///< of the last pose
  std::int64_t last_stamp_ = 0;
  Clock::time_point next_report_ = Clock::now();
};

}  // namespace stdc::app
