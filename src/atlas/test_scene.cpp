#include "atlas/test_scene.hpp"

#include <algorithm>
#include <cmath>

#include "features/detection/pyramid.hpp"

namespace stdc::test {

int View::keypoint_of(int point) const {
  const auto place = std::find(points.begin(), points.end(), point);
  return place == points.end() ? -1 : static_cast<int>(place - points.begin());
}

Descriptor random_descriptor(Random& random) {
  Descriptor descriptor;
  for (auto& word : descriptor.bits) word = (std::uint64_t{random.next()} << 32U) | random.next();
  return descriptor;
}

FeatureSettings scene_feature_settings() {
  FeatureSettings settings;
  settings.levels = 6;
  settings.scale_factor = 1.2;
  return settings;
}

Pose camera_at(double x, double y, double z, double pitch, double yaw, double roll) {
  const Eigen::Quaterniond rotation = rotation_exp({pitch, yaw, roll});
  return Pose(rotation, -(rotation * Eigen::Vector3d(x, y, z)));
}

double centre_error(const Pose& a, const Pose& b) { return (a.centre() - b.centre()).norm(); }

double angle_error(const Pose& a, const Pose& b) { return a.rotation.angularDistance(b.rotation); }

Scene::Scene(int count, bool wall_only, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < count; ++i) {
    ScenePoint point;
    const double x = random.uniform(kLeft, kRight), y = random.uniform(-1.3, kFloor),
                 z = random.uniform(1.7, kWall);
    const std::uint32_t surface = wall_only ? 0 : random.below(4);
    point.position = {surface == 2 ? kLeft : x, surface == 3 ? kFloor : y, surface < 2 ? kWall : z};
    point.descriptor = random_descriptor(random);
    point.angle = static_cast<float>(random.uniform(-3.1, 3.1));
    point.size_level = random.uniform(0.0, 4.0);
    points.push_back(point);
  }
}

View Scene::look(const Pose& cam_from_world, const ViewOptions& options) const {
  View view{cam_from_world, CameraMotion(camera, options.twist), nullptr, {}};
  Random random(options.seed);
  Features raw;
  cv::Mat depth(camera.height, camera.width, CV_32FC1, cv::Scalar(0));
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    Keypoint keypoint;
    double z = 0;
    if (!see(points[p], view, options, random, keypoint, z) || crowded(raw.keypoints, keypoint)) continue;
    Descriptor descriptor = points[p].descriptor;
    for (int n = 0; n < options.flipped_bits; ++n)
      descriptor.bits[random.below(4)] ^= std::uint64_t{1} << random.below(64);
    z = 1 / (1 / z + options.depth_noise * random.normal());
    depth.at<float>(static_cast<int>(std::lround(keypoint.y)), static_cast<int>(std::lround(keypoint.x))) =
        static_cast<float>(z);
    raw.keypoints.push_back(keypoint);
    raw.descriptors.push_back(descriptor);
    view.points.push_back(p);
  }
  const FeatureSettings pyramid = scene_feature_settings();
  view.features = std::make_shared<FrameFeatures>(camera, std::move(raw), options.depth ? depth : cv::Mat(),
                                                  pyramid.scale_factor, pyramid.levels, options.pyramid);
  return view;
}

cv::Mat Scene::render(const Pose& cam_from_world) const {
  cv::Mat image(camera.height, camera.width, CV_8UC1);
  const Eigen::Vector3d centre = cam_from_world.centre();
  const Eigen::Matrix3d world_from_cam = cam_from_world.rotation_matrix().transpose();
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = world_from_cam * camera.unproject(Eigen::Vector2d(u, v), 1);
      const double to_wall = (kWall - centre.z()) / ray.z();
      const double to_left = ray.x() < 0 ? (kLeft - centre.x()) / ray.x() : 1e9;
      const double to_floor = ray.y() > 0 ? (kFloor - centre.y()) / ray.y() : 1e9;
      image.at<std::uint8_t>(v, u) = shade(centre + std::min({to_wall, to_left, to_floor}) * ray);
    }
  }
  return image;
}

bool Scene::see(const ScenePoint& point, const View& view, const ViewOptions& options, Random& random,
                Keypoint& keypoint, double& z) const {
  const FeatureSettings pyramid = scene_feature_settings();
  const double dx = random.normal(), dy = random.normal();
  const Eigen::Vector3d at_middle = view.cam_from_world * point.position;
  if (!(at_middle.z() > 0.3)) return false;
  const double level = point.size_level + std::log(3 / at_middle.norm()) / std::log(pyramid.scale_factor);
  keypoint.level = static_cast<std::uint8_t>(std::clamp<long>(std::lround(level), 0, pyramid.levels - 1));
  const double scale = std::pow(pyramid.scale_factor, keypoint.level);
  const Eigen::Vector2d ideal = view.motion.project(camera, at_middle);
  if (!(std::abs(ideal.x() - camera.cx) < camera.width && std::abs(ideal.y() - camera.cy) < camera.height))
    return false;
  z = view.motion.later(at_middle, view.motion.row_time(ideal.y())).z();
  Eigen::Vector2d raw = camera.distort(ideal) + options.pixel_noise * scale * Eigen::Vector2d(dx, dy);
  if (options.whole_pixels) {
    for (double& x : raw) x = (std::round((x + 0.5) / scale - 0.5) + 0.5) * scale - 0.5;
  }
  const double border = (kBorder + 1) * scale;
  keypoint.x = static_cast<float>(raw.x());
  keypoint.y = static_cast<float>(raw.y());
  keypoint.angle = point.angle;
  keypoint.quality = KeypointQuality::high;
  return raw.x() > border && raw.y() > border && raw.x() < camera.width - border &&
         raw.y() < camera.height - border;
}

bool Scene::crowded(const std::vector<Keypoint>& others, const Keypoint& keypoint) {
  return std::any_of(others.begin(), others.end(), [&](const Keypoint& other) {
    return std::abs(other.x - keypoint.x) < 6 && std::abs(other.y - keypoint.y) < 6;
  });
}

std::uint8_t Scene::shade(const Eigen::Vector3d& p) {
  const double a = p.x() + 0.7 * p.z(), b = p.y() - 0.6 * p.z();
  const double sum = std::sin(61 * a + 9 * b) + std::sin(-37 * a + 53 * b + 1) +
                     std::sin(97 * b - 19 * a + 2) + std::sin(83 * a + 71 * b + 3) +
                     std::sin(113 * a - 29 * b + 4);
  return static_cast<std::uint8_t>(128 + 22 * sum);
}

MappedScene::MappedScene(const Scene& room) : scene(room), landmarks(room.points.size()) {}

KeyframeId MappedScene::add_bare(const View& view) {
  views.push_back(view);
  const int frame = 10 * static_cast<int>(views.size() - 1);
  return atlas.add_keyframe({frame, frame / 30.0, view.cam_from_world, view.motion, view.features,
                             measure_keypoints(scene.camera, view.motion, *view.features), map});
}

void MappedScene::start_map() {
  map = atlas.next_map();
  landmarks.assign(landmarks.size(), {});
}

KeyframeId MappedScene::add(const View& view) {
  const KeyframeId id = add_bare(view);
  for (int i = 0; i < view.features->size(); ++i) {
    LandmarkId& landmark = landmarks[view.points[i]];
    if (!landmark.valid()) landmark = atlas.add_landmark(scene.points[view.points[i]].position, id);
    atlas.observe(id, i, landmark);
    atlas.refresh(landmark);
  }
  atlas.update_covisibility(id);
  return id;
}

}  // namespace stdc::test
