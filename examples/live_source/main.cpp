// Feeds frames from a live source. Here a thread makes them up, as a camera's driver would hand them out; put
// the callback of yours in its place. Tracking keeps up with the camera: what comes while it is busy is
// dropped, not queued.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <iostream>
#include <mutex>
#include <optional>
#include <stdc_slam.hpp>
#include <thread>

namespace {

/// Holds the newest frame until the tracker comes for it.
class Mailbox {
 public:
  void put(stdc::RgbdImage image) {
    const std::lock_guard lock(mutex_);
    if (image_) ++dropped_;
    image_ = std::move(image);
    arrived_.notify_one();
  }
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    arrived_.notify_one();
  }
  /// Waits; nothing when the source has ended.
  std::optional<stdc::RgbdImage> take() {
    std::unique_lock lock(mutex_);
    arrived_.wait(lock, [&] { return image_ || closed_; });
    return std::exchange(image_, std::nullopt);
  }
  int dropped() const { return dropped_; }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<stdc::RgbdImage> image_;
  bool closed_ = false;
  int dropped_ = 0;
};

/// A wall with a pattern, 2 m away, that moves by 5 mm a frame.
stdc::RgbdImage made_up_frame(int number, const stdc::Camera& camera) {
  stdc::RgbdImage frame;
  frame.timestamp = number / 30.0;
  frame.colour.create(camera.height, camera.width, CV_8UC1);
  frame.depth.create(camera.height, camera.width, CV_16UC1);
  frame.depth.setTo(cv::Scalar(2 * camera.depth_units_per_metre));
  const int shift = static_cast<int>(number * 0.005 * camera.fx / 2);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const unsigned cell =
          static_cast<unsigned>((x + shift) / 12) * 2654435761U ^ static_cast<unsigned>(y / 12) * 40503U;
      frame.colour.at<unsigned char>(y, x) = static_cast<unsigned char>((cell * 2246822519U) >> 24U);
    }
  }
  return frame;
}

}  // namespace

int main() try {
  stdc::Camera camera;  // of a RealSense, say: from its driver
  camera.width = 640, camera.height = 480;
  camera.fx = camera.fy = 600, camera.cx = 320, camera.cy = 240;
  camera.depth_units_per_metre = 1000;

  Mailbox mailbox;
  std::thread driver([&] {
    for (int i = 0; i < 60; ++i) {
      mailbox.put(made_up_frame(i, camera));
      std::this_thread::sleep_for(std::chrono::milliseconds(33));
    }
    mailbox.close();
  });
  stdc::Settings settings;
  stdc::Slam slam(camera, settings);
  int tracked = 0;
  while (const auto image = mailbox.take()) {
    const stdc::TrackingResult result = slam.track(*image);
    if (!stdc::has_pose(result.status)) continue;
    ++tracked;
    const Eigen::Vector3d place = result.cam_from_world->inverse().translation;
    std::cout << result.timestamp << " s: " << place.transpose() << " m\n";
  }
  driver.join();
  std::cout << tracked << " frames tracked, " << mailbox.dropped() << " dropped\n";
  return tracked > 0 ? 0 : 1;
} catch (const stdc::Error& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
