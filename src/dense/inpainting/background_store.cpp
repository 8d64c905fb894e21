#include "dense/inpainting/background_store.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

constexpr int kCoarse = 16;  ///< [px] cells in which the hidden region is counted

/// Cells of the region, 1 to be filled.
cv::Mat coarse_region(const cv::Mat& region) {
  cv::Mat coarse((region.rows + kCoarse - 1) / kCoarse, (region.cols + kCoarse - 1) / kCoarse, CV_8UC1,
                 cv::Scalar(0));
  for (int y = 0; y < region.rows; ++y) {
    const std::uint8_t* row = region.ptr<std::uint8_t>(y);
    std::uint8_t* out = coarse.ptr<std::uint8_t>(y / kCoarse);
    for (int x = 0; x < region.cols; ++x) out[x / kCoarse] |= row[x] & 1;
  }
  return coarse;
}

/// Indices of the cells of the region that the static points of a view fall into, each once, ascending.
std::vector<int> covered_cells(const BackgroundView& view, const ViewPose& at, const cv::Mat& coarse,
                               const RayTable& rays) {
  const Pose frame_from_view = at.world_from_cam.inverse() * view.at.world_from_cam;
  const Eigen::Matrix3f rotation = frame_from_view.rotation_matrix().cast<float>();
  const Eigen::Vector3f translation = frame_from_view.translation.cast<float>();
  std::vector<std::uint8_t> hit(coarse.total(), 0);
  for (const Eigen::Vector3f& point : view.points) {
    const Eigen::Vector3f p = rotation * point + translation;
    if (p.z() < 0.05F) continue;
    const Eigen::Vector2f pixel = rays.project(p);
    if (!(pixel.x() >= 0 && pixel.y() >= 0)) continue;
    const float u = pixel.x() / kCoarse, v = pixel.y() / kCoarse;
    if (u >= static_cast<float>(coarse.cols) || v >= static_cast<float>(coarse.rows)) continue;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    if (coarse.at<std::uint8_t>(y, x) != 0) hit[static_cast<std::size_t>(y) * coarse.cols + x] = 1;
  }
  std::vector<int> cells;
  for (std::size_t i = 0; i < hit.size(); ++i) {
    if (hit[i] != 0) cells.push_back(static_cast<int>(i));
  }
  return cells;
}

/// How much a view is worth for being near, in (0, 1].
double nearness(const ViewPose& a, const ViewPose& b) {
  constexpr double kTime = 20, kDistance = 0.7, kAngle = 0.7;  // [s, m, rad] where it is halved
  const Pose motion = a.world_from_cam.inverse() * b.world_from_cam;
  const double angle = rotation_log(motion.rotation).norm();
  return 1 / (1 + std::abs(a.timestamp - b.timestamp) / kTime + motion.translation.norm() / kDistance +
              angle / kAngle);
}

}  // namespace

std::vector<BackgroundStore::Cell> BackgroundStore::cells_of(const BackgroundView& view) {
  constexpr double kSide = 0.1;  // [m]
  std::vector<Cell> cells;
  cells.reserve(view.points.size());
  for (const Eigen::Vector3f& point : view.points) {
    const Eigen::Vector3d p = view.at.world_from_cam * point.cast<double>() / kSide;
    const int scale = static_cast<int>(std::floor(std::log2(std::max(0.1F, point.z()))));
    cells.push_back(
        {static_cast<std::int32_t>(view.at.map.value), scale, static_cast<std::int32_t>(std::floor(p.x())),
         static_cast<std::int32_t>(std::floor(p.y())), static_cast<std::int32_t>(std::floor(p.z()))});
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

void BackgroundStore::add(std::shared_ptr<const BackgroundView> view) {
  std::vector<Cell> cells = cells_of(*view);
  const auto fresh = std::count_if(cells.begin(), cells.end(), [&](const Cell& cell) {
    const auto found = counts_.find(cell);
    return found == counts_.end() || found->second == 0;
  });
  const bool is_due =
      kept_.empty() || view->at.frame - kept_.back().view->at.frame >= settings_.view_interval;
  if (!is_due && static_cast<double>(fresh) < settings_.new_share * static_cast<double>(cells.size())) return;
  for (const Cell& cell : cells) ++counts_[cell];
  kept_.push_back({std::move(view), std::move(cells)});
  if (kept_.size() > static_cast<std::size_t>(settings_.max_views)) drop_one();
}

void BackgroundStore::drop_one() {
  std::size_t worst = 0;
  double min_worth = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < kept_.size(); ++i) {  // never the newest
    double worth = 0;
    for (const Cell& cell : kept_[i].cells) {
      const double count = counts_[cell];
      worth += 1 / (count * count);
    }
    if (worth >= min_worth) continue;
    min_worth = worth;
    worst = i;
  }
  for (const Cell& cell : kept_[worst].cells) {
    const auto found = counts_.find(cell);
    if (--found->second == 0) counts_.erase(found);
  }
  kept_.erase(kept_.begin() + static_cast<std::ptrdiff_t>(worst));
}

BackgroundStore::Views BackgroundStore::choose(const ViewPose& at, const cv::Mat& region,
                                               const RayTable& rays) const {
  const cv::Mat coarse = coarse_region(region);
  struct Candidate {
    std::shared_ptr<const BackgroundView> view;
    std::vector<int> cells;
    double nearness;
  };
  std::vector<Candidate> candidates;
  for (const Kept& kept : kept_) {
    if (kept.view->at.map != at.map || kept.view->at.frame == at.frame) continue;
    std::vector<int> cells = covered_cells(*kept.view, at, coarse, rays);
    if (!cells.empty()) candidates.push_back({kept.view, std::move(cells), nearness(kept.view->at, at)});
  }
  std::vector<double> need(coarse.total(), 1);  // less for every view that sees a cell
  Views chosen;
  while (!candidates.empty() && chosen.size() < static_cast<std::size_t>(settings_.views)) {
    std::size_t best = 0;
    double max_worth = -1;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      double worth = 0;
      for (const int cell : candidates[i].cells) worth += need[static_cast<std::size_t>(cell)];
      worth *= candidates[i].nearness;
      if (worth <= max_worth) continue;
      max_worth = worth;
      best = i;
    }
    for (const int cell : candidates[best].cells) need[static_cast<std::size_t>(cell)] *= 0.4;
    chosen.push_back(candidates[best].view);
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
  }
  return chosen;
}

}  // namespace stdc
