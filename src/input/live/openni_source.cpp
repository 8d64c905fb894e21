#include "input/live/openni_source.hpp"

#include "core/error.hpp"

#ifdef STDC_WITH_OPENNI

#include <OpenNI.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "input/live/frame_queue.hpp"
#include "input/recordings/forward_stamps.hpp"
#include "input/recordings/stamp_pairing.hpp"

namespace stdc {
namespace {

constexpr std::size_t kFirstFrames = 15;                           // that may wait until they are asked for
constexpr std::size_t kMaxWaiting = 30;                            // images without a partner
constexpr std::int64_t kTolerance = 20'000'000;                    // [ns] between colour and depth
constexpr int kWidth = 640, kHeight = 480, kFramesPerSecond = 30;  // wanted; every such device has it

using Pixels = std::shared_ptr<const std::vector<std::uint8_t>>;

void check_size(const std::string& where, cv::Size has, cv::Size wanted) {
  if (wanted.empty() || has == wanted) return;
  throw Error(where,
              fmt::format("gives images of {} x {} pixels, but the camera has {} x {}", has.width, has.height,
                          wanted.width, wanted.height),
              "give the camera of these images with --camera");
}

/// One image of each stream, in the device's own formats: RGB888 or GRAY8, and 16 bits.
class DeviceImages : public PackedImages {
 public:
  DeviceImages(std::string where, cv::Mat colour, cv::Mat depth, Pixels colour_pixels, Pixels depth_pixels)
      : where_(std::move(where)),
        colour_(std::move(colour)),
        depth_(std::move(depth)),
        colour_pixels_(std::move(colour_pixels)),
        depth_pixels_(std::move(depth_pixels)) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    check_size(where_, colour_.size(), size);
    if (colour_.channels() == 1) return colour_.clone();
    cv::Mat result;
    cv::cvtColor(colour_, result, mode == ColourMode::grey ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
    return result;
  }
  cv::Mat depth(cv::Size size) const override {
    check_size(where_, depth_.size(), size);
    return depth_.clone();
  }

 private:
  std::string where_;
  cv::Mat colour_, depth_;  ///< look into the pixels
  Pixels colour_pixels_, depth_pixels_;
};

/// Of the modes of a sensor the one of the wanted size and rate, else the first, of a format that is read
/// here.
std::optional<openni::VideoMode> choose_mode(const openni::SensorInfo& sensor,
                                             std::span<const openni::PixelFormat> formats) {
  std::optional<openni::VideoMode> chosen;
  const auto& modes = sensor.getSupportedVideoModes();
  for (const openni::PixelFormat format : formats) {
    for (int i = 0; i < modes.getSize(); ++i) {
      if (modes[i].getPixelFormat() != format) continue;
      const bool wanted = modes[i].getResolutionX() == kWidth && modes[i].getResolutionY() == kHeight &&
                          modes[i].getFps() == kFramesPerSecond;
      if (wanted) return modes[i];
      if (!chosen) chosen = modes[i];
    }
  }
  return chosen;
}

class OpenNiSource : public FrameSource {
 public:
  OpenNiSource(const std::string& uri, int max_waiting)
      : where_("openni2:" + uri), queue_(static_cast<std::size_t>(std::max(1, max_waiting)), kFirstFrames) {
    const openni::Status status = openni::OpenNI::initialize();
    if (status != openni::STATUS_OK) fail("OpenNI cannot be started", "check its drivers");
    if (device_.open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) != openni::STATUS_OK) {
      const std::string devices = device_names();
      openni::OpenNI::shutdown();
      throw Error(where_, "there is no such camera",
                  devices.empty()
                      ? "plug it in, and check that its driver and the rights to its USB device are there"
                      : "give one of " + devices);
    }
    try {
      start(colour_, openni::SENSOR_COLOR,
            std::array{openni::PIXEL_FORMAT_RGB888, openni::PIXEL_FORMAT_GRAY8}, "colour");
      start(depth_, openni::SENSOR_DEPTH,
            std::array{openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM}, "depth");
      register_depth();
    } catch (...) {
      close();
      throw;
    }
    thread_ = std::thread([this] { work(); });
  }
  ~OpenNiSource() override {
    stop();
    thread_.join();
    close();
  }

  std::optional<SourceFrame> next() override { return queue_.pop(); }
  void rewind() override { throw Error(where_, "cannot be gone through a second time", "record it first"); }
  bool can_rewind() const override { return false; }
  bool is_live() const override { return true; }
  void stop() override {
    stop_ = true;
    queue_.close();
  }
  int dropped() const override { return queue_.dropped(); }
  std::optional<int> frame_count() const override { return std::nullopt; }
  std::optional<RgbdCameras> cameras() const override { return std::nullopt; }
  std::string camera_hint() const override {
    const openni::VideoMode mode = colour_.getVideoMode();
    const double half_width = 0.5 * mode.getResolutionX();
    return fmt::format(
        "OpenNI has no intrinsics: give a camera file with --camera (width {}, height {}, "
        "depth_units_per_metre {}; "
        "fx is about {:.0f} by its field of view)",
        mode.getResolutionX(), mode.getResolutionY(), units_per_metre(),
        half_width / std::tan(0.5 * colour_.getHorizontalFieldOfView()));
  }
  std::string kind() const override { return "openni2"; }
  std::string where() const override { return where_; }
  std::vector<StreamInfo> streams() const override {
    return {{"colour", describe(colour_), std::nullopt}, {"depth", describe(depth_), std::nullopt}};
  }
  std::vector<std::string> notes() const override { return notes_; }
  std::vector<std::string> faults() const override {
    std::vector<std::string> faults;
    if (dropped() > 0)
      faults.push_back(fmt::format("{}: {} frames came too late and are left out", where_, dropped()));
    const std::lock_guard lock(mutex_);
    if (!ended_by_.empty()) faults.push_back(fmt::format("{}: the camera ended: {}", where_, ended_by_));
    return faults;
  }
  int colour_without_depth() const override { return colour_without_depth_; }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& hint) const {
    throw Error(where_, fmt::format("{} ({})", problem, reason()), hint);
  }
  /// OpenNI's own words in one line.
  static std::string reason() {
    std::string text = openni::OpenNI::getExtendedError();
    while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
    for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
    return text.empty() ? "no reason given" : text;
  }
  static std::string device_names() {
    openni::Array<openni::DeviceInfo> devices;
    openni::OpenNI::enumerateDevices(&devices);
    std::string names;
    for (int i = 0; i < devices.getSize(); ++i) {
      names += (names.empty() ? "openni2:" : ", openni2:") + std::string(devices[i].getUri());
    }
    return names;
  }
  static std::string describe(const openni::VideoStream& stream) {
    const openni::VideoMode mode = stream.getVideoMode();
    return fmt::format("{} x {}, {} Hz", mode.getResolutionX(), mode.getResolutionY(), mode.getFps());
  }
  int units_per_metre() const {
    return depth_.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 10'000 : 1000;
  }

  void start(openni::VideoStream& stream, openni::SensorType type,
             std::span<const openni::PixelFormat> formats, const char* name) {
    const openni::SensorInfo* sensor = device_.getSensorInfo(type);
    if (sensor == nullptr)
      throw Error(where_, fmt::format("gives no {} images", name), "use an RGB-D camera");
    const auto mode = choose_mode(*sensor, formats);
    if (!mode) throw Error(where_, fmt::format("has no known format of {} images", name), "tell us its name");
    if (stream.create(device_, type) != openni::STATUS_OK ||
        stream.setVideoMode(*mode) != openni::STATUS_OK || stream.start() != openni::STATUS_OK) {
      fail(fmt::format("its {} images cannot be started", name), "see that no other program uses the camera");
    }
    stream.setMirroringEnabled(false);
  }

  void register_depth() {
    device_.setDepthColorSyncEnabled(true);
    constexpr auto kToColour = openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    if (device_.isImageRegistrationModeSupported(kToColour) &&
        device_.setImageRegistrationMode(kToColour) == openni::STATUS_OK) {
      return;
    }
    notes_.push_back(where_ +
                     ": the device does not register depth to colour: say where the depth camera is by "
                     "depth_camera in the camera file");
  }

  void work() {
    constexpr int kPatience = 100;  // [ms], then it is looked whether to stop
    std::array<openni::VideoStream*, 2> streams{&colour_, &depth_};
    while (!stop_) {
      int ready = -1;
      const openni::Status status = openni::OpenNI::waitForAnyStream(streams.data(), 2, &ready, kPatience);
      if (status == openni::STATUS_TIME_OUT) {
        if (device_.isValid()) continue;
      } else if (status == openni::STATUS_OK && read(*streams[static_cast<std::size_t>(ready)], ready == 0)) {
        continue;
      }
      const std::lock_guard lock(mutex_);
      ended_by_ = reason();
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
      frame.where = fmt::format("{} at {}", where_, frame.name);
      frame.images =
          std::make_shared<DeviceImages>(frame.where, view(colour.data, colour_size_, colour_type_),
                                         view(depth.data, depth_size_, CV_16UC1), colour.data, depth.data);
      queue_.push(std::move(frame));
    }
    colour_without_depth_ = pairing_.colour_without_depth();
  }

  void close() {
    colour_.destroy();
    depth_.destroy();
    device_.close();
    openni::OpenNI::shutdown();
  }

  std::string where_;
  FrameQueue queue_;
  openni::Device device_;
  openni::VideoStream colour_, depth_;
  std::vector<std::string> notes_;
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
