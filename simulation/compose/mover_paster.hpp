#pragma once

#include <memory>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"
#include "simulation/light/moving_objects.hpp"
#include "simulation/light/ray_renderer.hpp"
#include "simulation/sensors/colour_sensor.hpp"
#include "simulation/sensors/depth_sensor.hpp"

namespace stdc::simulation {

/// A recorded frame with a mover in it.
struct PastedFrame {
  RgbdImage image;  ///< the recording's bytes wherever the mover and its shadow in the depth are not
  cv::Mat mask;     ///< CV_8UC1, 255: the mover at the pixel's centre
};

/// Pastes rendered movers into recorded frames: a pixel shows the mover where it is nearer than the recorded
/// depth; a hole in that counts as the nearer of the surfaces beside it. Outlines are antialiased; colour and
/// depth get the noise of the simulated sensors, and the recorded depth gets the hole that the mover's shadow
/// leaves in a structured-light sensor. The mover casts no visible shadow on the recorded scene.
class MoverPaster {
 public:
  /// @param shader  of any world; nothing of that world is seen. Kept by reference
  MoverPaster(const Camera& camera, const SurfaceShader& shader);

  /// @param recorded  CV_8UC3 and CV_16UC1
  /// @param seed      of the noise; use another for each frame
  PastedFrame paste(const RgbdImage& recorded, const Pose& world_from_cam, const MovingObjects& mover,
                    std::uint64_t seed) const;

 private:
  cv::Mat covered(const IdealImage& ideal, const Pose& world_from_cam, const MovingObjects& mover) const;
  cv::Mat pasted_colour(const RgbdImage& recorded, const IdealImage& ideal, const cv::Mat& share,
                        std::uint64_t seed) const;
  cv::Mat pasted_depth(const RgbdImage& recorded, const IdealImage& ideal, const cv::Mat& mask,
                       std::uint64_t seed) const;

  Camera camera_;
  RayGrid rays_;
  std::unique_ptr<Mesh> nothing_;
  RayScene empty_;
  RayRenderer renderer_;
  ColourSensor colour_sensor_;
  DepthSensor depth_sensor_;
};

}  // namespace stdc::simulation
