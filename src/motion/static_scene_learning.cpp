// What StaticScene learns about its views from later frames.
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "motion/grid_projection.hpp"
#include "motion/static_scene.hpp"

namespace stdc {

void StaticScene::learn(const SceneFrame& frame) {
  for (const std::size_t index : chosen_) learn_from(frame, views_[index]);
}

void StaticScene::doubt(const SceneFrame& frame, const std::vector<std::uint8_t>& moved) {
  for (const std::size_t index : chosen_) {
    SceneView& view = views_[index];
    const GridProjection project(view.view_from_world * frame.cam_from_world.inverse(), geometry_);
    for_cells(geometry_, 1, [&](int cell, int x, int y) {
      const float depth = frame.grid.depth[static_cast<std::size_t>(cell)];
      if (depth == 0 || moved[static_cast<std::size_t>(cell)] == 0) return;
      float there = 0;
      const int seen = project.cell(x, y, depth, there);
      if (seen < 0) return;
      const auto i = static_cast<std::size_t>(seen);
      if (std::abs(view.grid.depth[i] - there) > measured_tolerance(there)) return;
      if (view.rest[i] >= static_cast<float>(settings_.rest_time)) return;
      view.doubtful[i] = 1;
      view.rest[i] = 0;
    });
  }
}

void StaticScene::learn_from(const SceneFrame& frame, SceneView& view) {
  constexpr double kMaxStep = 0.2;                // [s] what lies between two comparisons was not seen
  constexpr float kLoss = 1.0F, kReserve = 2.0F;  // [s]
  const auto elapsed = static_cast<float>(std::min(frame.timestamp - view.checked, kMaxStep));
  view.checked = frame.timestamp;
  const float max_rest = static_cast<float>(settings_.rest_time) + kReserve;
  const GridProjection project(frame.cam_from_world * view.view_from_world.inverse(), geometry_);
  std::vector<int> again(view.rest.size(), -1);  // the cell of the frame that sees the same surface
  bool changed = false;
  for_cells(geometry_, 1, [&](int cell, int x, int y) {
    const auto i = static_cast<std::size_t>(cell);
    const float depth = view.grid.depth[i];
    if (depth == 0) return;
    float there = 0;
    const int seen = project.cell(x, y, depth, there);
    if (seen < 0) return;
    const float near = frame.grid.near[static_cast<std::size_t>(seen)];
    if (near == 0) return;
    const float tolerated = measured_tolerance(there);
    if (near > there + tolerated) {
      view.rest[i] -= kLoss;
      if (view.rest[i] >= 0) return;
      view.grid.depth[i] = 0;
      changed = true;
    } else if (frame.grid.far[static_cast<std::size_t>(seen)] > there - tolerated) {
      again[i] = seen;
    }
  });
  const std::vector<float> changes = changed_share(frame, view, again);
  constexpr float kMaxChanged = 0.12F;
  for (std::size_t i = 0; i < again.size(); ++i) {
    if (again[i] < 0) continue;
    // In doubt, looks count too: a flat thing that slides in its own plane keeps its depth.
    const bool slides = view.doubtful[i] != 0 && changes[i] > kMaxChanged;
    view.rest[i] = slides ? 0 : std::min(view.rest[i] + elapsed, max_rest);
  }
  if (changed) view.grid.find_extremes(geometry_.width(), geometry_.height());
}

/// Around each cell, of the cells that are seen again the share that looks otherwise: darker or brighter than
/// all of its neighbourhood did. Exposure may have changed as a whole.
std::vector<float> StaticScene::changed_share(const SceneFrame& frame, const SceneView& view,
                                              const std::vector<int>& again) const {
  const int width = geometry_.width(), height = geometry_.height();
  std::vector<float> share(again.size(), 0);
  if (frame.grid.grey.empty() || view.grid.grey.empty()) return share;
  bool in_doubt = false;
  for (std::size_t i = 0; i < again.size() && !in_doubt; ++i)
    in_doubt = again[i] >= 0 && view.doubtful[i] != 0;
  if (!in_doubt) return share;  // nobody will ask
  double sum_now = 1, sum_then = 1;
  for (std::size_t i = 0; i < again.size(); ++i) {
    if (again[i] < 0 || view.doubtful[i] != 0) continue;
    sum_now += frame.grid.grey[static_cast<std::size_t>(again[i])];
    sum_then += view.grid.grey[i];
  }
  const auto gain = static_cast<float>(std::clamp(sum_now / sum_then, 0.5, 2.0));
  cv::Mat changed(height, width, CV_8UC1, cv::Scalar(0)), compared = changed.clone();
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const auto i = geometry_.index(x, y);
      if (again[i] < 0) continue;
      const int darkest = view.darkest[i], brightest = view.brightest[i];
      constexpr float kNoise = 10;
      const float now = frame.grid.grey[static_cast<std::size_t>(again[i])];
      compared.at<std::uint8_t>(y, x) = 1;
      const bool other = now < gain * static_cast<float>(darkest) - kNoise ||
                         now > gain * static_cast<float>(brightest) + kNoise;
      changed.at<std::uint8_t>(y, x) = other ? 1 : 0;
    }
  }
  constexpr int kSide = 11;
  cv::Mat changed_sum, compared_sum;
  cv::boxFilter(changed, changed_sum, CV_32F, cv::Size(kSide, kSide), cv::Point(-1, -1), false);
  cv::boxFilter(compared, compared_sum, CV_32F, cv::Size(kSide, kSide), cv::Point(-1, -1), false);
  for (std::size_t i = 0; i < share.size(); ++i) {
    share[i] = changed_sum.ptr<float>()[i] / std::max(1.0F, compared_sum.ptr<float>()[i]);
  }
  return share;
}

}  // namespace stdc
