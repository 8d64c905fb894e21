#include "simulation/compose/passage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "simulation/scene/loose_objects.hpp"
#include "simulation/scene/motion_curves.hpp"
#include "simulation/scene/shapes.hpp"
#include "simulation/sequence/camera_path.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;

constexpr int kRamp = 30;            // frames in which the board comes in, and goes [at most]
constexpr double kFollow = 1.0;      // standard deviation of the mean that leads board and box [s]
constexpr double kBoxSide = 0.4;     // [m]
constexpr double kWalkSpeed = 0.75;  // [m/s]
const Vector3d kStand(0, -2.55, 0);  // where the mean camera of the passage stands in the room

/// Mean direction in which the cameras of some frames look, a unit vector.
Vector3d mean_gaze(const std::vector<Pose>& world_from_cam, int first, int last) {
  Vector3d gaze = Vector3d::Zero();
  for (int i = first; i < last; ++i) gaze += world_from_cam[i].rotation * Vector3d::UnitZ();
  return gaze.normalized();
}

/// Turns about the vertical and shifts along the floor, so that the mean camera of some frames stands at
/// kStand and looks along +y: the middle of the room, where there is light and space.
Pose room_from_world(const std::vector<Pose>& world_from_cam, int first, int last) {
  Vector3d centre = Vector3d::Zero();
  for (int i = first; i < last; ++i) centre += world_from_cam[i].translation / (last - first);
  const Vector3d gaze = mean_gaze(world_from_cam, first, last);
  const Eigen::Quaterniond turn = about_z(std::numbers::pi / 2 - std::atan2(gaze.y(), gaze.x()));
  Vector3d shift = kStand - turn * centre;
  shift.z() = 0;
  return {turn, shift};
}

/// The mean camera around a time, weighted by a Gaussian: its place, and axes with x level, y down, z ahead.
Pose mean_camera(const std::vector<Pose>& cameras, const std::vector<double>& times, double time) {
  Vector3d centre = Vector3d::Zero(), gaze = Vector3d::Zero();
  double sum = 0;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const double d = (times[i] - time) / kFollow;
    if (std::abs(d) > 4) continue;
    const double weight = std::exp(-0.5 * d * d);
    centre += weight * cameras[i].translation;
    gaze += weight * (cameras[i].rotation * Vector3d::UnitZ());
    sum += weight;
  }
  return look_at(centre / sum, centre / sum + gaze);
}

/// Frame of something before a camera: z up along the image, y away from the camera, front towards it.
Pose before(const Pose& camera, double right, double down, double ahead) {
  return camera * Pose(about_x(std::numbers::pi / 2), Vector3d(right, down, ahead));
}

/// Where the middle of the board is across the view, -1 and 1 being out of it: comes in, goes slowly through
/// the middle, goes out.
double across(double time, double ramp, double slow) {
  constexpr double kMiddle = 0.12;
  const double speed = 2 * kMiddle / slow;
  if (time < ramp) {  // slows down to that speed
    const double left = 1 - time / ramp;
    return -kMiddle - speed * ramp * left - (1 - kMiddle - speed * ramp) * left * left * left;
  }
  if (time <= ramp + slow) return -kMiddle + speed * (time - ramp);
  return -across(2 * ramp + slow - time, ramp, slow);
}

/// Share of a pinhole view that an upright rectangle covers; `camera_from_board` as of `before`.
double covered(const Pose& camera_from_board, double width, double height, const Camera& camera) {
  constexpr int kStep = 16;
  const Vector3d normal = camera_from_board.rotation * Vector3d::UnitY();
  int hits = 0, all = 0;
  for (int y = kStep / 2; y < camera.height; y += kStep) {
    for (int x = kStep / 2; x < camera.width; x += kStep, ++all) {
      const Vector3d ray = camera.unproject(camera.undistort(Eigen::Vector2d(x, y)), 1);
      const double z = camera_from_board.translation.dot(normal) / ray.dot(normal);
      const Vector3d p = camera_from_board.inverse() * Vector3d(z * ray);
      hits += z > 0 && std::abs(p.x()) < width / 2 && std::abs(p.z()) < height / 2 ? 1 : 0;
    }
  }
  return static_cast<double>(hits) / all;
}

Mesh scaled_board(const Room& room, double scale) {
  Mesh mesh = board_mesh(room);
  const Vector3d down(0, 0, kBoardHeight / 2);  // its origin moves to the middle
  for (Eigen::Vector3f& p : mesh.positions) p = (scale * (p.cast<double>() - down)).cast<float>();
  return mesh;
}

Mesh printed_box(const Room& room) {
  Mesh mesh;
  ShapeBuilder b(mesh, room.world.materials, 21);
  const PictureSet& prints = room.materials.packages;
  b.box({0, 0, -kBoxSide / 2}, {kBoxSide, kBoxSide, kBoxSide},
        {prints.pick(0), prints.pick(1), prints.pick(4), prints.pick(3), prints.pick(6), prints.pick(5)});
  return mesh;
}

/// Plans the paths of board and box.
struct Planner {
  const PassageSettings& settings;
  const std::vector<Pose>& cameras;  ///< room_from_cam, of all frames
  const std::vector<double>& times;
  const Camera& camera;
  const Room& room;
  int first, last;

  double half_view() const { return settings.distance * camera.width / (2 * camera.fx); }
  double seconds() const { return times[last - 1] - times[first]; }

  Pose board_at(double time, double scale) const {
    const double ramp = seconds() * (last - first - settings.frames) / (2.0 * (last - first));
    const double reach = half_view() + 0.5 * scale * kBoardWidth + 0.15;
    const double x = reach * across(time, ramp, seconds() - 2 * ramp);
    return before(mean_camera(cameras, times, times[first] + time), x, 0.01 * wave(time, 2.3),
                  settings.distance + 0.03 * wave(time, 3.7)) *
           Pose(about_z(0.05 * wave(time, 4.3)) * about_y(0.02 * wave(time, 3.1)), Vector3d::Zero());
  }

  double board_share(double scale) const {
    constexpr int kEvery = 7;
    double sum = 0;
    int count = 0;
    const int ramp = (last - first - settings.frames) / 2;
    for (int i = first + ramp; i < last - ramp; i += kEvery, ++count) {
      const Pose board = cameras[i].inverse() * board_at(times[i] - times[first], scale);
      sum += covered(board, scale * kBoardWidth, scale * kBoardHeight, camera);
    }
    return sum / count;
  }

  Prop board() const {
    double low = 0.1, high = 3;
    for (int i = 0; i < 14; ++i) {
      const double middle = 0.5 * (low + high);
      (board_share(middle) < settings.share ? low : high) = middle;
    }
    return moving(
        scaled_board(room, high), [&](double t) { return board_at(t, high); }, 0.4);
  }

  Prop box() const {
    const double reach = half_view() + kBoxSide + 0.15;
    const auto at = [&](double t) {
      return before(mean_camera(cameras, times, times[first] + t), reach * (2 * t / seconds() - 1),
                    0.02 * wave(t, 1.9), settings.distance) *
             Pose(about_z(0.4 * t) * about_x(0.1 * wave(t, 3.3)), Vector3d::Zero());
    };
    return moving(printed_box(room), at, 0.2);
  }

  Prop moving(Mesh mesh, const std::function<Pose(double)>& at, double radius) const {
    Prop::Move move = sampled_move(-1e-3, seconds() + 1e-3, at);
    const Pose start = move.world_from_prop.front();
    return {std::move(mesh), start, {std::move(move)}, radius};
  }
};

/// @param level  cosine of the angle by which the camera looks down: the distance is measured along its gaze
Route walk_across(const PassageSettings& settings, const Camera& camera, double level) {
  const double reach = settings.distance * camera.width / (2 * camera.fx) + 0.6;
  const double y = kStand.y() + settings.distance * level;
  Route route({{-reach, y}, std::numbers::pi / 2});
  route.walk({{reach, y}}, kWalkSpeed);
  return route;
}

}  // namespace

Passage::Passage(const PassageSettings& settings, const RecordedPath& path, const Camera& camera,
                 const Room& room, const BakedLight& light) {
  const auto count = static_cast<int>(path.times.size());
  Route route = walk_across(settings, camera, mean_gaze(path.world_from_cam, 0, count).head<2>().norm());
  int length = settings.frames;
  if (settings.mover == PastedMover::person)
    length = static_cast<int>(std::ceil(route.end() * camera.frames_per_second));
  if (length + 2 > count) {
    throw Error("recording", fmt::format("has {} frames, too few for a passage of {}", count, length + 2),
                "ask for fewer --frames or take a longer recording");
  }
  if (settings.mover == PastedMover::board) length += 2 * std::min(kRamp, (count - length) / 2);
  first_ = settings.start < 0 ? (count - length) / 2 : settings.start;
  last_ = first_ + length;
  if (last_ > count) {
    throw Error(
        "--start",
        fmt::format("leaves {} of {} frames, too few for a passage of {}", count - first_, count, length),
        "start earlier");
  }
  const Pose to_room = room_from_world(path.world_from_cam, first_, last_);
  for (const Pose& pose : path.world_from_cam) room_from_cam_.push_back(to_room * pose);
  for (const double time : path.times) times_.push_back(time - path.times[first_]);
  const Planner planner{settings, room_from_cam_, path.times, camera, room, first_, last_};
  std::vector<Person> people;
  std::vector<Prop> props;
  if (settings.mover == PastedMover::person) {
    route.wait(2);  // steps are planned up to 1.5 s before the end of a route
    const PersonAppearance appearance = random_appearance(0, settings.seed);
    people.emplace_back(appearance, Skeleton(appearance.measures), std::move(route));
  } else {
    props.push_back(settings.mover == PastedMover::board ? planner.board() : planner.box());
  }
  scene_ = std::make_unique<DynamicScene>(room.world, light, std::move(people), std::move(props));
}

std::unique_ptr<MovingObjects> Passage::mover(int frame) const { return scene_->at(times_.at(frame)); }

}  // namespace stdc::simulation
