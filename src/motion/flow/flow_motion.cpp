#include "motion/flow/flow_motion.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/cell_mask.hpp"
#include "motion/flow/flow_corner.hpp"
#include "segmentation/propagation/patch_tracking.hpp"

namespace stdc {
namespace {

constexpr int kBin = 4;  // side of a square that gives one corner [cells]

/// The depth of a cell; beside an edge it may be that of any cell around.
void set_depth(const SmallFrame& frame, cv::Point at, FlowPoint& point) {
  const float depth = frame.depth_at(at.x, at.y);
  if (!(depth > 0)) return;
  point.inverse_depth = point.min_inverse_depth = point.max_inverse_depth = 1.0 / depth;
  for (int y = at.y - 2; y <= at.y + 2; ++y) {
    for (int x = at.x - 2; x <= at.x + 2; ++x) {
      const float there = frame.contains(x, y) ? frame.depth_at(x, y) : 0;
      if (!(there > 0)) continue;
      point.min_inverse_depth = std::min(point.min_inverse_depth, 1.0 / there);
      point.max_inverse_depth = std::max(point.max_inverse_depth, 1.0 / there);
    }
  }
}

/// Of each cell whether something that moved a frame ago is there now.
std::vector<std::uint8_t> cells_of_tiles(const SmallFrame& frame, const std::vector<MaskTile>& tiles) {
  std::vector<std::uint8_t> cells(frame.depth.size(), 0);
  for (const MaskTile& tile : tiles) {
    const int left = static_cast<int>(std::lround(static_cast<float>(tile.x) + tile.shift.x()));
    const int top = static_cast<int>(std::lround(static_cast<float>(tile.y) + tile.shift.y()));
    for (int y = top; y < top + MaskTile::kSide; ++y) {
      for (int x = left; x < left + MaskTile::kSide; ++x) {
        if (frame.contains(x, y)) cells[static_cast<std::size_t>(y * frame.width() + x)] = 1;
      }
    }
  }
  return cells;
}

}  // namespace

FlowMotion::FlowMotion(const Camera& camera, const MotionSettings& settings)
    : camera_(camera), settings_(settings) {
  check_ranges("motion", settings_);
}

std::vector<LandmarkId> FlowMotion::observe(const MotionFrame& frame, const SmallFrame& small,
                                            const std::vector<MaskTile>& tiles) {
  depth_ = frame.depth;
  scale_ = small.scale;
  moving_.assign(small.depth.size(), 0);
  if (!recent_.empty()) {
    const std::vector<std::uint8_t> moved = cells_of_tiles(small, tiles);
    const std::vector<std::uint8_t> segmented = squares_of_mask(frame.segmented, scale_, camera_);
    std::vector<Corner> corners = follow_corners(small, recent_.front(), moved, segmented);
    std::vector<FlowPoint> points;
    for (const Corner& corner : corners) points.push_back(corner.flow);
    const double threshold = settings_.flow_threshold / std::sqrt(camera_.fx * camera_.fy);
    const auto flow =
        fit_static_flow(points, threshold, static_cast<std::uint64_t>(settings_.flow_seed), last_flow_);
    last_flow_ = flow.value_or(StaticFlow());
    if (flow) {
      judge(*flow, threshold, corners);
      complete(small, corners, moved);
    }
  }
  recent_.push_back(small);
  if (recent_.size() > static_cast<std::size_t>(settings_.flow_lag)) recent_.pop_front();
  return {};
}

std::vector<FlowMotion::Corner> FlowMotion::follow_corners(const SmallFrame& now, const SmallFrame& then,
                                                           const std::vector<std::uint8_t>& moved,
                                                           const std::vector<std::uint8_t>& segmented) const {
  constexpr int kRim = 2;  // [cells]
  std::vector<Corner> corners;
  for (int top = kRim; top + kBin <= now.height() - kRim; top += kBin) {
    for (int left = kRim; left + kBin <= now.width() - kRim; left += kBin) {
      Corner corner;
      FlowCorner found;
      if (!find_corner(now, {left, top, kBin, kBin}, found)) continue;
      corner.at = found.at;
      corner.flow.certainty = found.certainty;
      Eigen::Vector2f flow = Eigen::Vector2f::Zero();
      const float surface = same_surface(now.depth_at(corner.at.x, corner.at.y));
      if (!follow_patch(now, then, corner.at, flow, surface)) continue;
      const Eigen::Vector2f here(static_cast<float>(corner.at.x), static_cast<float>(corner.at.y));
      const auto cell = static_cast<std::size_t>(corner.at.y * now.width() + corner.at.x);
      corner.flow.here = ray_of(here, now.scale);
      corner.flow.there = ray_of(here + flow, now.scale);
      set_depth(now, corner.at, corner.flow);
      corner.flow.usable = moved[cell] == 0 && segmented[cell] == 0;
      corner.moved = moved[cell] != 0;
      corners.push_back(corner);
    }
  }
  return corners;
}

Eigen::Vector2d FlowMotion::ray_of(const Eigen::Vector2f& cell, int scale) const {
  const Eigen::Vector2d raw = cell.cast<double>() * scale + Eigen::Vector2d::Constant(0.5 * (scale - 1));
  const Eigen::Vector2d ideal = camera_.undistort(raw);
  return {(ideal.x() - camera_.cx) / camera_.fx, (ideal.y() - camera_.cy) / camera_.fy};
}

/// The longer the flow, the more blur and the change of view spoil it.
void FlowMotion::judge(const StaticFlow& flow, double threshold, std::vector<Corner>& corners) const {
  constexpr double kNoise = 4, kStay = 0.6;  // medians; what moved needs less to move on
  constexpr double kShare = 0.05;            // of the flow's length
  const double limit = std::max(threshold, kNoise * flow.sigma);
  for (Corner& corner : corners) {
    const double allowed = limit + kShare * (corner.flow.there - corner.flow.here).norm();
    corner.moves = flow.residual(corner.flow) > (corner.moved ? kStay * allowed : allowed);
  }
}

/// From points to regions.
void FlowMotion::complete(const SmallFrame& now, const std::vector<Corner>& corners,
                          const std::vector<std::uint8_t>& moved) {
  constexpr int kReach = 10, kMinSame = 2;  // [cells]; others that confirm a moving point
  constexpr float kMinConfirmed = 0.3F;     // share of a region
  const int width = now.width(), height = now.height();
  std::vector<GrowthSeed> all(now.depth.size(), GrowthSeed::none);
  for (const Corner& corner : corners) {
    all[static_cast<std::size_t>(corner.at.y * width + corner.at.x)] =
        corner.moves ? GrowthSeed::moving : GrowthSeed::resting;
  }
  const std::vector<GrowthSeed> kept = keep_majority(width, height, now.depth, all, kReach, kMinSame);
  std::vector<std::uint8_t> cells = grow_in_depth(width, height, now.depth, kept, {.reach = 40});
  std::vector<std::uint8_t> confirmed = moved;
  for (std::size_t i = 0; i < candidates_.size(); ++i) confirmed[i] |= candidates_[i];
  candidates_ = cells;
  keep_patches(
      width, height, all, confirmed,
      [&](const MovingPatch& patch) {
        return patch.moving_seeds >= std::max(settings_.flow_min_points, 2 * patch.resting_seeds) &&
               static_cast<float>(patch.confirmed) >= kMinConfirmed * static_cast<float>(patch.cells);
      },
      cells);
  moving_ = std::move(cells);
}

cv::Mat FlowMotion::mask() const {
  if (moving_.empty()) return cv::Mat(camera_.height, camera_.width, CV_8UC1, cv::Scalar(0));
  return mask_of_squares(moving_, scale_, camera_, depth_);
}

}  // namespace stdc
