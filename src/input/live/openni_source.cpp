#include "input/live/openni_source.hpp"

#include "core/error.hpp"

#ifdef STDC_WITH_OPENNI

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <mutex>
#include <opencv2/core.hpp>
#include <thread>

#include "input/live/frame_queue.hpp"
#include "input/live/openni_device.hpp"
#include "input/live/openni_images.hpp"
#include "input/recordings/forward_stamps.hpp"
#include "input/recordings/stamp_pairing.hpp"

namespace stdc {
namespace {

constexpr std::size_t kFirstFrames = 15;         // that may wait until they are asked for
constexpr std::size_t kMaxWaiting = 30;          // images without a partner
constexpr std::int64_t kTolerance = 20'000'000;  // [ns] between colour and depth

using Pixels = std::shared_ptr<const std::vector<std::uint8_t>>;

class OpenNiSource : public FrameSource {
 public:
  OpenNiSource(const std::string& uri, int max_waiting)
      : queue_(static_cast<std::size_t>(std::max(1, max_waiting)), kFirstFrames), device_(uri) {
    thread_ = std::thread([this] { work(); });
  }
  ~OpenNiSource() override {
    stop();
    thread_.join();
  }

  std::optional<SourceFrame> next() override { return queue_.pop(); }
  void rewind() override { throw Error(where(), "cannot be gone through a second time", "record it first"); }
  bool can_rewind() const override { return false; }
  bool is_live() const override { return true; }
  void stop() override {
    stop_ = true;
    queue_.close();
  }
  int dropped() const override { return queue_.dropped(); }
  std::optional<int> frame_count() const override { return std::nullopt; }
  std::optional<RgbdCameras> cameras() const override { return std::nullopt; }
  std::string camera_hint() const override { return device_.camera_hint(); }
  std::string kind() const override { return "openni2"; }
  std::string where() const override { return device_.where(); }
  std::vector<StreamInfo> streams() const override {
    return {{"colour", OpenNiDevice::describe(device_.colour()), std::nullopt},
            {"depth", OpenNiDevice::describe(device_.depth()), std::nullopt}};
  }
  std::vector<std::string> notes() const override { return device_.notes(); }
  std::vector<std::string> faults() const override {
    std::vector<std::string> faults;
    if (dropped() > 0)
      faults.push_back(fmt::format("{}: {} frames came too late and are left out", where(), dropped()));
    const std::lock_guard lock(mutex_);
    if (!ended_by_.empty()) faults.push_back(fmt::format("{}: the camera ended: {}", where(), ended_by_));
    return faults;
  }
  int colour_without_depth() const override { return colour_without_depth_; }

 private:
  void work() {
    constexpr int kPatience = 100;  // [ms], then it is looked whether to stop
    std::array<openni::VideoStream*, 2> streams{&device_.colour(), &device_.depth()};
    while (!stop_) {
      int ready = -1;
      const openni::Status status = openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, kPatience);
      if (status == openni::STATUS_TIME_OUT) {
        if (device_.is_there()) continue;
      } else if (status == openni::STATUS_OK && read(*streams[static_cast<std::size_t>(ready)], ready == 0)) {
        continue;
      }
      const std::lock_guard lock(mutex_);
      ended_by_ = OpenNiDevice::reason();
      break;
    }
    queue_.close();
  }

  bool read(openni::VideoStream& stream, bool is_colour) {
    openni::VideoFrameRef frame;
    if (stream.readFrame(&frame) != openni::STATUS_OK || !frame.isValid()) return false;
    const int channels =
        is_colour && frame.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_RGB888 ? 3 : 1;
    const std::size_t row =
        static_cast<std::size_t>(frame.getWidth()) * (is_colour ? static_cast<std::size_t>(channels) : 2);
    auto pixels =
        std::make_shared<std::vector<std::uint8_t>>(row * static_cast<std::size_t>(frame.getHeight()));
    const auto* from = static_cast<const std::uint8_t*>(frame.getData());
    for (int y = 0; y < frame.getHeight(); ++y) {
      std::memcpy(pixels->data() + row * static_cast<std::size_t>(y),
                  from + std::ptrdiff_t{frame.getStrideInBytes()} * y, row);
    }
    (is_colour ? colour_size_ : depth_size_) = {frame.getWidth(), frame.getHeight()};
    if (is_colour) colour_type_ = channels == 3 ? CV_8UC3 : CV_8UC1;
    const auto stamp = static_cast<std::int64_t>(frame.getTimestamp() * 1000);
    if (!(is_colour ? colour_stamps_ : depth_stamps_).passes(stamp)) return true;
    is_colour ? pairing_.add_colour({stamp, std::move(pixels)})
              : pairing_.add_depth({stamp, std::move(pixels)});
    while (pairing_.waiting() > kMaxWaiting) pairing_.give_way(), hand_on();
    hand_on();
    return true;
  }

  void hand_on() {
    while (auto pair = pairing_.next()) {
      const auto view = [](const Pixels& pixels, cv::Size size, int type) {
        return cv::Mat(size, type, const_cast<std::uint8_t*>(pixels->data()));  // only read
      };
      const auto& [colour, depth] = *pair;
      SourceFrame frame;
      frame.timestamp = 1e-9 * static_cast<double>(colour.stamp);
      frame.depth_timestamp = 1e-9 * static_cast<double>(depth.stamp);
      frame.name = fmt::format("{:.6f}", frame.timestamp);
      frame.where = fmt::format("{} at {}", where(), frame.name);
      frame.images =
          pack_openni_images(frame.where, {view(colour.data, colour_size_, colour_type_), colour.data},
                             {view(depth.data, depth_size_, CV_16UC1), depth.data});
      queue_.push(std::move(frame));
    }
    colour_without_depth_ = pairing_.colour_without_depth();
  }

  FrameQueue queue_;
  OpenNiDevice device_;
  std::atomic<bool> stop_ = false;
  std::atomic<int> colour_without_depth_ = 0;
  mutable std::mutex mutex_;
  std::string ended_by_;

  // Of the thread.
  StampPairing pairing_{kTolerance, kTolerance / 2};
  ForwardStamps colour_stamps_, depth_stamps_;
  cv::Size colour_size_, depth_size_;
  int colour_type_ = CV_8UC3;
  std::thread thread_;  // last: it uses what is above
};

}  // namespace

std::unique_ptr<FrameSource> open_openni_device(const std::filesystem::path& path,
                                                const SourceOptions& options) {
  return std::make_unique<OpenNiSource>(path.string().substr(path.string().find(':') + 1),
                                        options.max_waiting);
}

}  // namespace stdc

#else

namespace stdc {

std::unique_ptr<FrameSource> open_openni_device(const std::filesystem::path& path,
                                                const SourceOptions& /*options*/) {
  throw Error(path.string(), "this program was built without OpenNI",
              "install libopenni2-dev and build again");
}

}  // namespace stdc

#endif

namespace stdc {

bool is_openni_device(const std::filesystem::path& path) { return path.string().starts_with("openni2:"); }

}  // namespace stdc
