#include "listener.hpp"

#include <fmt/format.h>

#include "messages.h"

namespace stdc::ros2_peer {
namespace {

std::int64_t stamp_of(const builtin_interfaces_msg_dds__Time_& time) {
  return std::int64_t{time.sec_} * 1'000'000'000 + time.nanosec_;
}

/// Takes all samples of a reader, calls `use` with each.
template <typename Message, typename Use>
void take_all(dds_entity_t reader, const Use& use) {
  void* samples[16] = {nullptr};
  dds_sample_info_t infos[16];
  for (;;) {
    const int count = dds_take(reader, samples, infos, 16, 16);
    if (count <= 0) return;
    for (int i = 0; i < count; ++i) {
      if (infos[i].valid_data) use(*static_cast<const Message*>(samples[i]));
    }
    dds_return_loan(reader, samples, count);
  }
}

}  // namespace

Listener::Listener(const Participant& participant)
    : odometry_(
          participant.reader(nav_msgs_msg_dds__Odometry__desc, "/stdc_slam/odometry", {true, false, 0})),
      tf_(participant.reader(tf2_msgs_msg_dds__TFMessage__desc, "/tf", {true, false, 0})),
      diagnostics_(participant.reader(diagnostic_msgs_msg_dds__DiagnosticArray__desc, "/diagnostics",
                                      {true, false, 10})),
      path_(participant.reader(nav_msgs_msg_dds__Path__desc, "/stdc_slam/path", {true, false, 1})),
      landmarks_(participant.reader(sensor_msgs_msg_dds__PointCloud2__desc, "/stdc_slam/landmarks",
                                    {true, false, 1})),
      mask_(
          participant.reader(sensor_msgs_msg_dds__Image__desc, "/stdc_slam/dynamic_mask", {false, false, 5})),
      debug_(
          participant.reader(sensor_msgs_msg_dds__Image__desc, "/stdc_slam/debug_image", {false, false, 5})),
      thread_([this] { work(); }) {}

Listener::~Listener() {
  stop_ = true;
  thread_.join();
}

void Listener::work() {
  while (!stop_) {
    take_odometry();
    take_transforms();
    take_diagnostics();
    take_others();
    dds_sleepfor(DDS_MSECS(1));
  }
}

void Listener::take_odometry() {
  take_all<nav_msgs_msg_dds__Odometry_>(odometry_, [this](const auto& message) {
    const Clock::time_point now = Clock::now();
    const std::lock_guard lock(mutex_);
    const auto& p = message.pose_.pose_;
    const std::int64_t stamp = stamp_of(message.header_.stamp_);
    std::string covariance;
    for (int i = 0; i < 6; ++i) covariance += fmt::format(" {:.6g}", message.pose_.covariance_[7 * i]);
    odometry_lines_ += fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}{} {} {}\n",
                                   stamp, p.position_.x_, p.position_.y_, p.position_.z_, p.orientation_.x_,
                                   p.orientation_.y_, p.orientation_.z_, p.orientation_.w_, covariance,
                                   message.header_.frame_id_, message.child_frame_id_);
    last_stamp_ = stamp;
    arrivals_.try_emplace(stamp, now);
  });
}

void Listener::take_transforms() {
  take_all<tf2_msgs_msg_dds__TFMessage_>(tf_, [this](const auto& message) {
    const std::lock_guard lock(mutex_);
    for (std::uint32_t i = 0; i < message.transforms_._length; ++i) {
      const auto& t = message.transforms_._buffer[i];
      const auto& x = t.transform_.translation_;
      const auto& q = t.transform_.rotation_;
      tf_lines_ += fmt::format("{} {} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n",
                               stamp_of(t.header_.stamp_), t.header_.frame_id_, t.child_frame_id_, x.x_, x.y_,
                               x.z_, q.x_, q.y_, q.z_, q.w_);
    }
  });
}

void Listener::take_diagnostics() {
  take_all<diagnostic_msgs_msg_dds__DiagnosticArray_>(diagnostics_, [this](const auto& message) {
    const std::lock_guard lock(mutex_);
    for (std::uint32_t i = 0; i < message.status_._length; ++i) {
      const auto& status = message.status_._buffer[i];
      diagnostics_lines_ +=
          fmt::format("{} {}: {};", static_cast<int>(status.level_), status.name_, status.message_);
      for (std::uint32_t k = 0; k < status.values_._length; ++k) {
        diagnostics_lines_ +=
            fmt::format(" {}={};", status.values_._buffer[k].key_, status.values_._buffer[k].value_);
      }
      diagnostics_lines_ += "\n";
    }
  });
}

void Listener::take_others() {
  take_all<nav_msgs_msg_dds__Path_>(path_, [this](const auto& message) {
    const std::lock_guard lock(mutex_);
    ++paths_;
    poses_in_path_ = static_cast<int>(message.poses_._length);
  });
  take_all<sensor_msgs_msg_dds__PointCloud2_>(landmarks_, [this](const auto& message) {
    const std::lock_guard lock(mutex_);
    ++clouds_;
    points_ = static_cast<int>(message.width_);
  });
  const auto count = [this](int& counter) {
    return [this, &counter](const sensor_msgs_msg_dds__Image_& /*message*/) {
      const std::lock_guard lock(mutex_);
      ++counter;
    };
  };
  take_all<sensor_msgs_msg_dds__Image_>(mask_, count(masks_));
  take_all<sensor_msgs_msg_dds__Image_>(debug_, count(debug_images_));
}

int Listener::odometry_count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(arrivals_.size());
}

std::int64_t Listener::last_stamp() const {
  const std::lock_guard lock(mutex_);
  return last_stamp_;
}

bool Listener::connected() const {
  dds_subscription_matched_status_t status;
  if (dds_get_subscription_matched_status(odometry_, &status) != DDS_RETCODE_OK || status.current_count == 0)
    return false;
  const std::lock_guard lock(mutex_);
  return !diagnostics_lines_.empty();
}

std::string Listener::odometry() const {
  const std::lock_guard lock(mutex_);
  return odometry_lines_;
}

std::string Listener::transforms() const {
  const std::lock_guard lock(mutex_);
  return tf_lines_;
}

std::string Listener::diagnostics() const {
  const std::lock_guard lock(mutex_);
  return diagnostics_lines_;
}

std::string Listener::counts() const {
  const std::lock_guard lock(mutex_);
  return fmt::format(
      "paths {} (last of {} poses), landmarks {} (last of {} points), masks {}, debug images {}", paths_,
      poses_in_path_, clouds_, points_, masks_, debug_images_);
}

std::map<std::int64_t, Clock::time_point> Listener::arrivals() const {
  const std::lock_guard lock(mutex_);
  return arrivals_;
}

}  // namespace stdc::ros2_peer
