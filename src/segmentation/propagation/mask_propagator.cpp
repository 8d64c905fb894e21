#include "segmentation/propagation/mask_propagator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/mask_warp.hpp"

namespace stdc {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;

void check_image(const cv::Mat& image, const Camera& camera, const char* name, bool right_kind) {
  if (right_kind && image.cols == camera.width && image.rows == camera.height) return;
  throw Error(
      name, fmt::format("is {} x {} pixels of type {}", image.cols, image.rows, image.type()),
      fmt::format("give an image of the camera's size, {} x {}, as documented", camera.width, camera.height));
}

}  // namespace

MaskPropagator::MaskPropagator(const Camera& camera, const PropagationSettings& settings)
    : camera_(camera), settings_(settings) {
  check_ranges("propagation", settings_);
}

void MaskPropagator::add_frame(int frame, const cv::Mat& grey, const cv::Mat& depth,
                               const std::optional<Pose>& frame_from_last) {
  check_image(grey, camera_, "grey", grey.type() == CV_8UC1);
  check_image(depth, camera_, "depth", depth.type() == CV_16UC1 || depth.type() == CV_32FC1);
  if (!steps_.empty() && frame <= steps_.back().frame.number) {
    throw Error("frame", fmt::format("number {} does not follow {}", frame, steps_.back().frame.number),
                "add the frames in their order");
  }
  // The oldest step's memory is used again.
  Step step;
  if (static_cast<int>(steps_.size()) >= settings_.history) {
    step = std::move(steps_.front());
    steps_.pop_front();
  }
  shrink_frame(grey, depth, camera_.depth_units_per_metre, step.frame);
  step.frame.number = frame;
  step.motion.reset(step.frame.width(), step.frame.height());
  step.frame_from_last = frame_from_last;
  steps_.push_back(std::move(step));
  depth_ = depth;
  if (has_mask() && steps_.size() > 1) advance(steps_[steps_.size() - 2].frame, steps_.back());
}

bool MaskPropagator::set_mask(int frame, const cv::Mat& mask) {
  check_image(mask, camera_, "mask", mask.type() == CV_8UC1);
  const auto step =
      std::find_if(steps_.begin(), steps_.end(), [frame](const Step& s) { return s.frame.number == frame; });
  if (step == steps_.end() || frame < mask_frame_) return false;
  cv::compare(mask, 0, original_, cv::CMP_NE);  // into the memory it has
  mask_frame_ = frame;
  tiles_ = make_tiles(original_, step->frame);
  for (auto next = step + 1; next != steps_.end(); ++next) advance((next - 1)->frame, *next);
  return true;
}

void MaskPropagator::advance(const SmallFrame& from, Step& to) {
  constexpr float kOutside = 8;  // [cells] beyond the edge nothing comes back
  to.motion.cover(tiles_, from, to.frame);
  for (MaskTile& tile : tiles_) carry(tile, to);
  const auto width = static_cast<float>(to.frame.width()), height = static_cast<float>(to.frame.height());
  std::erase_if(tiles_, [&](const MaskTile& tile) {
    const Vector2f middle = tile.middle();
    return !(middle.x() > -kOutside && middle.y() > -kOutside && middle.x() < width + kOutside &&
             middle.y() < height + kOutside);
  });
}

/// Moves a tile to the next frame.
void MaskPropagator::carry(MaskTile& tile, const Step& to) const {
  constexpr float kSameSurface = 0.2F;  // [m]
  MotionField::Motion motion;
  const Vector2f middle = tile.middle();
  tile.measured = to.motion.at(middle, tile.depth, motion);
  if (!tile.measured && to.frame_from_last && tile.depth != 0) {
    // Nothing to follow there: as if it stood still before the moving camera.
    const double scale = to.frame.scale, half = 0.5 * (scale - 1);
    const Vector2d raw = middle.cast<double>() * scale + Vector2d::Constant(half);
    const Eigen::Vector3d moved =
        *to.frame_from_last * camera_.unproject(camera_.undistort(raw), static_cast<double>(tile.depth));
    if (moved.z() > 0.1) {
      const Vector2d there = camera_.distort(camera_.project(moved));
      motion.flow = ((there - raw) / scale).cast<float>();
      motion.approach = static_cast<float>(moved.z()) - tile.depth;
    }
  }
  tile.shift += motion.flow;
  tile.velocity = motion.flow;
  if (tile.depth == 0) return;
  tile.depth += motion.approach;
  const Vector2f now = tile.middle();
  const int x = static_cast<int>(std::lround(now.x())), y = static_cast<int>(std::lround(now.y()));
  if (!to.frame.contains(x, y)) return;
  const float seen = to.frame.depth_at(x, y);
  if (seen != 0 && std::abs(seen - tile.depth) < kSameSurface) tile.depth = seen;
}

cv::Mat MaskPropagator::mask() const {
  if (!has_mask()) return {};
  const SmallFrame& newest = steps_.back().frame;
  if (newest.number == mask_frame_) return original_.clone();
  MaskWarp warp;
  warp.metres_per_unit = static_cast<float>(1 / camera_.depth_units_per_metre);
  warp.margin = static_cast<float>(settings_.growth) * static_cast<float>(age());
  warp.depth_tolerance =
      static_cast<float>(settings_.depth_tolerance + settings_.depth_growth * static_cast<double>(age()));
  return warp_mask(original_, tiles_, newest, depth_, warp);
}

int MaskPropagator::age() const { return has_mask() ? steps_.back().frame.number - mask_frame_ : 0; }

}  // namespace stdc
