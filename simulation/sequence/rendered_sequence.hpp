#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "core/rgbd_image.hpp"
#include "core/setting.hpp"

namespace stdc::simulation {

/// The sequences that can be rendered. The `walking` ones follow the camera motions of the TUM RGB-D
/// benchmark (Sturm et al. 2012) with two people who walk, turn, stop and sit between the camera and the
/// desks.
enum class Preset {
  static_desk,
  static_room,  ///< a loop through the room that ends where it began
  walking_xyz,
  walking_halfsphere,
  walking_rpy,
  walking_static,
  moving_box,  ///< a person carries a box, puts it down and pushes a chair
};

}  // namespace stdc::simulation

template <>
struct stdc::EnumNames<stdc::simulation::Preset> {
  using Preset = stdc::simulation::Preset;
  static constexpr std::array values{
      std::pair{Preset::static_desk, "static-desk"},
      std::pair{Preset::static_room, "static-room"},
      std::pair{Preset::walking_xyz, "walking-xyz"},
      std::pair{Preset::walking_halfsphere, "walking-halfsphere"},
      std::pair{Preset::walking_rpy, "walking-rpy"},
      std::pair{Preset::walking_static, "walking-static"},
      std::pair{Preset::moving_box, "moving-box"},
  };
};

namespace stdc::simulation {

/// Throws Error listing the presets if there is none of that name.
Preset preset_named(std::string_view name);

struct RenderSettings {
  std::uint64_t seed = 1;        ///< of textures, clutter, people, hand tremor and noise
  bool with_people = true;       ///< false: the same room and camera motion, all static
  bool motion_blur = false;      ///< expose over 1/60 s instead of an instant
  std::optional<Camera> camera;  ///< default: default_render_camera()
};

/// 640 x 480, 30 Hz, the focal lengths of TUM's freiburg3 camera without lens distortion.
Camera default_render_camera();

struct RenderedFrame {
  RgbdImage image;      ///< BGR, and 16-bit depth; timestamp included
  cv::Mat mask;         ///< CV_8UC1, 255: dynamic
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
