// A driver for OpenNI 2 that plays a film, for tests: Debian's unmodified library loads it and takes it for a
// camera.
//
// The film is the file that STDC_FILM names: four int32 (width, height, frames, milliseconds a frame), then
// of each frame the colours (RGB, 8 bits) and the depths (16 bits, millimetres). It is played over and over.
#define XN_NEW(type, argument) new type(argument)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <thread>
#include <vector>

namespace {

struct Film {
  std::int32_t width = 0, height = 0, frames = 0, period_ms = 0;
  std::vector<char> images;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
  const char* colour(int frame) const {
    return images.data() + static_cast<std::size_t>(frame) * pixels() * 5;
  }
  const char* depth(int frame) const { return colour(frame) + pixels() * 3; }
};

Film read_film() {
  Film film;
  const char* path = std::getenv("STDC_FILM");
  std::ifstream file(path != nullptr ? path : "", std::ios::binary);
  file.read(reinterpret_cast<char*>(&film), 4 * sizeof(std::int32_t));
  film.images.assign(std::istreambuf_iterator<char>(file), {});
  if (film.images.size() < film.pixels() * 5 * static_cast<std::size_t>(film.frames)) film.frames = 0;
  return film;
}

class FilmStream : public oni::driver::StreamBase {
 public:
  FilmStream(const Film& film, OniSensorType type) : film_(film), type_(type) {
    mode_ = {type == ONI_SENSOR_COLOR ? ONI_PIXEL_FORMAT_RGB888 : ONI_PIXEL_FORMAT_DEPTH_1_MM, film.width,
             film.height, 30};
  }

  OniStatus start() override {
    running_ = true;
    return ONI_STATUS_OK;
  }
  void stop() override { running_ = false; }
  bool running() const { return running_; }

  OniBool isPropertySupported(int property) override { return property == ONI_STREAM_PROPERTY_VIDEO_MODE; }
  OniStatus getProperty(int property, void* data, int* size) override {
    if (property != ONI_STREAM_PROPERTY_VIDEO_MODE || *size != sizeof(OniVideoMode))
      return ONI_STATUS_NOT_SUPPORTED;
    std::memcpy(data, &mode_, sizeof(mode_));
    return ONI_STATUS_OK;
  }
  OniStatus setProperty(int property, const void* data, int size) override {
    if (property != ONI_STREAM_PROPERTY_VIDEO_MODE || size != sizeof(OniVideoMode))
      return ONI_STATUS_NOT_SUPPORTED;
    return std::memcmp(data, &mode_, sizeof(mode_)) == 0 ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

  void show(int index) {
    if (!running_) return;
    OniFrame* frame = getServices().acquireFrame();
    if (frame == nullptr) return;
    const int image = index % film_.frames;
    const int bytes = type_ == ONI_SENSOR_COLOR ? 3 : 2;
    frame->sensorType = type_;
    frame->frameIndex = index + 1;
    frame->timestamp = static_cast<std::uint64_t>(index + 1) * 33'333;
    frame->width = film_.width, frame->height = film_.height;
    frame->videoMode = mode_;
    frame->stride = bytes * film_.width;
    frame->dataSize = frame->stride * film_.height;
    frame->croppingEnabled = FALSE;
    std::memcpy(frame->data, type_ == ONI_SENSOR_COLOR ? film_.colour(image) : film_.depth(image),
                static_cast<std::size_t>(frame->dataSize));
    raiseNewFrame(frame);
    getServices().releaseFrame(frame);
  }

 private:
  const Film& film_;
  OniSensorType type_;
  OniVideoMode mode_{};
  std::atomic<bool> running_ = false;
};

class FilmDevice : public oni::driver::DeviceBase {
 public:
  FilmDevice() : film_(read_film()), thread_([this] { work(); }) {
    modes_[0] = {ONI_PIXEL_FORMAT_RGB888, film_.width, film_.height, 30};
    modes_[1] = {ONI_PIXEL_FORMAT_DEPTH_1_MM, film_.width, film_.height, 30};
    sensors_[0] = {ONI_SENSOR_COLOR, 1, &modes_[0]};
    sensors_[1] = {ONI_SENSOR_DEPTH, 1, &modes_[1]};
  }
  ~FilmDevice() override {
    over_ = true;
    thread_.join();
  }

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override {
    *sensors = sensors_;
    *count = 2;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override {
    const std::lock_guard lock(mutex_);
    auto& stream = type == ONI_SENSOR_COLOR ? colour_ : depth_;
    stream = new FilmStream(film_, type);  // of the library until destroyStream()
    return stream;
  }
  void destroyStream(oni::driver::StreamBase* stream) override {
    const std::lock_guard lock(mutex_);
    if (stream == colour_) colour_ = nullptr;
    if (stream == depth_) depth_ = nullptr;
    delete stream;
  }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }
  OniBool isPropertySupported(int property) override {
    return property == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  }
  OniStatus setProperty(int property, const void*, int) override {
    return property == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION ? ONI_STATUS_OK : ONI_STATUS_NOT_SUPPORTED;
  }

 private:
  void work() {
    int next = 0;
    while (!over_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(film_.period_ms > 0 ? film_.period_ms : 33));
      const std::lock_guard lock(mutex_);
      if (colour_ == nullptr || depth_ == nullptr || !colour_->running() || !depth_->running()) continue;
      if (film_.frames == 0) continue;
      depth_->show(next);
      colour_->show(next);
      ++next;
    }
  }

  Film film_;
  OniVideoMode modes_[2];
  OniSensorInfo sensors_[2];
  std::mutex mutex_;
  FilmStream *colour_ = nullptr, *depth_ = nullptr;
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

class FilmDriver : public oni::driver::DriverBase {
 public:
  explicit FilmDriver(OniDriverServices* services) : DriverBase(services) {}

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    std::strcpy(info_.uri, "film");
    std::strcpy(info_.vendor, "tests");
    std::strcpy(info_.name, "film");
    deviceConnected(&info_);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override { return new FilmDevice; }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {}

 private:
  OniDeviceInfo info_{};
};

}  // namespace

ONI_EXPORT_DRIVER(FilmDriver)
