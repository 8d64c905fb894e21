#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <thread>

#include "commands.hpp"
#include "listener.hpp"
#include "messages.h"
#include "peer.hpp"
#include "played_images.hpp"

namespace stdc::ros2_peer {
namespace {

constexpr double kPatience = 120;  // [s], for whatever the other side has to do

char* text_of(std::string& text) { return text.data(); }

builtin_interfaces_msg_dds__Time_ time_of(std::int64_t stamp) {
  return {static_cast<std::int32_t>(stamp / 1'000'000'000),
          static_cast<std::uint32_t>(stamp % 1'000'000'000)};
}

/// Publishes colour, depth, camera info and the static transform of one camera.
class Camera {
 public:
  Camera(const Participant& participant, const std::vector<std::string>& words, const PlayedImages& images)
      : images_(images) {
    const Service service{!has(words, "--best-effort"), false, has(words, "--lossless") ? 0 : 5};
    const std::string name = value_of(words, "--camera", "/camera");
    colour_ = participant.writer(sensor_msgs_msg_dds__Image__desc, name + "/color/image_raw", service);
    depth_ = participant.writer(
        sensor_msgs_msg_dds__Image__desc,
        name + (has(words, "--raw-depth") ? "/depth/image_raw" : "/aligned_depth_to_color/image_raw"),
        service);
    info_ = participant.writer(sensor_msgs_msg_dds__CameraInfo__desc, name + "/color/camera_info", service);
    depth_info_ =
        participant.writer(sensor_msgs_msg_dds__CameraInfo__desc, name + "/depth/camera_info", service);
    static_ = participant.writer(tf2_msgs_msg_dds__TFMessage__desc, "/tf_static", {true, true, 1});
    separate_depth_ = has(words, "--raw-depth");
  }

  /// Whether somebody receives colour and depth.
  bool connected() const {
    dds_publication_matched_status_t a, b;
    return dds_get_publication_matched_status(colour_, &a) == DDS_RETCODE_OK && a.current_count > 0 &&
           dds_get_publication_matched_status(depth_, &b) == DDS_RETCODE_OK && b.current_count > 0;
  }

  void send_colour(const PlayedImages::Frame& frame, std::int64_t shift) {
    send_info(info_, frame.colour_stamp + shift, colour_frame_);
    if (separate_depth_) send_info(depth_info_, frame.depth_stamp + shift, depth_frame_);
    send_image(colour_, frame.colour, frame.colour_stamp + shift, colour_frame_,
               frame.colour.channels() == 3 ? rgb8_ : mono8_);
  }
  void send_depth(const PlayedImages::Frame& frame, std::int64_t shift) {
    send_image(depth_, frame.depth, frame.depth_stamp + shift, separate_depth_ ? depth_frame_ : colour_frame_,
               depth16_);
  }
  /// base_link stands 10 cm behind and 20 cm below the camera, which looks forward.
  void send_static() {
    geometry_msgs_msg_dds__TransformStamped_ transforms[2] = {};
    set(transforms[0], base_frame_, colour_frame_, {0.1, 0, 0.2}, {-0.5, 0.5, -0.5, 0.5});
    set(transforms[1], colour_frame_, depth_frame_, {0, 0, 0}, {0, 0, 0, 1});
    tf2_msgs_msg_dds__TFMessage_ message = {};
    message.transforms_ = {2, 2, transforms, false};
    check(dds_write(static_, &message), "tf_static");
  }

 private:
  static void set(geometry_msgs_msg_dds__TransformStamped_& transform, std::string& parent,
                  std::string& child, const std::array<double, 3>& t, const std::array<double, 4>& q) {
    transform.header_.frame_id_ = text_of(parent);
    transform.child_frame_id_ = text_of(child);
    transform.transform_.translation_ = {t[0], t[1], t[2]};
    transform.transform_.rotation_ = {q[0], q[1], q[2], q[3]};
  }

  void send_image(dds_entity_t writer, const cv::Mat& image, std::int64_t stamp, std::string& frame,
                  std::string& encoding) {
    sensor_msgs_msg_dds__Image_ message = {};
    message.header_.stamp_ = time_of(stamp);
    message.header_.frame_id_ = text_of(frame);
    message.height_ = static_cast<std::uint32_t>(image.rows);
    message.width_ = static_cast<std::uint32_t>(image.cols);
    message.encoding_ = text_of(encoding);
    message.step_ = static_cast<std::uint32_t>(image.step);
    const auto size = static_cast<std::uint32_t>(image.step * static_cast<std::size_t>(image.rows));
    message.data_ = {size, size, image.data, false};
    check(dds_write(writer, &message), "image");
  }

  void send_info(dds_entity_t writer, std::int64_t stamp, std::string& frame) {
    const stdc::Camera& camera = images_.camera;
    sensor_msgs_msg_dds__CameraInfo_ message = {};
    message.header_.stamp_ = time_of(stamp);
    message.header_.frame_id_ = text_of(frame);
    message.height_ = static_cast<std::uint32_t>(camera.height);
    message.width_ = static_cast<std::uint32_t>(camera.width);
    message.distortion_model_ = text_of(plumb_bob_);
    double d[5] = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3};
    message.D_ = {5, 5, d, false};
    message.K_[0] = camera.fx, message.K_[2] = camera.cx, message.K_[4] = camera.fy,
    message.K_[5] = camera.cy;
    message.K_[8] = 1;
    message.R_[0] = message.R_[4] = message.R_[8] = 1;
    message.P_[0] = camera.fx, message.P_[2] = camera.cx, message.P_[5] = camera.fy,
    message.P_[6] = camera.cy;
    message.P_[10] = 1;
    check(dds_write(writer, &message), "camera info");
  }

  const PlayedImages& images_;
  dds_entity_t colour_, depth_, info_, depth_info_, static_;
  bool separate_depth_ = false;
  std::string colour_frame_ = "camera_color_optical_frame", depth_frame_ = "camera_depth_optical_frame",
              base_frame_ = "base_link", rgb8_ = "rgb8", mono8_ = "mono8", depth16_ = "16UC1",
              plumb_bob_ = "plumb_bob";
};

template <typename Condition>
bool wait_until(const Condition& condition, double seconds) {
  const Clock::time_point start = Clock::now();
  while (!condition()) {
    if (seconds_since(start) > seconds) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

/// With depth as ROS has it (REP 118).
PlayedImages in_millimetres(PlayedImages images) {
  for (PlayedImages::Frame& frame : images.frames) {
    cv::Mat depth;
    frame.depth.convertTo(depth, CV_16U, 1000 / images.camera.depth_units_per_metre);
    frame.depth = depth;
  }
  return images;
}

/// When each colour image was sent, by its stamp: latency is counted from the later image of the pair.
using Sent = std::map<std::int64_t, Clock::time_point>;

/// Sends all images in the order of their stamps.
void send_all(const PlayedImages& images, double rate, std::int64_t shift, Camera& camera, Sent& sent) {
  const Clock::time_point start = Clock::now();
  double due = 0;
  for (const PlayedImages::Frame& frame : images.frames) {
    if (rate > 0) {
      std::this_thread::sleep_until(
          start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(due)));
      due += 1 / rate;
    }
    const bool colour_first = frame.colour_stamp <= frame.depth_stamp;
    if (colour_first) camera.send_colour(frame, shift);
    camera.send_depth(frame, shift);
    if (!colour_first) camera.send_colour(frame, shift);
    sent[frame.colour_stamp + shift] = Clock::now();
  }
}

void report(const Listener& listener, const Sent& sent, double seconds) {
  std::vector<double> latencies;
  for (const auto& [stamp, came] : listener.arrivals()) {
    if (const auto found = sent.find(stamp); found != sent.end()) {
      latencies.push_back(1e3 * std::chrono::duration<double>(came - found->second).count());
    }
  }
  std::sort(latencies.begin(), latencies.end());
  const auto quantile = [&](double share) {
    return latencies.empty()
               ? 0.0
               : latencies[static_cast<std::size_t>(share * static_cast<double>(latencies.size() - 1))];
  };
  fmt::print(
      "sent {} frames in {:.2f} s, odometry of {}; latency p50 {:.1f} p95 {:.1f} p99 {:.1f} max {:.1f} ms\n",
      sent.size(), seconds, latencies.size(), quantile(0.5), quantile(0.95), quantile(0.99), quantile(1));
  fmt::print("{}\n", listener.counts());
}

void write(const std::string& path, const std::string& text) {
  if (!path.empty()) std::ofstream(path) << text;
}

}  // namespace

int play(const std::vector<std::string>& words) {
  const std::string size = value_of(words, "--size", "0x0");
  const PlayedImages as_they_are =
      read_images(words[1], std::stoi(value_of(words, "--frames", "0")),
                  {std::stoi(size.substr(0, size.find('x'))), std::stoi(size.substr(size.find('x') + 1))});
  const PlayedImages images = has(words, "--millimetres") ? in_millimetres(as_they_are) : as_they_are;
  const Participant participant(domain());
  Camera camera(participant, words, images);
  Listener listener(participant);
  camera.send_static();
  // A recorder publishes nothing: it has all once it stops listening.
  const bool to_recorder = has(words, "--to-recorder");
  if (!wait_until([&] { return camera.connected() && (to_recorder || listener.connected()); }, kPatience)) {
    fmt::print(stderr, "ros2_peer: nobody listens\n");
    return 1;
  }
  const double rate = std::stod(value_of(words, "--rate", "0"));
  const int loops = std::stoi(value_of(words, "--loops", "1"));
  const std::int64_t shift = std::stoll(value_of(words, "--shift", "0")) * 1'000'000'000;
  const std::int64_t length =
      images.frames.back().colour_stamp - images.frames.front().colour_stamp + 33'000'000;
  Sent sent;
  const Clock::time_point start = Clock::now();
  for (int i = 0; i < loops; ++i) send_all(images, rate, shift + i * length, camera, sent);
  const double seconds = seconds_since(start);
  const std::int64_t last = sent.rbegin()->first;
  const double patience = std::stod(value_of(words, "--patience", fmt::format("{}", kPatience)));
  // The last frame may wait for a depth image that is nearer.
  const int awaited = std::stoi(value_of(words, "--await", "0"));
  const auto arrived = [&] {
    if (to_recorder) return !camera.connected();
    return awaited > 0 ? listener.odometry_count() >= awaited : listener.last_stamp() >= last;
  };
  const bool all = wait_until(arrived, patience);
  // Diagnostics and what comes once a second.
  std::this_thread::sleep_for(std::chrono::duration<double>(std::stod(value_of(words, "--linger", "0"))));
  report(listener, sent, seconds);
  write(value_of(words, "--odometry", ""), listener.odometry());
  write(value_of(words, "--tf", ""), listener.transforms());
  write(value_of(words, "--diagnostics", ""), listener.diagnostics());
  return all ? 0 : 3;
}

}  // namespace stdc::ros2_peer
