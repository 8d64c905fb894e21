#include "ros2/ros2_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "input/recordings/messages/ros_messages.hpp"
#include "input/recordings/messages/stamp.hpp"

namespace stdc::ros2 {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::int64_t kRestart = 1'000'000'000;  // [ns] back in time: the publisher began anew
constexpr std::size_t kMaxWaiting = 60;           // images without a partner
constexpr std::size_t kMaxWaitingBytes = std::size_t{96} << 20U;
/// Frames that wait where none may be lost: what the publisher sends ahead.
constexpr std::size_t kFramesAhead = 8;
/// The same until tracking begins: the cameras are looked for by the first frames.
constexpr std::size_t kFirstFrames = 15;

std::size_t frames_that_wait(const Ros2SourceOptions& options) {
  const auto wanted = static_cast<std::size_t>(std::max(options.max_waiting, 1));
  return options.reception == Reception::every_frame ? std::max(wanted, kFramesAhead) : wanted;
}

std::unique_ptr<StampPairing> make_pairing(const Ros2SourceOptions& options) {
  const auto tolerance = static_cast<std::int64_t>(1e9 * options.max_difference);
  const bool live = options.reception != Reception::every_frame;
  return std::make_unique<StampPairing>(tolerance, live ? tolerance / 2 : 0);
}

Delivery image_delivery(Reception reception) {
  Delivery delivery = kSensorData;
  delivery.reliable = reception != Reception::best_effort;
  delivery.large = true;
  if (reception == Reception::every_frame) delivery.depth = 0;
  return delivery;
}

}  // namespace

Ros2Source::Ros2Source(Node& node, const Ros2SourceOptions& options)
    : node_(node),
      options_(options),
      queue_(frames_that_wait(options), std::max(frames_that_wait(options), kFirstFrames)),
      search_(topics_by_stream(options.topics)),
      pairing_(make_pairing(options)) {
  const auto topic = [&](const std::string& name) {
    return std::make_shared<ImageTopic>(ImageTopic{where(), name, Serialisation::cdr, is_compressed(name)});
  };
  colour_topic_ = topic(options.topics.colour);
  depth_topic_ = topic(options.topics.depth);
  subscribe(options.topics);
  thread_ = std::thread([this] { work(); });
}

Ros2Source::~Ros2Source() {
  stop();
  thread_.join();
  subscriptions_.clear();  // its calls end before what they use goes
}

void Ros2Source::subscribe(const CameraTopics& topics) {
  // Called by threads of the middleware, which hold locks of its own: nothing is taken there.
  const auto wake = [this] {
    {
      const std::lock_guard lock(mutex_);
      news_ = true;
    }
    changed_.notify_all();
  };
  const std::vector<CameraSearch::Topic> all = topics_by_stream(topics);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto stream = static_cast<CameraStream>(i);
    Delivery delivery = image_delivery(options_.reception);
    if (stream == CameraStream::colour_info || stream == CameraStream::depth_info) delivery = kSensorData;
    if (stream == CameraStream::transforms)
      delivery = {.reliable = true, .transient_local = true, .depth = 100};
    subscriptions_.emplace_back(stream, node_.subscribe(all[i].name, all[i].type, delivery, wake));
  }
}

/// Only where no frame may be lost the publisher is made to wait.
bool Ros2Source::has_room() const {
  return options_.reception != Reception::every_frame || !queue_.is_full();
}

void Ros2Source::work() {
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stop_ || news_ || (images_wait_ && has_room()); });
      if (stop_) return;
      news_ = images_wait_ = false;
    }
    while (take_some()) {
    }
  }
}

bool Ros2Source::take_some() {
  bool some = false;
  for (const auto& [stream, subscription] : subscriptions_) {
    {
      const std::lock_guard lock(mutex_);
      if (stop_) return false;
      hand_on_pairs();  // those that there was no room for
      // Only images: what tells of the cameras may come after them, and is waited for.
      if ((stream == CameraStream::colour || stream == CameraStream::depth) && !has_room()) {
        images_wait_ = true;
        continue;
      }
    }
    // Without the lock: the middleware may be holding its own and wait for ours.
    if (auto message = subscription->take()) {
      some = true;
      add(stream, std::move(*message));
    }
  }
  return some;
}

void Ros2Source::add(CameraStream stream, std::vector<std::uint8_t> data) {
  const std::lock_guard lock(mutex_);
  if (!search_is_over_) search_.add(stream, data, Clock::now());
  if (stream == CameraStream::transforms) {
    const auto transforms = read_transforms_message(Serialisation::cdr, data);
    if (!transforms) ++counts_.damaged;
    for (const TransformMessage& t : transforms.value_or(std::vector<TransformMessage>())) {
      transforms_.add(t.header.frame, t.child, t.parent_from_child);
    }
  } else if (stream == CameraStream::colour || stream == CameraStream::depth) {
    add_image(stream, std::move(data));
  }
  changed_.notify_all();
}

void Ros2Source::add_image(CameraStream stream, std::vector<std::uint8_t> data) {
  const bool colour = stream == CameraStream::colour;
  ++(colour ? counts_.colour : counts_.depth);
  const auto header = read_message_header(Serialisation::cdr, data);
  if (!header) return void(++counts_.damaged);
  if (!goes_forward(stream, header->stamp)) return void(++counts_.backwards);
  if (colour && image_frame_ != header->frame) image_frame_ = header->frame;
  WaitingMessage waiting{header->stamp, std::make_shared<const std::vector<std::uint8_t>>(std::move(data))};
  colour ? pairing_->add_colour(std::move(waiting)) : pairing_->add_depth(std::move(waiting));
  hand_on_pairs();
  while (has_room() && (pairing_->waiting() > kMaxWaiting || pairing_->waiting_bytes() > kMaxWaitingBytes)) {
    pairing_->give_way();
    hand_on_pairs();
  }
}

/// Stamps that go back a little are disorder; those that go back far are a publisher that began anew.
bool Ros2Source::goes_forward(CameraStream stream, std::int64_t stamp) {
  std::optional<std::int64_t>& last = last_stamp_[static_cast<std::size_t>(stream)];
  if (last && stamp < *last - kRestart) {
    ++counts_.restarts;
    counts_.colour_without_depth += pairing_->colour_without_depth();
    pairing_ = make_pairing(options_);
    last_stamp_[0] = last_stamp_[1] = std::nullopt;
  } else if (last && stamp <= *last) {
    return false;
  }
  last = stamp;
  return true;
}

void Ros2Source::hand_on_pairs() {
  while (has_room()) {
    auto pair = pairing_->next();
    if (!pair) return;
    PackedMessage colour{colour_topic_, std::move(pair->first.data), pair->first.stamp};
    SourceFrame frame;
    frame.timestamp = seconds_of(colour.stamp);
    frame.depth_timestamp = seconds_of(pair->second.stamp);
    frame.name = stamp_text(colour.stamp);
    frame.where = colour.where();
    given_.add(frame.timestamp, colour.stamp, Clock::now());
    frame.images =
        pack_images(std::move(colour), {depth_topic_, std::move(pair->second.data), pair->second.stamp});
    queue_.push(std::move(frame));
  }
}

bool Ros2Source::wait_for_cameras(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto end = Clock::now() + patience;
  do {
    if (auto found = search_.find(Clock::now(), options_.camera_is_known)) {
      found_ = std::move(*found);
      search_is_over_ = true;
      return true;
    }
  } while (changed_.wait_until(lock, end) == std::cv_status::no_timeout && !stop_);
  return false;
}

std::optional<SourceFrame> Ros2Source::next() {
  auto frame = queue_.pop();
  { const std::lock_guard lock(mutex_); }  // who waits for room sees that there is some, or is woken
  changed_.notify_all();
  return frame;
}

void Ros2Source::rewind() { throw Error(where(), "cannot be gone through a second time", "record it first"); }

void Ros2Source::stop() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    pairing_->finish();  // who waits for a nearer partner gets the one that is there
    hand_on_pairs();
  }
  changed_.notify_all();
  queue_.close();
}

ReceptionCounts Ros2Source::counts() const {
  const std::lock_guard lock(mutex_);
  ReceptionCounts counts = counts_;
  counts.colour_without_depth += pairing_->colour_without_depth();
  counts.dropped = queue_.dropped();
  for (const auto& [stream, subscription] : subscriptions_) counts.lost += subscription->lost();
  return counts;
}

std::vector<std::string> Ros2Source::faults() const {
  const ReceptionCounts now = counts();
  std::vector<std::string> faults;
  const auto add = [&](int count, const char* what) {
    if (count > 0) faults.push_back(fmt::format("{}: {} {}", where(), count, what));
  };
  add(now.damaged, "messages were damaged and are left out");
  add(now.backwards, "images are left out: their stamps do not go forward");
  add(now.dropped, "frames came too late and are left out");
  return faults;
}

std::vector<std::string> Ros2Source::problems() const {
  std::vector<std::string> problems;
  const std::vector<PublishedTopic> published = node_.published();
  for (const auto& [stream, subscription] : subscriptions_) {
    const auto topic = topics_by_stream(options_.topics)[static_cast<std::size_t>(stream)];
    const bool needed = stream == CameraStream::colour || stream == CameraStream::depth ||
                        (stream == CameraStream::colour_info && !options_.camera_is_known);
    for (const PublishedTopic& other : published) {
      if (other.name != topic.name || other.type == topic.type) continue;
      problems.push_back(fmt::format("{} is published as {}, not as {}: such messages are not read",
                                     topic.name, other.type, topic.type));
    }
    if (const std::string policy = subscription->incompatibility();
        !policy.empty() && subscription->publishers() == 0) {
      problems.push_back(fmt::format("the publisher of {} offers another {}: give --reception best-effort",
                                     topic.name, policy));
    } else if (needed && subscription->publishers() == 0) {
      problems.push_back(fmt::format("nobody publishes {} ({})", topic.name, topic.type));
    } else if ((stream == CameraStream::colour || stream == CameraStream::depth) &&
               subscription->publishers() > 1) {
      problems.push_back(fmt::format("{} publishers share {}", subscription->publishers(), topic.name));
    }
  }
  const std::lock_guard lock(mutex_);
  const std::string missing = search_is_over_ ? "" : search_.missing(options_.camera_is_known);
  if (problems.empty() && !missing.empty()) problems.push_back("nothing has come yet on " + missing);
  return problems;
}

std::string Ros2Source::image_frame() const {
  const std::lock_guard lock(mutex_);
  return image_frame_;
}

TransformTree Ros2Source::transforms() const {
  const std::lock_guard lock(mutex_);
  return transforms_;
}

std::int64_t Ros2Source::stamp_of(double timestamp) const {
  const std::lock_guard lock(mutex_);
  return given_.stamp_of(timestamp);
}

std::optional<Clock::time_point> Ros2Source::arrival_of(double timestamp) const {
  const std::lock_guard lock(mutex_);
  return given_.arrival_of(timestamp);
}

}  // namespace stdc::ros2
