#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"
#include "simulation/scene/world.hpp"
#include "simulation/sequence/preset.hpp"

namespace stdc::simulation {

struct RenderSettings {
  std::uint64_t seed = 1;    ///< of textures, clutter, people, hand tremor and noise
  bool with_people = true;   ///< false: the same room and camera motion, all static, without movers
  bool motion_blur = false;  ///< expose over 1/60 s instead of an instant
  /// Default: default_render_camera(). With a readout time rows are seen one after the other, by colour and
  /// depth alike; what moves stands still meanwhile.
  std::optional<Camera> camera;
  std::function<void(World&)> refurnish;  ///< changes the room, before its light is found; empty: does not
};

/// 640 x 480, 30 Hz, the focal lengths of TUM's freiburg3 camera without lens distortion.
Camera default_render_camera();

struct RenderedFrame {
  RgbdImage image;      ///< BGR, and 16-bit depth; timestamp included
  cv::Mat mask;         ///< CV_8UC1, 255: dynamic
  cv::Mat moved;        ///< CV_8UC1, 255: moves at some time of the sequence; empty if no object does
  Pose world_from_cam;  ///< exact, in the middle of the exposure
};

/// A sequence that is rendered frame by frame, in any order. `render` may be called from several threads at
/// once; a frame has the same bytes on whatever thread, in whatever order and however often it is rendered.
class RenderedSequence {
 public:
  /// Throws Error if the camera is not valid.
  RenderedSequence(Preset preset, const RenderSettings& settings);
  ~RenderedSequence();
  RenderedSequence(RenderedSequence&&) noexcept;
  RenderedSequence& operator=(RenderedSequence&&) noexcept;

  const Camera& camera() const;
  /// Default length of the preset; any index >= 0 can be rendered.
  int frame_count() const;
  static int frame_count(Preset preset, const Camera& camera);
  double timestamp(int index) const;
  Pose world_from_cam(int index) const;
  RenderedFrame render(int index) const;

 private:
  class Setup;
  std::unique_ptr<Setup> setup_;
};

}  // namespace stdc::simulation
