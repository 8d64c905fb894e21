#include "motion/static_scene.hpp"

#include <algorithm>
#include <cmath>

#include "motion/grid_projection.hpp"

namespace stdc {
namespace {

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

/// What stands in a hole of the depth nobody knows: it may be nearer than all around it, as the rim of a
/// black screen is.
void find_holes(const GridGeometry& geometry, SceneView& view) {
  view.beside_hole.assign(view.grid.depth.size(), 0);
  for (int y = 0; y < geometry.height(); ++y) {
    for (int x = 0; x < geometry.width(); ++x) {
      if (view.grid.depth[geometry.index(x, y)] != 0) continue;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, geometry.height() - 1); ++v) {
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, geometry.width() - 1); ++u) {
          view.beside_hole[geometry.index(u, v)] = 1;
        }
      }
    }
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

std::vector<CellFinding> StaticScene::compare(const SceneFrame& frame) {
  std::vector<CellFinding> findings(frame.grid.depth.size());
  DepthNoise::Frame noise;
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
      const float tolerated = measured_tolerance(there);
      CellFinding& finding = findings[static_cast<std::size_t>(cell)];
      // At the outline of a thing the cell beside it may be the one that is seen there.
      const float behind = there * frame.grid.far[static_cast<std::size_t>(cell)] / depth;
      if (view.beside_hole[i] == 0 && view.doubtful[i] == 0)
        noise.add((view.grid.near[i] - behind) / tolerance(there));
      if (behind < view.grid.near[i] - tolerated) {
        // Of what stands in a hole nobody knows the depth; but it is no other thing than what is around it.
        constexpr float kFarBefore = 0.45F;
        const bool tells = view.beside_hole[i] == 0 || behind < kFarBefore * view.grid.near[i];
        finding.fresh += tells ? 1 : 0;
      } else if (there > view.grid.near[i] - tolerated && there < view.grid.far[i] + tolerated) {
        finding.seen = true;
        finding.known += view.doubtful[i] == 0 ? 1 : 0;
        finding.rest = std::max(finding.rest, view.rest[i]);
      }
    });
  }
  noise_.add(frame.timestamp, noise);
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
    if (frame.grid.near[i] > behind + measured_tolerance(there) && frame.grid.far[i] < there + kMaxStep) {
      findings[i].recedes = true;
    }
  });
}

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
        constexpr int kSaturated = 240;  // tells nothing when the exposure has changed
        if (samples[s].grey >= kSaturated || view.grid.grey[i] >= kSaturated) continue;
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
  view.timestamp = view.checked = frame.timestamp;
  view.reference = frame.reference;
  view.view_from_reference = frame.frame_from_reference;
  view.view_from_world = frame.cam_from_world;
  view.map = frame.map;
  view.grid = frame.grid;
  find_brightness_range(geometry_, view);
  find_holes(geometry_, view);
  view.rest = std::move(rest);
  view.doubtful = std::move(doubtful);
  views_.push_back(std::move(view));
  if (views_.size() <= static_cast<std::size_t>(settings_.max_views)) return;
  // The one that knows least goes, of equals the oldest; not one of the last few, which nothing has checked.
  const std::size_t candidates = views_.size() - views_.size() / 8 - 1;
  std::size_t dropped = 0;
  std::ptrdiff_t fewest = -1;
  for (std::size_t i = 0; i < candidates; ++i) {
    const auto known = std::count_if(views_[i].rest.begin(), views_[i].rest.end(), [&](float time) {
      return time >= static_cast<float>(settings_.rest_time);
    });
    if (fewest >= 0 && known >= fewest) continue;
    fewest = known;
    dropped = i;
  }
  views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(dropped));
  std::erase(chosen_, dropped);
  for (std::size_t& index : chosen_) index -= index > dropped ? 1 : 0;
}

}  // namespace stdc
