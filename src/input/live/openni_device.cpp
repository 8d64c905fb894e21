#ifdef STDC_WITH_OPENNI

#include "input/live/openni_device.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "core/error.hpp"

namespace stdc {
namespace {

constexpr int kWidth = 640, kHeight = 480, kFramesPerSecond = 30;  // wanted; every such device has it

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

std::string device_names() {
  openni::Array<openni::DeviceInfo> devices;
  openni::OpenNI::enumerateDevices(&devices);
  std::string names;
  for (int i = 0; i < devices.getSize(); ++i) {
    names += (names.empty() ? "openni2:" : ", openni2:") + std::string(devices[i].getUri());
  }
  return names;
}
}  // namespace

OpenNiDevice::OpenNiDevice(const std::string& uri) : where_("openni2:" + uri) {
  open(uri);
  try {
    start(colour_, openni::SENSOR_COLOR, std::array{openni::PIXEL_FORMAT_RGB888, openni::PIXEL_FORMAT_GRAY8},
          "colour");
    start(depth_, openni::SENSOR_DEPTH,
          std::array{openni::PIXEL_FORMAT_DEPTH_1_MM, openni::PIXEL_FORMAT_DEPTH_100_UM}, "depth");
    register_depth();
  } catch (...) {
    close();
    throw;
  }
}

OpenNiDevice::~OpenNiDevice() { close(); }

void OpenNiDevice::open(const std::string& uri) {
  if (openni::OpenNI::initialize() != openni::STATUS_OK)
    fail("OpenNI cannot be started", "check its drivers");
  if (device_.open(uri.empty() ? openni::ANY_DEVICE : uri.c_str()) == openni::STATUS_OK) return;
  const std::string devices = device_names();
  openni::OpenNI::shutdown();
  throw Error(where_, "there is no such camera",
              devices.empty()
                  ? "plug it in, and check that its driver and the rights to its USB device are there"
                  : "give one of " + devices);
}

void OpenNiDevice::start(openni::VideoStream& stream, openni::SensorType type,
                         std::span<const openni::PixelFormat> formats, const char* name) {
  const openni::SensorInfo* sensor = device_.getSensorInfo(type);
  if (sensor == nullptr) throw Error(where_, fmt::format("gives no {} images", name), "use an RGB-D camera");
  const auto mode = choose_mode(*sensor, formats);
  if (!mode) throw Error(where_, fmt::format("has no known format of {} images", name), "tell us its name");
  if (stream.create(device_, type) != openni::STATUS_OK || stream.setVideoMode(*mode) != openni::STATUS_OK ||
      stream.start() != openni::STATUS_OK) {
    fail(fmt::format("its {} images cannot be started", name), "see that no other program uses the camera");
  }
  stream.setMirroringEnabled(false);
}

void OpenNiDevice::register_depth() {
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

void OpenNiDevice::close() {
  colour_.destroy();
  depth_.destroy();
  device_.close();
  openni::OpenNI::shutdown();
}

void OpenNiDevice::fail(const std::string& problem, const std::string& hint) const {
  throw Error(where_, fmt::format("{} ({})", problem, reason()), hint);
}

std::string OpenNiDevice::reason() {
  std::string text = openni::OpenNI::getExtendedError();
  while (!text.empty() && (text.back() == '\n' || text.back() == '.')) text.pop_back();
  for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
  return text.empty() ? "no reason given" : text;
}
std::string OpenNiDevice::describe(const openni::VideoStream& stream) {
  const openni::VideoMode mode = stream.getVideoMode();
  return fmt::format("{} x {}, {} Hz", mode.getResolutionX(), mode.getResolutionY(), mode.getFps());
}

std::string OpenNiDevice::camera_hint() const {
  const bool fine = depth_.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM;
  const int units_per_metre = fine ? 10'000 : 1000;
  const openni::VideoMode mode = colour_.getVideoMode();
  const double half_width = 0.5 * mode.getResolutionX();
  return fmt::format(
      "OpenNI has no intrinsics: give a camera file with --camera (width {}, height {}, "
      "depth_units_per_metre {}; "
      "fx is about {:.0f} by its field of view)",
      mode.getResolutionX(), mode.getResolutionY(), units_per_metre,
      half_width / std::tan(0.5 * colour_.getHorizontalFieldOfView()));
}
}  // namespace stdc

#endif
