#include "motion/covered_holes.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "motion/grid_projection.hpp"

namespace stdc {
namespace {

// Smaller holes are common: screens that show or mirror something else, surfaces that shine.
constexpr float kMinHoleShare = 0.15F;  // of the view

/// Of a hole's cells those that a view compares, and those that look otherwise in it.
struct HoleLooks {
  cv::Mat compared, changed;  // CV_8UC1, 1 = yes
};

void compare_looks(const StaticScene& scene, const GridGeometry& geometry, const SceneView& view,
                   const SceneFrame& frame, HoleLooks& looks) {
  struct Pair {
    int here, there;
  };
  std::vector<Pair> pairs;
  double now = 1, then = 1;
  const GridProjection project(frame.cam_from_world * view.view_from_world.inverse(), geometry);
  for_cells(geometry, 1, [&](int cell, int x, int y) {
    const auto v = static_cast<std::size_t>(cell);
    const float depth = view.grid.depth[v];
    if (depth == 0 || view.doubtful[v] != 0) return;
    float there = 0;
    const int seen = project.cell(x, y, depth, there);
    if (seen < 0) return;
    const auto i = static_cast<std::size_t>(seen);
    const float near = frame.grid.near[i];
    if (near == 0) {
      pairs.push_back({seen, cell});
    } else if (near < there + scene.tolerance(there) && frame.grid.far[i] > there - scene.tolerance(there)) {
      now += frame.grid.grey[i];
      then += view.grid.grey[v];
    }
  });
  const auto gain = static_cast<float>(std::clamp(then / now, 0.5, 2.0));  // exposure may have changed
  for (const auto& [here, there] : pairs) {
    const float grey = gain * static_cast<float>(frame.grid.grey[static_cast<std::size_t>(here)]);
    looks.compared.data[here] = 1;
    if (!scene.looks_alike(view, there, grey)) looks.changed.data[here] = 1;
  }
}

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
  const cv::Mat none(geometry.height(), geometry.width(), CV_8UC1, cv::Scalar(0));
  HoleLooks looks{none.clone(), none.clone()};
  for (const std::size_t index : scene.chosen()) {
    compare_looks(scene, geometry, scene.views()[index], frame, looks);
  }
  constexpr int kSide = 11;
  constexpr float kMinCompared = 0.25F * kSide * kSide, kMinChanged = 0.4F;
  cv::Mat compared, changed;
  cv::boxFilter(looks.compared, compared, CV_32F, cv::Size(kSide, kSide), cv::Point(-1, -1), false);
  cv::boxFilter(looks.changed, changed, CV_32F, cv::Size(kSide, kSide), cv::Point(-1, -1), false);
  cv::Mat cells(geometry.height(), geometry.width(), CV_8UC1, covered.data());
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const float all = compared.ptr<float>()[i];
    const bool looks_otherwise = all >= kMinCompared && changed.ptr<float>()[i] > kMinChanged * all;
    covered[i] = frame.grid.depth[i] == 0 && looks_otherwise ? 1 : 0;
  }
  drop_small(cells, min_cells);
  return covered;
}

}  // namespace stdc
