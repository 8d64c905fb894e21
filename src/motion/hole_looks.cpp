#include "motion/hole_looks.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "motion/grid_projection.hpp"

namespace stdc {
namespace {

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

}  // namespace

HoleLooks HoleLooks::sums(int side) const {
  HoleLooks result;
  cv::boxFilter(compared, result.compared, CV_32F, cv::Size(side, side), cv::Point(-1, -1), false);
  cv::boxFilter(changed, result.changed, CV_32F, cv::Size(side, side), cv::Point(-1, -1), false);
  return result;
}

HoleLooks compare_holes(const StaticScene& scene, const GridGeometry& geometry, const SceneFrame& frame) {
  const cv::Mat none(geometry.height(), geometry.width(), CV_8UC1, cv::Scalar(0));
  HoleLooks looks{none.clone(), none.clone()};
  for (const std::size_t index : scene.chosen()) {
    compare_looks(scene, geometry, scene.views()[index], frame, looks);
  }
  return looks;
}

}  // namespace stdc
