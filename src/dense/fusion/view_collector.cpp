#include "dense/fusion/view_collector.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core.hpp>

#include "dense/fusion/depth_cleaning.hpp"
#include "dense/fusion/view_codec.hpp"

namespace stdc {

void ViewPlanner::plan(const AtlasSnapshot& snapshot, DenseFrame& frame) {
  if (window_ && window_->frames < settings_.window &&
      snapshot.keyframes()[window_->reference.value].map == snapshot.keyframes()[frame.reference.value].map) {
    const Pose first = snapshot.cam_from_world(window_->reference, window_->cam_from_reference);
    frame.frame_from_window =
        snapshot.cam_from_world(frame.reference, frame.cam_from_reference) * first.inverse();
    const Vector6d motion = frame.frame_from_window.log();
    if (motion.head<3>().norm() <= settings_.window_translation &&
        motion.tail<3>().norm() <= settings_.window_rotation * std::numbers::pi / 180) {
      frame.starts_view = false;
      ++window_->frames;
      return;
    }
  }
  frame.starts_view = true;
  frame.world_from_cam = snapshot.cam_from_world(frame.reference, frame.cam_from_reference).inverse();
  frame.map = snapshot.keyframes()[frame.reference.value].map;
  window_ = Window{frame.reference, frame.cam_from_reference, 1};
}

namespace {

cv::Mat united(const cv::Mat& a, const cv::Mat& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return a | b;
}

}  // namespace

ViewCollector::ViewCollector(const Camera& camera, const DenseSettings& settings)
    : settings_(settings), rectifier_(camera) {}

void ViewCollector::add(const DenseFrame& frame) {
  // Cut off further away than what is used: to keep the nearer half of a noisy surface would draw it nearer.
  constexpr float kReserve = 1.25F;
  const cv::Mat raw = rectifier_.depth(frame.depth, kReserve * static_cast<float>(settings_.max_depth));
  const CleanDepth depth = clean_depth(raw, rectified(united(frame.dynamic, frame.moving)),
                                       rectified(frame.doubtful), settings_.margin);
  if (!frame.starts_view && open_) {
    open_->window.add(depth, frame.frame_from_window);
    return;
  }
  close();
  DenseView view;
  view.reference = frame.reference;
  view.cam_from_reference = frame.cam_from_reference;
  view.frame = frame.frame;
  view.timestamp = frame.timestamp;
  open_.emplace(OpenView{std::move(view), rectifier_.colour(frame.colour), frame.world_from_cam, frame.map,
                         DepthWindow(pinhole(), depth)});
}

cv::Mat ViewCollector::rectified(const cv::Mat& mask) const {
  constexpr std::uint8_t kOutside = 0;
  return mask.empty() ? mask : rectifier_.mask(mask, kOutside);
}

std::shared_ptr<const DenseView> ViewCollector::encoded(const OpenView& open) const {
  auto view = std::make_shared<DenseView>(open.view);
  encode_view(open.window.fused(), static_cast<float>(settings_.max_depth), open.colour, *view);
  return view;
}

void ViewCollector::close() {
  if (!open_) return;
  kept_.push_back({encoded(*open_), ViewCoverage::cells_of(open_->window.fused(), pinhole(),
                                                           open_->world_from_cam, open_->map)});
  coverage_.add(kept_.back().cells);
  open_.reset();
  ++closed_;
  drop_redundant();
}

/// One for each that comes is enough to keep their number bounded. The newest stay: they show what has
/// changed.
void ViewCollector::drop_redundant() {
  constexpr std::ptrdiff_t kNewest = 5;
  for (auto kept = kept_.begin(); kept_.end() - kept > kNewest; ++kept) {
    if (!coverage_.is_redundant(kept->cells, settings_.overlap)) continue;
    coverage_.remove(kept->cells);
    kept_.erase(kept);
    return;
  }
}

void ViewCollector::set_views(const std::vector<PlacedView>& views, MapId map) {
  for (const PlacedView& placed : views) {
    const FusedDepth fused = decode_depth(*placed.view, {pinhole().width, pinhole().height});
    kept_.push_back({placed.view, {}});
    if (fused.depth.empty()) continue;
    kept_.back().cells = ViewCoverage::cells_of(fused, pinhole(), placed.cam_from_world.inverse(), map);
    coverage_.add(kept_.back().cells);
  }
}

DenseViews ViewCollector::closed_views() const {
  DenseViews all;
  for (const Kept& kept : kept_) all.push_back(kept.view);
  return all;
}

DenseViews ViewCollector::views() const {
  DenseViews all = closed_views();
  if (open_) all.push_back(encoded(*open_));
  return all;
}

}  // namespace stdc
