#include "motion/depth_growth.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

constexpr int kUnit = 4;  // of distance: one cell along a flat surface

/// Cells waiting to be looked at, by distance (Dial's buckets): first come, first served, so that results do
/// not depend on how a heap breaks ties.
class Front {
 public:
  explicit Front(int max_distance) : buckets_(static_cast<std::size_t>(max_distance + 1)) {}

  void push(int distance, int cell) {
    if (distance < static_cast<int>(buckets_.size())) {
      buckets_[static_cast<std::size_t>(distance)].push_back(cell);
    }
  }
  /// Calls visit(distance, cell), which may push farther cells.
  template <typename Visit>
  void run(Visit&& visit) {
    for (std::size_t distance = 0; distance < buckets_.size(); ++distance) {
      for (std::size_t i = 0; i < buckets_[distance].size(); ++i) {
        visit(static_cast<int>(distance), buckets_[distance][i]);
      }
    }
  }

 private:
  std::vector<std::vector<int>> buckets_;
};

/// Cost of a step between neighbours; 0: there is an edge between them.
int step_cost(float from, float to, const DepthGrowth& settings) {
  if (from == 0 && to == 0) return 2 * kUnit;  // less is known there
  if (from == 0 || to == 0) return 0;
  const float difference = std::abs(to - from);
  const float tolerance = settings.step + settings.step_growth * from * from;
  if (difference > tolerance) return 0;
  return kUnit + static_cast<int>(kUnit * difference / tolerance);
}

}  // namespace

std::vector<GrowthSeed> keep_majority(int width, int height, const std::vector<float>& depth,
                                      const std::vector<GrowthSeed>& seeds, int reach, int min_same) {
  constexpr float kSameSurface = 0.3F;  // [m]
  std::vector<GrowthSeed> kept = seeds;
  for (int cell = 0; cell < width * height; ++cell) {
    const auto i = static_cast<std::size_t>(cell);
    if (seeds[i] == GrowthSeed::none) continue;
    const int x = cell % width, y = cell / width;
    int same = -1, other = 0;  // it is not its own witness
    for (int v = std::max(y - reach, 0); v <= std::min(y + reach, height - 1); ++v) {
      for (int u = std::max(x - reach, 0); u <= std::min(x + reach, width - 1); ++u) {
        const auto k = static_cast<std::size_t>(v * width + u);
        if (seeds[k] == GrowthSeed::none || std::abs(depth[k] - depth[i]) > kSameSurface) continue;
        ++(seeds[k] == seeds[i] ? same : other);
      }
    }
    const int wanted = std::max(seeds[i] == GrowthSeed::moving ? min_same : 0, other);
    if (same < wanted) kept[i] = GrowthSeed::none;
  }
  return kept;
}

std::vector<std::uint8_t> grow_in_depth(int width, int height, const std::vector<float>& depth,
                                        const std::vector<GrowthSeed>& seeds, const DepthGrowth& settings) {
  std::vector<std::uint8_t> moving(depth.size(), 0);
  std::vector<int> owner(depth.size(), -1), distance(depth.size(), 0);
  Front front(settings.reach * kUnit);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    if (seeds[i] == GrowthSeed::none) continue;
    owner[i] = static_cast<int>(i);
    front.push(0, static_cast<int>(i));
  }
  front.run([&](int so_far, int cell) {
    const auto i = static_cast<std::size_t>(cell);
    if (distance[i] != so_far) return;  // reached by a shorter way since
    const int x = cell % width, y = cell / width;
    const auto seed = static_cast<std::size_t>(owner[i]);
    constexpr std::array<std::array<int, 2>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
    for (const auto& [dx, dy] : kSteps) {
      if (x + dx < 0 || y + dy < 0 || x + dx >= width || y + dy >= height) continue;
      const auto next = static_cast<std::size_t>(cell + dy * width + dx);
      const int cost = step_cost(depth[i], depth[next], settings);
      if (cost == 0 || std::abs(depth[next] - depth[seed]) > settings.max_difference) continue;
      if (owner[next] >= 0 && distance[next] <= so_far + cost) continue;
      if (so_far + cost > settings.reach * kUnit) continue;
      owner[next] = owner[i];
      distance[next] = so_far + cost;
      front.push(so_far + cost, static_cast<int>(next));
    }
  });
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (owner[i] >= 0 && seeds[static_cast<std::size_t>(owner[i])] == GrowthSeed::moving) moving[i] = 1;
  }
  return moving;
}

void keep_patches(int width, int height, const std::vector<GrowthSeed>& seeds,
                  const std::vector<std::uint8_t>& confirmed,
                  const std::function<bool(const MovingPatch&)>& is_wanted,
                  std::vector<std::uint8_t>& cells) {
  const cv::Mat mask(height, width, CV_8UC1, cells.data());
  cv::Mat labels;
  const int count = cv::connectedComponents(mask, labels, 8, CV_32S);
  std::vector<MovingPatch> patches(static_cast<std::size_t>(count));
  const int* label = labels.ptr<int>();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    MovingPatch& patch = patches[static_cast<std::size_t>(label[i])];
    ++patch.cells;
    patch.moving_seeds += seeds[i] == GrowthSeed::moving ? 1 : 0;
    patch.resting_seeds += seeds[i] == GrowthSeed::resting ? 1 : 0;
    patch.confirmed += confirmed[i] != 0 ? 1 : 0;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] != 0 && !is_wanted(patches[static_cast<std::size_t>(label[i])])) cells[i] = 0;
  }
}

}  // namespace stdc
