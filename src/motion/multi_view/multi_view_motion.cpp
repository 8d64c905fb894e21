#include "motion/multi_view/multi_view_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "motion/cell_mask.hpp"

namespace stdc {
namespace {

/// Where a frame sees the points of a keyframe.
struct PointProjection {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;  // also the centre of the keyframe's camera, in the frame
  float min_cosine;             // of the parallax

  PointProjection(const Pose& frame_from_keyframe, double max_parallax)
      : rotation(frame_from_keyframe.rotation_matrix().cast<float>()),
        translation(frame_from_keyframe.translation.cast<float>()),
        min_cosine(static_cast<float>(std::cos(max_parallax))) {}

  bool is_parallax_small(const Eigen::Vector3f& point) const {
    const Eigen::Vector3f other = point - translation;
    return point.dot(other) >= min_cosine * point.norm() * other.norm();
  }
};

}  // namespace

MultiViewMotion::MultiViewMotion(const Camera& camera, const MotionSettings& settings)
    : camera_(camera),
      settings_(settings),
      geometry_(camera),
      keyframes_(settings.multi_view_max_keyframes),
      moving_(static_cast<std::size_t>(geometry_.size()), 0) {
  check_ranges("motion", settings_);
}

void MultiViewMotion::follow(const AtlasSnapshot& snapshot) {
  const auto& keyframes = snapshot.keyframes();
  const bool has_grown = keyframes.size() > known_keyframes_;
  known_keyframes_ = keyframes.size();
  if (last_ && has_grown && !keyframes_.has(last_->frame)) {
    const KeyframeId newest{static_cast<std::uint32_t>(keyframes.size() - 1)};
    if (snapshot.is_kept(newest) && keyframes.back().frame == last_->frame) {
      last_->reference = newest;
      last_->keyframe_from_reference = Pose();
      keyframes_.add(*std::exchange(last_, std::nullopt));
    }
  }
  keyframes_.follow(snapshot);
}

std::vector<LandmarkId> MultiViewMotion::observe(const MotionFrame& frame, const SmallFrame& small,
                                                 const std::vector<MaskTile>& /*tiles*/) {
  depth_ = frame.depth;
  last_.reset();
  std::fill(moving_.begin(), moving_.end(), std::uint8_t{0});
  if (!frame.cam_from_world) return {};
  DepthGrid grid = sample_grid(geometry_, camera_, frame.motion, frame.depth, settings_.time_tolerance);
  grid.grey = sample_grey(geometry_, small.levels[0]);
  find_moving(grid, *frame.cam_from_world, frame.map);
  if (!frame.trusted) return {};
  std::vector<std::uint8_t> dynamic = cells_of_mask(frame.segmented, geometry_);
  for (std::size_t i = 0; i < dynamic.size(); ++i) dynamic[i] |= moving_[i];
  last_ = KeyframePoints{frame.number,          frame.reference, frame.frame_from_reference,
                         *frame.cam_from_world, frame.map,       choose_points(geometry_, grid, dynamic)};
  // A map that was loaded comes without images: where it has none, frames take the place of keyframes.
  if (frame.is_keyframe || keyframes_.overlapping(geometry_, *frame.cam_from_world, frame.map, 1).empty()) {
    keyframes_.add(*last_);
  }
  return {};
}

void MultiViewMotion::find_moving(const DepthGrid& grid, const Pose& cam_from_world, MapId map) {
  const std::vector<GrowthSeed> known = seeds(grid, cam_from_world, map);
  moving_ = grow_in_depth(geometry_.width(), geometry_.height(), grid.depth, known, {.reach = 40});
  const auto is_wanted = [&](const MovingPatch& patch) {
    return patch.moving_seeds >= settings_.multi_view_min_points;
  };
  keep_patches(geometry_.width(), geometry_.height(), known, moving_, is_wanted, moving_);
}

std::vector<GrowthSeed> MultiViewMotion::seeds(const DepthGrid& grid, const Pose& cam_from_world,
                                               MapId map) const {
  const auto tau = static_cast<float>(settings_.multi_view_tau);
  std::vector<int> votes(grid.depth.size(), 0);
  const double max_parallax = settings_.multi_view_parallax * std::numbers::pi / 180;
  for (const KeyframePoints* keyframe :
       keyframes_.overlapping(geometry_, cam_from_world, map, settings_.multi_view_keyframes)) {
    const PointProjection project(cam_from_world * keyframe->keyframe_from_world.inverse(), max_parallax);
    for (const Eigen::Vector3f& seen : keyframe->points) {
      const Eigen::Vector3f point = project.rotation * seen + project.translation;
      const int seen_at = geometry_.cell_of(point);
      if (seen_at < 0 || !project.is_parallax_small(point)) continue;
      const auto cell = static_cast<std::size_t>(seen_at);
      if (grid.depth[cell] == 0) continue;
      const float tolerance = static_cast<float>(settings_.depth_tolerance) +
                              static_cast<float>(settings_.depth_tolerance_growth) * point.z() * point.z();
      if (point.z() - grid.far[cell] > tau) {
        if (!is_uncertain(grid, seen_at % geometry_.width(), seen_at / geometry_.width())) ++votes[cell];
      } else if (point.z() > grid.near[cell] - tolerance && point.z() < grid.far[cell] + tolerance) {
        --votes[cell];
      }
    }
  }
  std::vector<GrowthSeed> result(votes.size(), GrowthSeed::none);
  for (std::size_t i = 0; i < votes.size(); ++i) {
    if (votes[i] != 0) result[i] = votes[i] > 0 ? GrowthSeed::moving : GrowthSeed::resting;
  }
  constexpr int kReach = 10, kMinSame = 1;  // [cells]; others that confirm a dynamic point
  return keep_majority(geometry_.width(), geometry_.height(), grid.depth, result, kReach, kMinSame);
}

/// Whether the depth around a cell varies so much that the cell may be on an outline.
bool MultiViewMotion::is_uncertain(const DepthGrid& grid, int x, int y) const {
  constexpr int kReach = 2;
  constexpr float kMaxVariance = 0.15F * 0.15F;  // [m^2]
  float sum = 0, squares = 0, count = 0;
  for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, geometry_.height() - 1); ++v) {
    for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, geometry_.width() - 1); ++u) {
      const float depth = grid.depth[static_cast<std::size_t>(v * geometry_.width() + u)];
      if (depth == 0) continue;
      sum += depth;
      squares += depth * depth;
      ++count;
    }
  }
  const float mean = sum / std::max(count, 1.0F);
  return squares / std::max(count, 1.0F) - mean * mean > kMaxVariance;
}

cv::Mat MultiViewMotion::mask() const {
  return mask_of_squares(squares_of_cells(moving_, geometry_), geometry_.scale(), camera_, depth_);
}

}  // namespace stdc
