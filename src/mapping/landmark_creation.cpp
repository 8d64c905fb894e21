#include "mapping/landmark_creation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "atlas/landmark_alignment.hpp"
#include "core/multiversion.hpp"
#include "estimation/triangulation.hpp"
#include "features/description/hamming.hpp"
#include "features/description/matching.hpp"

namespace stdc {
namespace {

constexpr double kChiSquare1 = 3.841, kChiSquare2 = 5.991;  // 95 %

/// One side of a pair of keyframes.
struct View {
  KeyframeId id;
  const FrameFeatures* features = nullptr;
  const std::vector<Measurement>* measurements = nullptr;
  Pose cam_from_world;
  std::vector<int> free;  ///< keypoints without a landmark

  const Eigen::Vector2f& pixel(int keypoint) const { return (*measurements)[keypoint].pixel; }
  float depth(int keypoint) const { return (*measurements)[keypoint].depth; }
};

View make_view(const Atlas& atlas, KeyframeId id) {
  const Keyframe& keyframe = atlas.keyframe(id);
  View view{id, keyframe.features.get(), &keyframe.measurements, keyframe.cam_from_world, {}};
  for (int i = 0; i < keyframe.features->size(); ++i) {
    if (!keyframe.landmarks[i].valid()) view.free.push_back(i);
  }
  return view;
}

/// The fundamental matrix F with x_b^T F x_a = 0 for ideal pixels (Hartley and Zisserman, ch. 9).
Eigen::Matrix3f fundamental(const Camera& camera, const View& a, const View& b) {
  const Pose b_from_a = b.cam_from_world * a.cam_from_world.inverse();
  Eigen::Matrix3d inverse_k = Eigen::Matrix3d::Identity();
  inverse_k << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy, 0, 0, 1;
  return (inverse_k.transpose() * skew(b_from_a.translation) * b_from_a.rotation_matrix() * inverse_k)
      .cast<float>();
}

/// For each free keypoint of `a` the nearest free one of `b` on its epipolar line; one to one.
STDC_POPCNT_VERSIONS
std::vector<KeypointPair> match_along_epipolars(const Camera& camera, const View& a, const View& b,
                                                const NoiseSettings& noise, int max_distance) {
  const Eigen::Matrix3f f = fundamental(camera, a, b);
  const float gate = static_cast<float>(kChiSquare1 * noise.pixel_sigma * noise.pixel_sigma);
  std::vector<KeypointPair> pairs;
  std::vector<float> rotations;
  std::vector<std::uint8_t> taken(b.features->size(), 0);
  for (const int i : a.free) {
    const Eigen::Vector3f line = f * a.pixel(i).homogeneous();
    const float norm2 = line.head<2>().squaredNorm();
    int best = -1, min_bits = max_distance + 1;
    for (const int j : b.free) {
      if (taken[j] != 0 || std::abs(a.features->keypoint(i).level - b.features->keypoint(j).level) > 2)
        continue;
      const float distance = line.dot(b.pixel(j).homogeneous());
      const float scale = b.features->scale_of(j);
      if (distance * distance > gate * scale * scale * norm2) continue;
      const int bits = hamming_distance(a.features->descriptor(i), b.features->descriptor(j));
      if (bits >= min_bits) continue;
      min_bits = bits;
      best = j;
    }
    if (best < 0) continue;
    taken[best] = 1;
    pairs.push_back({i, best});
    rotations.push_back(a.features->keypoint(i).angle - b.features->keypoint(best).angle);
  }
  const auto keep = consistent_rotations(rotations);
  std::size_t kept = 0;
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    if (keep[n] != 0) pairs[kept++] = pairs[n];
  }
  pairs.resize(kept);
  return pairs;
}

/// Whether a keyframe's keypoint may well see a point: in front, near the pixel, and at the measured depth.
bool agrees(const Camera& camera, const View& view, int keypoint, const Eigen::Vector3d& position,
            const NoiseSettings& noise) {
  const Eigen::Vector3d point = view.cam_from_world * position;
  if (!(point.z() > 0)) return false;
  const double sigma = noise.pixel_sigma * view.features->scale_of(keypoint);
  const Eigen::Vector2d residual = camera.project(point) - view.pixel(keypoint).cast<double>();
  if (!(residual.squaredNorm() <= kChiSquare2 * sigma * sigma)) return false;
  const double z = view.depth(keypoint);
  if (z <= 0) return true;
  const double inverse_residual = (1 / z - 1 / point.z()) / noise.inverse_depth_sigma;
  return inverse_residual * inverse_residual <= kChiSquare1;
}

std::optional<Eigen::Vector3d> from_depth(const Camera& camera, const View& view, int keypoint) {
  const float z = view.depth(keypoint);
  if (z <= 0) return {};
  return view.cam_from_world.inverse() * camera.unproject(view.pixel(keypoint).cast<double>(), z);
}

std::optional<Eigen::Vector3d> locate(const Camera& camera, const View& a, const View& b,
                                      const KeypointPair& pair, double min_parallax_deg) {
  const Eigen::Vector3d ray_a = camera.unproject(a.pixel(pair.first).cast<double>(), 1);
  const Eigen::Vector3d ray_b = camera.unproject(b.pixel(pair.second).cast<double>(), 1);
  const Eigen::Vector3d in_world_a = a.cam_from_world.rotation.conjugate() * ray_a;
  const Eigen::Vector3d in_world_b = b.cam_from_world.rotation.conjugate() * ray_b;
  const double angle = std::atan2(in_world_a.cross(in_world_b).norm(), in_world_a.dot(in_world_b));
  if (angle * 180 / 3.141592653589793 >= min_parallax_deg) {
    return triangulate(a.cam_from_world, ray_a, b.cam_from_world, ray_b);
  }
  const auto position = from_depth(camera, a, pair.first);
  return position ? position : from_depth(camera, b, pair.second);
}

/// The sizes at which the two see the point must fit their distances from it.
bool scales_agree(const View& a, const View& b, const KeypointPair& pair, const Eigen::Vector3d& position) {
  const double distances =
      (position - a.cam_from_world.centre()).norm() / (position - b.cam_from_world.centre()).norm();
  const double scales = b.features->scale_of(pair.second) / a.features->scale_of(pair.first);
  const double tolerance = 1.5 * std::exp(a.features->log_scale_factor());
  return distances < scales * tolerance && scales < distances * tolerance;
}

/// The older of the two observations defines the landmark, the younger is aligned to it.
void anchor_new(Atlas& atlas, const SensorModel& sensor, LandmarkId id) {
  const std::vector<Observation>& observations = atlas.landmark(id).observations;
  const Observation& oldest = observations.front();
  const Keyframe& keyframe = atlas.keyframe(oldest.keyframe);
  Measurement measurement = keyframe.measurements[oldest.keypoint];
  measurement.scale = keyframe.features->scale_of(oldest.keypoint) * sensor.aligned_scale();
  atlas.set_measurement(oldest.keyframe, oldest.keypoint, measurement);
  align_observation(atlas, sensor, id, observations.back().keyframe);
}

}  // namespace

int create_landmarks(Atlas& atlas, KeyframeId keyframe, const SensorModel& sensor,
                     const MappingSettings& settings) {
  constexpr double kMinBaseline = 0.02;  // [m]; below it the epipolar lines say nothing
  int created = 0;
  const std::vector<Covisible> covisible = atlas.keyframe(keyframe).covisible;
  const std::size_t neighbours = std::min<std::size_t>(covisible.size(), settings.neighbours);
  for (std::size_t n = 0; n < neighbours; ++n) {
    const View a = make_view(atlas, keyframe);
    const View b = make_view(atlas, covisible[n].keyframe);
    if ((a.cam_from_world.centre() - b.cam_from_world.centre()).norm() < kMinBaseline) continue;
    for (const KeypointPair& pair :
         match_along_epipolars(sensor.camera, a, b, sensor.noise, settings.max_hamming_distance)) {
      const auto position = locate(sensor.camera, a, b, pair, settings.min_parallax);
      if (!position || !position->allFinite()) continue;
      if (!agrees(sensor.camera, a, pair.first, *position, sensor.noise) ||
          !agrees(sensor.camera, b, pair.second, *position, sensor.noise) ||
          !scales_agree(a, b, pair, *position)) {
        continue;
      }
      const LandmarkId landmark = atlas.add_landmark(*position, keyframe);
      atlas.observe(a.id, pair.first, landmark);
      atlas.observe(b.id, pair.second, landmark);
      atlas.refresh(landmark);
      anchor_new(atlas, sensor, landmark);
      ++created;
    }
  }
  return created;
}

}  // namespace stdc
