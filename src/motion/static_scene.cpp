#include "motion/static_scene.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stdc {
namespace {

/// A rigid transform in single precision and where the grid sees a point.
struct GridProjection {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
  const GridGeometry& geometry;

  GridProjection(const Pose& to_from_from, const GridGeometry& grid_geometry)
      : rotation(to_from_from.rotation_matrix().cast<float>()),
        translation(to_from_from.translation.cast<float>()),
        geometry(grid_geometry) {}

  /// Cell that sees the point at column, row and depth of the other grid, and its depth there; -1: none.
  int cell(int column, int row, float depth, float& there) const {
    const Eigen::Vector3f point =
        rotation * Eigen::Vector3f(geometry.ray_x(column) * depth, geometry.ray_y(row) * depth, depth) +
        translation;
    constexpr float kMinDepth = 0.1F;
    there = point.z();
    if (!(there > kMinDepth)) return -1;
    const float x = geometry.focal_x() * point.x() / there + geometry.centre_x() + 0.5F;
    const float y = geometry.focal_y() * point.y() / there + geometry.centre_y() + 0.5F;
    if (!(x >= 0 && y >= 0)) return -1;
    const int u = static_cast<int>(x), v = static_cast<int>(y);
    return u < geometry.width() && v < geometry.height() ? v * geometry.width() + u : -1;
  }
};

/// Fills in between which brightnesses the pose of a view need not be exact. Cells at the edge have the range
/// of the next one inwards.
void find_brightness_range(const GridGeometry& geometry, SceneView& view) {
  const std::vector<std::uint8_t>& grey = view.grid.grey;
  view.darkest = view.brightest = grey;
  if (grey.empty()) return;
  for (int y = 0; y < geometry.height(); ++y) {
    for (int x = 0; x < geometry.width(); ++x) {
      const int column = std::clamp(x, 1, geometry.width() - 2),
                row = std::clamp(y, 1, geometry.height() - 2);
      const std::size_t cell = geometry.index(x, y);
      for (int v = row - 1; v <= row + 1; ++v) {
        for (int u = column - 1; u <= column + 1; ++u) {
          view.darkest[cell] = std::min(view.darkest[cell], grey[geometry.index(u, v)]);
          view.brightest[cell] = std::max(view.brightest[cell], grey[geometry.index(u, v)]);
        }
      }
    }
  }
}

/// Calls visit(cell, column, row) for every `step`-th cell both ways.
template <typename Visit>
void for_cells(const GridGeometry& geometry, int step, Visit&& visit) {
  for (int y = step / 2; y < geometry.height(); y += step) {
    for (int x = step / 2; x < geometry.width(); x += step) visit(y * geometry.width() + x, x, y);
  }
}

}  // namespace

void StaticScene::follow(const AtlasSnapshot& snapshot) {
  for (SceneView& view : views_) {
    view.view_from_world = snapshot.cam_from_world(view.reference, view.view_from_reference);
    view.map = snapshot.keyframes()[view.reference.value].map;
  }
}

/// Greedy: the next view is the one that knows most of the cells about which the chosen ones say least.
void StaticScene::choose(const SceneFrame& frame) {
  constexpr int kStep = 8;
  chosen_.clear();
  std::vector<int> samples;
  std::vector<std::vector<int>> covers(views_.size());
  for_cells(geometry_, kStep, [&](int cell, int, int) {
    if (frame.grid.depth[static_cast<std::size_t>(cell)] > 0) samples.push_back(cell);
  });
  for (std::size_t i = 0; i < views_.size(); ++i) {
    if (views_[i].map != frame.map) continue;
    const GridProjection project(views_[i].view_from_world * frame.cam_from_world.inverse(), geometry_);
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const float depth = frame.grid.depth[static_cast<std::size_t>(samples[s])];
      float there = 0;
      const int cell =
          project.cell(samples[s] % geometry_.width(), samples[s] / geometry_.width(), depth, there);
      if (cell < 0) continue;
      const float known = views_[i].grid.far[static_cast<std::size_t>(cell)];
      if (known > 0 && there < known + tolerance(known)) covers[i].push_back(static_cast<int>(s));
    }
  }
  std::vector<float> weight(samples.size(), 1);
  const auto wanted = static_cast<std::size_t>(settings_.views);
  while (chosen_.size() < wanted) {
    float best = 0.05F * static_cast<float>(samples.size());
    std::size_t next = views_.size();
    for (std::size_t i = views_.size(); i-- > 0;) {  // of equals the newest
      float gain = 0;
      for (const int s : covers[i]) gain += weight[static_cast<std::size_t>(s)];
      if (gain <= best) continue;
      best = gain;
      next = i;
    }
    if (next == views_.size()) break;
    chosen_.push_back(next);
    for (const int s : covers[next]) weight[static_cast<std::size_t>(s)] *= 0.6F;
    covers[next].clear();
  }
}

std::vector<CellFinding> StaticScene::compare(const SceneFrame& frame) const {
  std::vector<CellFinding> findings(frame.grid.depth.size());
  for (const std::size_t index : chosen_) {
    const SceneView& view = views_[index];
    const GridProjection project(view.view_from_world * frame.cam_from_world.inverse(), geometry_);
    for_cells(geometry_, 1, [&](int cell, int x, int y) {
      const float depth = frame.grid.depth[static_cast<std::size_t>(cell)];
      if (depth == 0) return;
      float there = 0;
      const int seen = project.cell(x, y, depth, there);
      if (seen < 0) return;
      const auto i = static_cast<std::size_t>(seen);
      if (view.grid.near[i] == 0) return;
      const float tolerated = tolerance(there);
      CellFinding& finding = findings[static_cast<std::size_t>(cell)];
      // At the outline of a thing the cell beside it may be the one that is seen there.
      const float behind = there * frame.grid.far[static_cast<std::size_t>(cell)] / depth;
      if (behind < view.grid.near[i] - tolerated) {
        ++finding.fresh;
      } else if (there > view.grid.near[i] - tolerated && there < view.grid.far[i] + tolerated) {
        finding.seen = true;
        finding.known += view.doubtful[i] == 0 ? 1 : 0;
        finding.rest = std::max(finding.rest, view.rest[i]);
      }
    });
  }
  return findings;
}

void StaticScene::find_receding(const SceneFrame& earlier, const SceneFrame& frame,
                                std::vector<CellFinding>& findings) const {
  constexpr float kMaxStep = 0.4F;  // [m] what lies farther behind is another thing
  const GridProjection project(frame.cam_from_world * earlier.cam_from_world.inverse(), geometry_);
  for_cells(geometry_, 1, [&](int cell, int x, int y) {
    const float depth = earlier.grid.depth[static_cast<std::size_t>(cell)];
    if (depth == 0) return;
    float there = 0;
    const int seen = project.cell(x, y, depth, there);
    if (seen < 0) return;
    const auto i = static_cast<std::size_t>(seen);
    // The other way round, too: at an outline the earlier frame must not have shown both.
    const float behind = there * earlier.grid.far[static_cast<std::size_t>(cell)] / depth;
    if (frame.grid.near[i] > behind + tolerance(there) && frame.grid.far[i] < there + kMaxStep) {
      findings[i].recedes = true;
    }
  });
}

void StaticScene::learn(const SceneFrame& frame) {
  for (const std::size_t index : chosen_) learn_from(frame, views_[index]);
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
    const float tolerated = tolerance(there);
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

/// Within the range of what is around the cell: the pose is right to about a cell.
bool StaticScene::looks_alike(const SceneView& view, int cell, float grey) const {
  constexpr float kNoise = 12;
  const auto i = static_cast<std::size_t>(cell);
  const float darkest = view.darkest[i], brightest = view.brightest[i];
  return grey > darkest - kNoise && grey < brightest + kNoise;
}

StaticScene::Agreement StaticScene::agreement(const std::vector<Sample>& samples, const Pose& cam_from_world,
                                              MapId map) const {
  enum : std::uint8_t { kFresh = 1, kKnown = 2 };
  Agreement result;
  std::vector<std::uint8_t> found(samples.size(), 0);
  std::vector<std::pair<int, int>> pairs(samples.size());
  for (const std::size_t index : chosen_) {
    if (index >= views_.size() || views_[index].map != map) continue;
    const SceneView& view = views_[index];
    const GridProjection project(view.view_from_world * cam_from_world.inverse(), geometry_);
    pairs.clear();
    double now = 1, then = 1;
    for (std::size_t s = 0; s < samples.size(); ++s) {
      float there = 0;
      const int seen = project.cell(samples[s].column, samples[s].row, samples[s].depth, there);
      if (seen < 0) continue;
      const auto i = static_cast<std::size_t>(seen);
      if (view.grid.near[i] == 0) continue;
      if (there < view.grid.near[i] - tolerance(there)) {
        found[s] |= kFresh;
      } else if (there < view.grid.far[i] + tolerance(there)) {
        found[s] |= kKnown;
        pairs.emplace_back(static_cast<int>(s), seen);
        now += samples[s].grey;
        then += view.grid.grey[i];
      }
    }
    const auto gain = static_cast<float>(std::clamp(then / now, 0.5, 2.0));  // exposure may have changed
    int alike = 0;
    for (const auto& [sample, cell] : pairs) {
      const auto s = static_cast<std::size_t>(sample);
      alike += looks_alike(view, cell, gain * static_cast<float>(samples[s].grey)) ? 1 : 0;
    }
    constexpr std::size_t kMinShared = 60;
    if (pairs.size() >= kMinShared) {
      result.looks = std::min(result.looks, static_cast<double>(alike) / static_cast<double>(pairs.size()));
    }
  }
  for (const std::uint8_t bits : found) {
    result.known += (bits & kKnown) != 0 ? 1 : 0;
    result.fresh += (bits & (kKnown | kFresh)) == kFresh ? 1 : 0;
  }
  return result;
}

void StaticScene::add(const SceneFrame& frame, std::vector<float> rest, std::vector<std::uint8_t> doubtful) {
  SceneView view;
  view.frame = frame.number;
  view.timestamp = view.checked = frame.timestamp;
  view.reference = frame.reference;
  view.view_from_reference = frame.frame_from_reference;
  view.view_from_world = frame.cam_from_world;
  view.map = frame.map;
  view.grid = frame.grid;
  find_brightness_range(geometry_, view);
  view.rest = std::move(rest);
  view.doubtful = std::move(doubtful);
  views_.push_back(std::move(view));
  if (views_.size() <= static_cast<std::size_t>(settings_.max_views)) return;
  // The one that knows least goes, of equals the oldest; not one of the last few, which nothing has checked.
  const std::size_t candidates = views_.size() - views_.size() / 8 - 1;
  std::size_t least = 0;
  std::ptrdiff_t fewest = -1;
  for (std::size_t i = 0; i < candidates; ++i) {
    const auto known = std::count_if(views_[i].rest.begin(), views_[i].rest.end(), [&](float time) {
      return time >= static_cast<float>(settings_.rest_time);
    });
    if (fewest >= 0 && known >= fewest) continue;
    fewest = known;
    least = i;
  }
  views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(least));
  std::erase(chosen_, least);
  for (std::size_t& index : chosen_) index -= index > least ? 1 : 0;
}

}  // namespace stdc
