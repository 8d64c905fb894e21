#include "motion/resting_surfaces.hpp"

#include <algorithm>
#include <cmath>

#include "motion/grid_projection.hpp"

namespace stdc {
namespace {

/// Cells thought to move, by surface: neighbours without a step in depth are of one. -1: none.
struct Surfaces {
  std::vector<int> label;
  int count = 0;
};

Surfaces find_surfaces(const GridGeometry& geometry, const DepthGrid& grid,
                       const std::vector<std::uint8_t>& moving) {
  constexpr float kStep = 0.04F, kStepGrowth = 0.03F;  // [m], [1]
  const int width = geometry.width(), height = geometry.height();
  Surfaces surfaces{std::vector<int>(moving.size(), -1)};
  std::vector<int> front;
  for_cells(geometry, 1, [&](int seed, int, int) {
    const auto start = static_cast<std::size_t>(seed);
    if (moving[start] == 0 || grid.depth[start] == 0 || surfaces.label[start] >= 0) return;
    surfaces.label[start] = surfaces.count;
    front.assign(1, seed);
    while (!front.empty()) {
      const int from = front.back();
      front.pop_back();
      const float here = grid.depth[static_cast<std::size_t>(from)];
      const int x = from % width, y = from / width;
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
        const std::size_t to = geometry.index(x + dx, y + dy);
        const bool joined = moving[to] != 0 && grid.depth[to] > 0 &&
                            std::abs(grid.depth[to] - here) < kStep + kStepGrowth * here;
        if (!joined || surfaces.label[to] >= 0) continue;
        surfaces.label[to] = surfaces.count;
        front.push_back(static_cast<int>(to));
      }
    }
    ++surfaces.count;
  });
  return surfaces;
}

/// How much of a surface could be compared, and how much of that is otherwise now.
struct Change {
  int cells = 0, compared = 0, changed = 0;
};

/// Darkest and brightest of the 3 x 3 cells around one.
std::pair<float, float> brightness_around(const GridGeometry& geometry, const DepthGrid& grid, int cell) {
  const int x = cell % geometry.width(), y = cell / geometry.width();
  std::uint8_t darkest = 255, brightest = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, geometry.height() - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, geometry.width() - 1); ++u) {
      darkest = std::min(darkest, grid.grey[geometry.index(u, v)]);
      brightest = std::max(brightest, grid.grey[geometry.index(u, v)]);
    }
  }
  return {darkest, brightest};
}

std::vector<Change> compare(const StaticScene& scene, const GridGeometry& geometry, const Surfaces& surfaces,
                            const SceneFrame& earlier, const SceneFrame& frame) {
  constexpr float kTight = 0.5F;  // of the tolerance: poses a moment apart agree better than a map
  constexpr float kNoise = 12;    // [grey levels]
  std::vector<Change> changes(static_cast<std::size_t>(surfaces.count));
  const GridProjection project(earlier.cam_from_world * frame.cam_from_world.inverse(), geometry);
  for_cells(geometry, 1, [&](int cell, int x, int y) {
    const auto i = static_cast<std::size_t>(cell);
    if (surfaces.label[i] < 0) return;
    Change& change = changes[static_cast<std::size_t>(surfaces.label[i])];
    ++change.cells;
    float there = 0;
    const int seen = project.cell(x, y, frame.grid.depth[i], there);
    if (seen < 0) return;
    const auto s = static_cast<std::size_t>(seen);
    if (earlier.grid.near[s] == 0) return;
    ++change.compared;
    const float tolerated = kTight * scene.tolerance(there);
    bool same = there > earlier.grid.near[s] - tolerated && there < earlier.grid.far[s] + tolerated;
    if (same) {
      const auto [darkest, brightest] = brightness_around(geometry, earlier.grid, seen);
      const float grey = frame.grid.grey[i];
      same = grey > darkest - kNoise && grey < brightest + kNoise;
    }
    change.changed += same ? 0 : 1;
  });
  return changes;
}

/// A hole in the depth goes with what is around it.
void give_back_holes(const GridGeometry& geometry, const Surfaces& surfaces,
                     const std::vector<std::uint8_t>& moving, std::vector<std::uint8_t>& resting) {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<std::uint8_t> before = resting;
    for_cells(geometry, 1, [&](int cell, int x, int y) {
      const auto i = static_cast<std::size_t>(cell);
      if (moving[i] == 0 || surfaces.label[i] >= 0) return;
      bool beside_resting = false, beside_moving = false;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, geometry.height() - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, geometry.width() - 1); ++u) {
          const std::size_t other = geometry.index(u, v);
          beside_resting = beside_resting || before[other] != 0;
          beside_moving = beside_moving || (surfaces.label[other] >= 0 && before[other] == 0);
        }
      }
      resting[i] = beside_resting && !beside_moving ? 1 : 0;
    });
  }
}

}  // namespace

std::vector<std::uint8_t> find_resting(const StaticScene& scene, const GridGeometry& geometry,
                                       const std::vector<const SceneFrame*>& earlier, const SceneFrame& frame,
                                       const std::vector<std::uint8_t>& moving,
                                       const std::vector<std::uint8_t>& never) {
  constexpr double kMaxChanged = 0.04, kMinCompared = 0.6;
  std::vector<std::uint8_t> resting(moving.size(), 0);
  if (earlier.empty() || frame.grid.grey.empty()) return resting;
  const Surfaces surfaces = find_surfaces(geometry, frame.grid, moving);
  std::vector<std::uint8_t> rests(static_cast<std::size_t>(surfaces.count), 1);
  for (const SceneFrame* other : earlier) {
    const std::vector<Change> changes = compare(scene, geometry, surfaces, *other, frame);
    for (std::size_t i = 0; i < rests.size(); ++i) {
      const Change& change = changes[i];
      if (change.compared < kMinCompared * change.cells || change.changed > kMaxChanged * change.compared)
        rests[i] = 0;
    }
  }
  for (std::size_t i = 0; i < resting.size(); ++i) {
    if (never[i] != 0 && surfaces.label[i] >= 0) rests[static_cast<std::size_t>(surfaces.label[i])] = 0;
  }
  for (std::size_t i = 0; i < resting.size(); ++i) {
    if (surfaces.label[i] >= 0) resting[i] = rests[static_cast<std::size_t>(surfaces.label[i])];
  }
  give_back_holes(geometry, surfaces, moving, resting);
  return resting;
}

}  // namespace stdc
