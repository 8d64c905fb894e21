#include "motion/covered_holes.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "motion/hole_looks.hpp"

namespace stdc {
namespace {

// Smaller holes are common: screens that show or mirror something else, surfaces that shine.
constexpr float kMinHoleShare = 0.15F;  // of the view

/// Takes out what is in patches of fewer cells.
void drop_small(cv::Mat& cells, int min_cells) {
  cv::Mat labels, stats, centres;
  const int count = cv::connectedComponentsWithStats(cells, labels, stats, centres, 8, CV_32S);
  for (int label = 1; label < count; ++label) {
    if (stats.at<int>(label, cv::CC_STAT_AREA) < min_cells) cells.setTo(0, labels == label);
  }
}

}  // namespace

std::vector<std::uint8_t> find_covered_holes(const StaticScene& scene, const GridGeometry& geometry,
                                             const SceneFrame& frame) {
  std::vector<std::uint8_t> covered(frame.grid.depth.size(), 0);
  const int min_cells = static_cast<int>(kMinHoleShare * static_cast<float>(geometry.size()));
  const auto holes = std::count(frame.grid.depth.begin(), frame.grid.depth.end(), 0.0F);
  // While the camera turns fast, blur changes the looks of all.
  if (holes < min_cells || frame.grid.grey.empty() || frame.grid.reach > 1) return covered;
  constexpr int kSide = 11;
  constexpr float kMinCompared = 0.25F * kSide * kSide, kMinChanged = 0.4F;
  const HoleLooks sums = compare_holes(scene, geometry, frame).sums(kSide);
  cv::Mat cells(geometry.height(), geometry.width(), CV_8UC1, covered.data());
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const float all = sums.compared.ptr<float>()[i];
    const bool looks_otherwise = all >= kMinCompared && sums.changed.ptr<float>()[i] > kMinChanged * all;
    covered[i] = frame.grid.depth[i] == 0 && looks_otherwise ? 1 : 0;
  }
  drop_small(cells, min_cells);
  return covered;
}

std::vector<std::uint8_t> find_uncovered_holes(const StaticScene& scene, const GridGeometry& geometry,
                                               const SceneFrame& frame,
                                               const std::vector<std::uint8_t>& moving) {
  constexpr int kSide = 5;
  constexpr float kMinCompared = 0.25F * kSide * kSide, kMaxChanged = 0.2F;
  std::vector<std::uint8_t> uncovered(moving.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i < moving.size() && !any; ++i) any = moving[i] != 0 && frame.grid.depth[i] == 0;
  if (!any || frame.grid.grey.empty()) return uncovered;
  const HoleLooks sums = compare_holes(scene, geometry, frame).sums(kSide);
  for (std::size_t i = 0; i < uncovered.size(); ++i) {
    if (moving[i] == 0 || frame.grid.depth[i] != 0) continue;
    const float all = sums.compared.ptr<float>()[i];
    uncovered[i] = all >= kMinCompared && sums.changed.ptr<float>()[i] <= kMaxChanged * all ? 1 : 0;
  }
  return uncovered;
}

}  // namespace stdc
