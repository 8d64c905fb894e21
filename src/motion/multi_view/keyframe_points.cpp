#include "motion/multi_view/keyframe_points.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace stdc {
namespace {

constexpr int kPointBin = 3;  // side of a square [cells]

/// The best cell of a square; -1: none will do.
int best_cell(const GridGeometry& geometry, const DepthGrid& grid, const std::vector<std::uint8_t>& dynamic,
              int left, int top) {
  constexpr int kMinContrast = 8;      // [grey levels], both ways together
  constexpr float kMaxSpread = 0.04F;  // of the depths around, as a share of them
  const int width = geometry.width();
  int best = -1, contrast = kMinContrast - 1;
  for (int y = top; y < top + kPointBin; ++y) {
    for (int x = left; x < left + kPointBin; ++x) {
      const int cell = y * width + x;
      const auto i = static_cast<std::size_t>(cell), stride = static_cast<std::size_t>(width);
      if (grid.depth[i] == 0 || dynamic[i] != 0) continue;
      if (grid.far[i] - grid.near[i] > kMaxSpread * grid.depth[i]) continue;
      const int here = std::abs(grid.grey[i + 1] - grid.grey[i - 1]) +
                       std::abs(grid.grey[i + stride] - grid.grey[i - stride]);
      if (here <= contrast) continue;
      contrast = here;
      best = cell;
    }
  }
  return best;
}

/// Of every few points of a keyframe how many a frame sees.
int points_in_view(const GridGeometry& geometry, const KeyframePoints& keyframe, const Pose& cam_from_world) {
  constexpr std::size_t kStep = 8;
  constexpr float kMinDepth = 0.1F;
  const Pose motion = cam_from_world * keyframe.keyframe_from_world.inverse();
  const Eigen::Matrix3f rotation = motion.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = motion.translation.cast<float>();
  int count = 0;
  for (std::size_t i = 0; i < keyframe.points.size(); i += kStep) {
    const Eigen::Vector3f point = rotation * keyframe.points[i] + translation;
    if (!(point.z() > kMinDepth)) continue;
    const float x = geometry.focal_x() * point.x() / point.z() + geometry.centre_x();
    const float y = geometry.focal_y() * point.y() / point.z() + geometry.centre_y();
    const bool inside = x >= 0 && y >= 0 && x < static_cast<float>(geometry.width()) &&
                        y < static_cast<float>(geometry.height());
    count += inside ? 1 : 0;
  }
  return count;
}

}  // namespace

std::vector<Eigen::Vector3f> choose_points(const GridGeometry& geometry, const DepthGrid& grid,
                                           const std::vector<std::uint8_t>& dynamic) {
  std::vector<Eigen::Vector3f> points;
  for (int y = 1; y + kPointBin < geometry.height(); y += kPointBin) {
    for (int x = 1; x + kPointBin < geometry.width(); x += kPointBin) {
      const int cell = best_cell(geometry, grid, dynamic, x, y);
      if (cell < 0) continue;
      const float depth = grid.depth[static_cast<std::size_t>(cell)];
      points.emplace_back(geometry.ray_x(cell % geometry.width()) * depth,
                          geometry.ray_y(cell / geometry.width()) * depth, depth);
    }
  }
  return points;
}

void KeyframeStore::follow(const AtlasSnapshot& snapshot) {
  std::erase_if(keyframes_,
                [&](const KeyframePoints& keyframe) { return !snapshot.is_kept(keyframe.reference); });
  for (KeyframePoints& keyframe : keyframes_) {
    keyframe.keyframe_from_world =
        snapshot.cam_from_world(keyframe.reference, keyframe.keyframe_from_reference);
    keyframe.map = snapshot.keyframes()[keyframe.reference.value].map;
  }
}

void KeyframeStore::add(KeyframePoints keyframe) {
  if (keyframe.points.empty()) return;
  keyframes_.push_back(std::move(keyframe));
  if (keyframes_.size() > static_cast<std::size_t>(max_keyframes_)) keyframes_.erase(keyframes_.begin());
}

bool KeyframeStore::has(int frame) const {
  return std::any_of(keyframes_.begin(), keyframes_.end(),
                     [&](const KeyframePoints& keyframe) { return keyframe.frame == frame; });
}

std::vector<const KeyframePoints*> KeyframeStore::overlapping(const GridGeometry& geometry,
                                                              const Pose& cam_from_world, MapId map,
                                                              int count) const {
  std::vector<std::pair<int, const KeyframePoints*>> candidates;
  for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe) {
    if (keyframe->map != map) continue;
    const int in_view = points_in_view(geometry, *keyframe, cam_from_world);
    if (in_view > 0) candidates.emplace_back(in_view, &*keyframe);
  }
  // Of equals the newest.
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const KeyframePoints*> chosen;
  for (std::size_t i = 0; i < candidates.size() && i < static_cast<std::size_t>(count); ++i) {
    chosen.push_back(candidates[i].second);
  }
  return chosen;
}

}  // namespace stdc
