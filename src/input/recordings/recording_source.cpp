#include "input/recordings/recording_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "input/recordings/containers/packed_messages.hpp"
#include "input/recordings/forward_stamps.hpp"
#include "input/recordings/messages/ros_messages.hpp"
#include "input/recordings/messages/stamp.hpp"
#include "input/recordings/open_recording.hpp"
#include "input/recordings/recording_cameras.hpp"
#include "input/recordings/recording_truth.hpp"
#include "input/recordings/stamp_pairing.hpp"
#include "input/recordings/topic_choice.hpp"

namespace stdc {
namespace {

/// Messages of one kind may be recorded this much before those of the other with the same stamp.
constexpr std::size_t kMaxWaiting = 120;
constexpr std::size_t kMaxWaitingBytes = std::size_t{64} << 20U;
/// Colour images in a row without depth, after which there is no hope if there never was a pair.
constexpr int kHopeless = 100;

/// A little more than half a period: two cameras that are not triggered together jitter about the middle.
std::int64_t tolerance_of(const ImageSample& colour) {
  constexpr double kDefaultRate = 30, kMax = 50e6;  // [Hz], [ns]
  return static_cast<std::int64_t>(std::min(0.6e9 / rate_of(colour).value_or(kDefaultRate), kMax));
}

/// Throws Error if the stamps of both cannot be of one clock.
void check_clocks(const std::string& where, const ImageSample& colour, const ImageSample& depth) {
  constexpr std::int64_t kMax =
      2'000'000'000;  // [ns]: drivers and networks delay messages, but not that long
  const std::int64_t colour_delay = colour.log_time - colour.stamp,
                     depth_delay = depth.log_time - depth.stamp;
  if (std::abs(colour_delay - depth_delay) < kMax) return;
  throw Error(
      where,
      fmt::format(
          "the stamps of {} and {} have no common clock: they are {:.3f} s apart for images that were "
          "recorded {:.3f} s apart",
          colour.name, depth.name, 1e-9 * static_cast<double>(depth.stamp - colour.stamp),
          1e-9 * static_cast<double>(depth.log_time - colour.log_time)),
      "record with one clock for both, or choose other topics by --color and --depth");
}

class RecordingSource : public FrameSource {
 public:
  RecordingSource(const std::function<std::unique_ptr<Recording>()>& open, const SourceOptions& options)
      : open_(open), recording_(open()) {
    const RecordingSurvey survey = stdc::survey(*recording_);
    choice_ = choose_topics(*recording_, survey, options);
    const ImageSample& colour = *survey.find(topic(choice_.colour).name);
    const ImageSample& depth = *survey.find(topic(choice_.depth).name);
    use_log_times_ = colour.stamp == 0 || depth.stamp == 0;
    if (!use_log_times_) check_clocks(where(), colour, depth);
    tolerance_ = use_log_times_ ? 25'000'000 : tolerance_of(colour);
    found_ = find_cameras(*recording_, survey, choice_);
    colour_frame_ = colour.frame;
    colour_topic_ = image_topic(colour);
    depth_topic_ = image_topic(depth);
    notes_ = found_.notes;
    notes_.push_back(fmt::format("{}: colour from {}, depth from {}", where(), colour.name, depth.name));
    if (use_log_times_) {
      notes_.push_back(where() + ": the headers carry no stamps; the times of recording are taken");
    }
    streams_ = streams_of(*recording_, survey, choice_);
    rewind();
  }

  std::optional<SourceFrame> next() override {
    for (;;) {
      if (auto pair = pairing_->next()) {
        given_ = true;
        return frame_of(std::move(pair->first), std::move(pair->second));
      }
      if (ended_) {
        if (!given_ && pairing_->colour_without_depth() > 0) throw_no_pair();
        return std::nullopt;
      }
      if (!given_ && pairing_->colour_without_depth() >= kHopeless) throw_no_pair();
      read_on();
    }
  }

  void rewind() override {
    std::vector<int> topics{choice_.colour, choice_.depth};
    if (choice_.imu) topics.push_back(*choice_.imu);
    if (collects_truth()) topics.push_back(*choice_.truth);
    recording_->start(topics);
    pairing_ = std::make_unique<StampPairing>(tolerance_);
    forward_.clear();
    imu_.clear();
    truth_ = {};
    ended_ = given_ = false;
    damaged_ = 0;
  }

  /// How many pairs there are is known when the last one was made.
  std::optional<int> frame_count() const override { return std::nullopt; }

  std::optional<int> expected_frame_count() const override {
    const auto colour = topic(choice_.colour).count, depth = topic(choice_.depth).count;
    if (!colour || !depth) return std::nullopt;
    return static_cast<int>(std::min({*colour, *depth, std::uint64_t{1'000'000'000}}));
  }

  std::optional<RgbdCameras> cameras() const override { return found_.cameras; }
  std::string camera_hint() const override { return found_.hint; }

  /// At the end it has been read along with the images; before that the recording is gone through for it.
  std::optional<GroundTruth> ground_truth() const override {
    if (!choice_.truth) return std::nullopt;
    const bool collected = ended_ && collects_truth();
    if (collected && !truth_.names_what_moves()) return truth_.trajectory({}, colour_frame_);
    const std::unique_ptr<Recording> recording = open_();
    if (collected) return truth_.trajectory(read_transforms(*recording), colour_frame_);
    return read_recorded_truth(*recording, *choice_.truth, colour_frame_);
  }
  bool truth_comes_last() const override { return choice_.truth.has_value(); }
  std::string truth_where() const override {
    return choice_.truth ? fmt::format("{} ({})", where(), topic(*choice_.truth).name) : where();
  }

  std::string kind() const override { return recording_->format(); }
  std::string where() const override { return recording_->where(); }
  std::vector<StreamInfo> streams() const override { return streams_; }
  std::vector<std::string> notes() const override { return notes_; }
  int colour_without_depth() const override { return pairing_->colour_without_depth(); }

  std::vector<std::string> faults() const override {
    std::vector<std::string> faults = recording_->faults();
    for (const auto& [index, stamps] : forward_) {
      if (stamps.left_out() == 0) continue;
      faults.push_back(fmt::format("{}: {} images of {} are left out: their stamps do not go forward",
                                   where(), stamps.left_out(), topic(index).name));
    }
    if (damaged_ > 0)
      faults.push_back(fmt::format("{}: {} messages are damaged and left out", where(), damaged_));
    return faults;
  }

 private:
  const RecordedTopic& topic(int index) const {
    return recording_->topics()[static_cast<std::size_t>(index)];
  }

  /// Not of /tf, which holds much else.
  bool collects_truth() const { return choice_.truth && is_pose_type(topic(*choice_.truth).type); }

  std::shared_ptr<const ImageTopic> image_topic(const ImageSample& sample) const {
    return std::make_shared<ImageTopic>(
        ImageTopic{where(), sample.name, topic(sample.topic).serialisation, sample.compressed});
  }

  [[noreturn]] void throw_no_pair() const {
    const auto miss = pairing_->nearest_miss();
    throw Error(
        where(),
        fmt::format(
            "no image of {} lies within {:.0f} ms of one of {}{}", topic(choice_.depth).name,
            1e-6 * static_cast<double>(tolerance_), topic(choice_.colour).name,
            miss ? fmt::format(" (the nearest is {:.3f} s away)", 1e-9 * static_cast<double>(*miss)) : ""),
        "record with one clock for both, or choose other topics by --color and --depth");
  }

  /// Reads one message; decides what can be decided when no more can wait.
  void read_on() {
    const bool full = pairing_->waiting() > kMaxWaiting ||
                      (pairing_->waiting() > 8 && pairing_->waiting_bytes() > kMaxWaitingBytes);
    if (full) {
      pairing_->give_way();
      return;
    }
    const auto message = recording_->next();
    if (!message) {
      pairing_->finish();
      ended_ = true;
      return;
    }
    const RecordedTopic& recorded = topic(message->topic);
    if (choice_.imu && message->topic == *choice_.imu) {
      add_imu(recorded, *message);
      return;
    }
    if (choice_.truth && message->topic == *choice_.truth) {
      truth_.take(recorded, message->data);
      return;
    }
    const auto header = read_message_header(recorded.serialisation, message->data);
    if (!header) {
      ++damaged_;
      return;
    }
    const std::int64_t stamp = use_log_times_ ? message->log_time : header->stamp;
    if (!forward_[message->topic].passes(stamp)) return;
    WaitingMessage waiting{
        stamp, std::make_shared<const std::vector<std::uint8_t>>(message->data.begin(), message->data.end())};
    message->topic == choice_.colour ? pairing_->add_colour(std::move(waiting))
                                     : pairing_->add_depth(std::move(waiting));
  }

  void add_imu(const RecordedTopic& recorded, const RecordedMessage& message) {
    constexpr std::size_t kMaxImu = 100'000;
    auto sample = read_imu_message(recorded.serialisation, message.data);
    if (!sample) return void(++damaged_);
    if (use_log_times_) sample->timestamp = seconds_of(message.log_time);
    if (imu_.size() < kMaxImu) imu_.push_back(*sample);
  }

  SourceFrame frame_of(WaitingMessage colour, WaitingMessage depth) {
    PackedMessage packed_colour{colour_topic_, std::move(colour.data), colour.stamp};
    SourceFrame frame;
    frame.timestamp = seconds_of(colour.stamp);
    frame.depth_timestamp = seconds_of(depth.stamp);
    frame.name = stamp_text(colour.stamp);
    frame.where = packed_colour.where();
    const auto later = std::partition_point(imu_.begin(), imu_.end(), [&](const ImuSample& sample) {
      return sample.timestamp <= frame.timestamp;
    });
    frame.imu.assign(imu_.begin(), later);
    imu_.erase(imu_.begin(), later);
    frame.images = pack_images(std::move(packed_colour), {depth_topic_, std::move(depth.data), depth.stamp});
    return frame;
  }

  std::function<std::unique_ptr<Recording>()> open_;
  std::unique_ptr<Recording> recording_;
  TopicChoice choice_;
  RecordingCameras found_;
  std::string colour_frame_;
  std::shared_ptr<const ImageTopic> colour_topic_, depth_topic_;
  std::vector<std::string> notes_;
  std::vector<StreamInfo> streams_;
  std::int64_t tolerance_ = 0;  ///< [ns]
  bool use_log_times_ = false;

  std::unique_ptr<StampPairing> pairing_;
  std::map<int, ForwardStamps> forward_;  ///< by topic
  std::vector<ImuSample> imu_;            ///< not given yet
  RecordedTruth truth_;                   ///< as far as read
  bool ended_ = false, given_ = false;
  int damaged_ = 0;
};

}  // namespace

bool is_mcap_recording(const std::filesystem::path& path) { return recording_format(path) == "mcap"; }
bool is_db3_recording(const std::filesystem::path& path) { return recording_format(path) == "db3"; }
bool is_bag_recording(const std::filesystem::path& path) { return recording_format(path) == "bag"; }

std::unique_ptr<FrameSource> make_recording_source(const std::function<std::unique_ptr<Recording>()>& open,
                                                   const SourceOptions& options) {
  return std::make_unique<RecordingSource>(open, options);
}

std::unique_ptr<FrameSource> open_recording_source(const std::filesystem::path& path,
                                                   const SourceOptions& options) {
  return make_recording_source([path] { return open_recording(path); }, options);
}

}  // namespace stdc
