#include "simulation/sequence/rendered_sequence.hpp"

#include <cassert>
#include <opencv2/core.hpp>

#include "simulation/light/ray_renderer.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/sensors/colour_sensor.hpp"
#include "simulation/sensors/depth_sensor.hpp"
#include "simulation/sequence/camera_path.hpp"
#include "simulation/sequence/make_dynamic_scene.hpp"

namespace stdc::simulation {
namespace {

constexpr double kFirstTimestamp = 1000;   // [s]
constexpr double kBlurSeconds = 1.0 / 60;  // exposure time with motion blur
constexpr int kBlurSamples = 6;
constexpr float kExposure = 1.55F;

Room furnished_room(Preset preset, const RenderSettings& settings) {
  Room room = make_room(settings.seed, has_visitor_chair(preset));
  if (settings.refurnish) settings.refurnish(room.world);
  return room;
}

}  // namespace

Camera default_render_camera() {
  Camera camera;
  camera.fx = 535.4;
  camera.fy = 539.2;
  camera.cx = 320.1;
  camera.cy = 247.6;
  return camera;
}

/// All that is needed to render a frame.
class RenderedSequence::Setup {
 public:
  Setup(Preset chosen, const RenderSettings& chosen_settings)
      : preset(chosen),
        settings(chosen_settings),
        camera(checked(settings.camera.value_or(default_render_camera()))),
        motion(motion_of(preset), settings.seed),
        room(furnished_room(preset, settings)),
        scene(room.world.mesh, TreeQuality::good),
        light(room.world, scene),
        shader(room.world, light),
        dynamic_scene(make_dynamic_scene(preset, settings.seed, settings.with_people, room, light)),
        rays(camera),
        renderer(rays, scene, shader),
        depth_sensor(camera) {}

  static Camera checked(const Camera& c) {
    c.validate("render settings: camera");
    return c;
  }

  double time(int index) const { return index / camera.frames_per_second; }

  IdealImage render_instant(double t) const {
    const std::unique_ptr<MovingObjects> moving = dynamic_scene ? dynamic_scene->at(t) : nullptr;
    if (camera.readout_time == 0) return renderer.render(motion.world_from_cam(t), moving.get());
    const auto when_read = [&](double row) {
      return motion.world_from_cam(
          std::max(0.0, t + camera.readout_time * (row / (camera.height - 1) - 0.5)));
    };
    return renderer.render_rows(when_read, moving.get());
  }

  IdealImage render_ideal(int index) const {
    IdealImage ideal = render_instant(time(index));
    if (!settings.motion_blur) return ideal;
    ideal.colour.setTo(0);
    for (int i = 0; i < kBlurSamples; ++i) {
      const double shift = kBlurSeconds * ((i + 0.5) / kBlurSamples - 0.5);
      ideal.colour += render_instant(std::max(0.0, time(index) + shift)).colour * (1.0F / kBlurSamples);
    }
    return ideal;
  }

  const Preset preset;
  const RenderSettings settings;
  const Camera camera;
  const CameraPath motion;
  const Room room;
  const RayScene scene;
  const BakedLight light;
  const SurfaceShader shader;
  const std::optional<DynamicScene> dynamic_scene;
  const RayGrid rays;
  const RayRenderer renderer;
  const ColourSensor colour_sensor;
  const DepthSensor depth_sensor;
};

RenderedSequence::RenderedSequence(Preset preset, const RenderSettings& settings)
    : setup_(std::make_unique<Setup>(preset, settings)) {}
RenderedSequence::~RenderedSequence() = default;
RenderedSequence::RenderedSequence(RenderedSequence&&) noexcept = default;
RenderedSequence& RenderedSequence::operator=(RenderedSequence&&) noexcept = default;

const Camera& RenderedSequence::camera() const { return setup_->camera; }

int RenderedSequence::frame_count() const { return frame_count(setup_->preset, setup_->camera); }

int RenderedSequence::frame_count(Preset preset, const Camera& camera) {
  return static_cast<int>(std::lround(seconds_of(preset) * camera.frames_per_second));
}

double RenderedSequence::timestamp(int index) const { return kFirstTimestamp + setup_->time(index); }

Pose RenderedSequence::world_from_cam(int index) const {
  return setup_->motion.world_from_cam(setup_->time(index));
}

RenderedFrame RenderedSequence::render(int index) const {
  assert(index >= 0);
  const IdealImage ideal = setup_->render_ideal(index);
  const std::uint64_t noise = setup_->settings.seed * 1000003ULL + static_cast<std::uint64_t>(index);
  RenderedFrame frame;
  frame.image.timestamp = timestamp(index);
  frame.image.colour = setup_->colour_sensor.image(ideal.colour, kExposure, noise);
  frame.image.depth = setup_->depth_sensor.image(ideal.depth, ideal.infrared, noise);
  frame.mask = ideal.mask;
  if (setup_->dynamic_scene && setup_->dynamic_scene->has_moving_props()) frame.moved = ideal.moved;
  frame.world_from_cam = world_from_cam(index);
  return frame;
}

}  // namespace stdc::simulation
