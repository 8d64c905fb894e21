#include "motion/map_motion.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "motion/cell_mask.hpp"
#include "motion/covered_holes.hpp"
#include "motion/point_cells.hpp"
#include "motion/resting_surfaces.hpp"
#include "segmentation/propagation/propagation_frame.hpp"
#include "segmentation/propagation/tile_map.hpp"

namespace stdc {

MapMotion::MapMotion(const Camera& camera, const MotionSettings& settings)
    : camera_(camera),
      settings_(settings),
      geometry_(camera),
      scene_(geometry_, settings_),
      belief_(geometry_, settings_),
      points_(camera) {
  check_ranges("motion", settings_);
}

void MapMotion::follow(const AtlasSnapshot& snapshot) {
  scene_.follow(snapshot);
  points_.follow(snapshot);
}

std::vector<LandmarkId> MapMotion::observe(const MotionFrame& input, const SmallFrame& small,
                                           const std::vector<MaskTile>& tiles) {
  std::vector<LandmarkId> gone;
  depth_ = input.depth;
  SceneFrame frame;
  frame.timestamp = input.timestamp;
  frame.reference = input.reference;
  frame.frame_from_reference = input.frame_from_reference;
  frame.map = input.map;
  frame.grid = sample_grid(geometry_, camera_, input.motion, input.depth, settings_.time_tolerance);
  frame.grid.grey = sample_grey(geometry_, small.levels[0]);
  if (input.cam_from_world) {
    frame.cam_from_world = *input.cam_from_world;
  } else if (last_) {
    frame.cam_from_world = last_->cam_from_world;
  }
  if (last_) {
    belief_.carry(last_->grid, frame.grid, last_->cam_from_world * frame.cam_from_world.inverse(),
                  sources(tiles), is_young(frame.timestamp, kYoung));
  } else {
    belief_.reset();
  }
  doubtful_.assign(frame.grid.depth.size(), 0);
  std::vector<std::uint8_t> segmented(frame.grid.depth.size(), 0);
  if (!input.segmented.empty())
    segmented = inner_cells(cells_of_mask(input.segmented, geometry_), frame.grid);
  if (input.cam_from_world) {
    scene_.choose(frame);
    std::vector<CellFinding> findings = scene_.compare(frame);
    if (recent_.size() >= kLag) scene_.find_receding(recent_[recent_.size() - kLag], frame, findings);
    belief_.add(findings);
    belief_.add_opinion(cells_of(input.moving), 2);
    const std::vector<std::uint8_t> moved = find_moving_points(input, frame.grid);
    belief_.add_opinion(moved, 2);
    scene_.doubt(frame, moved);
    belief_.add_opinion(segmented, 2, true);
    belief_.smooth(frame.grid);
    const std::vector<std::uint8_t> covered = find_covered_holes(scene_, geometry_, frame);
    for (std::size_t i = 0; i < findings.size(); ++i) {
      doubtful_[i] =
          covered[i] != 0 || belief_.moves(i) || (findings[i].fresh > 0 && findings[i].known == 0) ? 1 : 0;
    }
    if (input.trusted) {
      scene_.learn(frame);
      remember(frame, findings, segmented);
      gone = find_gone(frame, input.missing);
    }
    find_resting(frame, segmented);
    recent_.push_back(frame);
    while (recent_.size() > kLag && frame.timestamp - recent_[1].timestamp > kPause) recent_.pop_front();
  } else {
    // Once the camera is found again, what was believed may be long out of date.
    recent_.clear();
    belief_.reset();
    points_.reset();
    resting_.clear();
  }
  last_ = std::move(frame);
  return gone;
}

/// The cells around keypoints that have moved.
std::vector<std::uint8_t> MapMotion::find_moving_points(const MotionFrame& input, const DepthGrid& grid) {
  std::vector<std::uint8_t> moved(grid.depth.size(), 0);
  if (!input.features) return moved;
  std::vector<PointMotion> motion =
      points_.add({input.timestamp, input.reference, input.frame_from_reference, *input.cam_from_world,
                   input.map, input.features, input.measurements},
                  input.wary);
  if (!input.wary) return moved;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    if (input.dynamic[i] != 0) motion[i] = PointMotion::moves;
  }
  if (std::find(motion.begin(), motion.end(), PointMotion::moves) == motion.end()) return moved;
  const std::vector<PointMotion> cells = cells_around_points(*input.features, motion, geometry_, grid);
  for (std::size_t i = 0; i < cells.size(); ++i) moved[i] = cells[i] == PointMotion::moves ? 1 : 0;
  return moved;
}

/// What stands still at present, if enough has been seen to tell. A segmenter's people move even so.
void MapMotion::find_resting(const SceneFrame& frame, const std::vector<std::uint8_t>& segmented) {
  resting_.assign(frame.grid.depth.size(), 0);
  const std::vector<std::uint8_t> moving = moving_cells();
  if (std::find(moving.begin(), moving.end(), 255) == moving.end()) return;
  if (!recent_.empty() && frame.timestamp - recent_.front().timestamp >= 0.9 * kPause) {
    resting_ = stdc::find_resting(scene_, geometry_, {&recent_.front(), &recent_[recent_.size() / 2]}, frame,
                                  moving, segmented);
  }
  const std::vector<std::uint8_t> uncovered = find_uncovered_holes(scene_, geometry_, frame, moving);
  for (std::size_t i = 0; i < resting_.size(); ++i) resting_[i] |= uncovered[i];
}

/// Looked through with room to spare: the map's own error counts too.
std::vector<LandmarkId> MapMotion::find_gone(const SceneFrame& frame,
                                             const std::vector<MissingLandmark>& missing) const {
  std::vector<LandmarkId> gone;
  for (const MissingLandmark& landmark : missing) {
    const Eigen::Vector3f point = (frame.cam_from_world * landmark.position).cast<float>();
    const int cell = geometry_.cell_of(point);
    if (cell < 0) continue;
    const float near = frame.grid.near[static_cast<std::size_t>(cell)];
    if (near > point.z() + 1.5F * scene_.tolerance(point.z())) gone.push_back(landmark.id);
  }
  return gone;
}

std::optional<PoseAgreement> MapMotion::agreement(const Pose& cam_from_world, MapId map,
                                                  const SmallFrame& small, const cv::Mat& depth,
                                                  const cv::Mat& expected) const {
  constexpr int kStep = 5, kMinKnown = 40;
  std::vector<StaticScene::Sample> samples;
  const auto metres_per_unit = static_cast<float>(1 / camera_.depth_units_per_metre);
  for (int y = kStep / 2; y < geometry_.height(); y += kStep) {
    for (int x = kStep / 2; x < geometry_.width(); x += kStep) {
      const Eigen::Vector2f& raw = geometry_.raw_pixels()[geometry_.index(x, y)];
      const int u = static_cast<int>(std::lround(raw.x())), v = static_cast<int>(std::lround(raw.y()));
      if (u < 0 || v < 0 || u >= depth.cols || v >= depth.rows) continue;
      if (!expected.empty() && expected.at<std::uint8_t>(v, u) != 0) continue;
      const float metres = metres_at(depth, u, v, metres_per_unit);
      const int column = std::min(u / small.scale, small.width() - 1);
      const int row = std::min(v / small.scale, small.height() - 1);
      if (metres > 0) samples.push_back({x, y, metres, small.levels[0].row(row)[column]});
    }
  }
  const StaticScene::Agreement found = scene_.agreement(samples, cam_from_world, map);
  if (found.known + found.fresh < kMinKnown) return std::nullopt;
  PoseAgreement agreement;
  agreement.depth = static_cast<double>(found.known) / (found.known + found.fresh);
  agreement.looks = found.looks;
  return agreement;
}

/// Whether the oldest view is younger than so many seconds.
bool MapMotion::is_young(double timestamp, double seconds) const {
  return scene_.empty() || timestamp - scene_.views().front().timestamp < seconds;
}

/// A view is worth its memory if it shows what no other has.
void MapMotion::remember(const SceneFrame& frame, const std::vector<CellFinding>& findings,
                         const std::vector<std::uint8_t>& segmented) {
  // [s] At first, when little is known of the room, a view is due sooner: what comes in then while the camera
  // turns must not be taken for a part of it.
  constexpr double kMinGap = 0.4, kMinGapAtFirst = 0.1, kFirst = 1;
  constexpr double kUnknown = 0.06;
  int unknown = 0, with_depth = 0;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (frame.grid.depth[i] == 0) continue;
    ++with_depth;
    unknown += findings[i].seen ? 0 : 1;
  }
  const bool shows_more = unknown > kUnknown * with_depth;
  const double gap = is_young(frame.timestamp, kFirst) ? kMinGapAtFirst : kMinGap;
  const auto is_due = [&] { return frame.timestamp - scene_.views().back().timestamp >= gap; };
  if (!scene_.empty() && !(shows_more && is_due())) return;
  std::vector<float> rest(findings.size());
  std::vector<std::uint8_t> doubtful(findings.size());
  for (std::size_t i = 0; i < findings.size(); ++i) {
    doubtful[i] = belief_.moves(i) || belief_.is_suspect(i) || segmented[i] != 0 ? 1 : 0;
    rest[i] = findings[i].rest;
  }
  scene_.add(frame, std::move(rest), std::move(doubtful));
}

/// Where the tiles of what moved in the last frame have gone, as the cell that each cell now would have come
/// from.
std::vector<CellSource> MapMotion::sources(const std::vector<MaskTile>& tiles) const {
  std::vector<CellSource> source(static_cast<std::size_t>(geometry_.size()));
  if (tiles.empty()) return source;
  SmallFrame small;
  small.scale = geometry_.scale();
  small.levels[0].resize(geometry_.width(), geometry_.height());
  const TileMap map(tiles, small);
  const std::vector<int>& cells = geometry_.cell_of_square();
  for (int y = 0; y < geometry_.height(); ++y) {
    for (int x = 0; x < geometry_.width(); ++x) {
      const int cell = cells[geometry_.index(x, y)];
      const MaskTile* tile = cell < 0 ? nullptr : map.at(x, y);
      if (tile == nullptr) continue;
      const int u = x - static_cast<int>(std::lround(tile->shift.x()));
      const int v = y - static_cast<int>(std::lround(tile->shift.y()));
      if (u < 0 || v < 0 || u >= geometry_.width() || v >= geometry_.height()) continue;
      source[static_cast<std::size_t>(cell)] = {cells[geometry_.index(u, v)], tile->shift, tile->measured};
    }
  }
  return source;
}

/// Of a segmenter's cells those well inside, and with depth: its outline is rough and often has the shadow of
/// the depth camera in it. Where the body ends is for the depth to say.
std::vector<std::uint8_t> MapMotion::inner_cells(std::vector<std::uint8_t> cells,
                                                 const DepthGrid& grid) const {
  const cv::Mat mask(geometry_.height(), geometry_.width(), CV_8UC1, cells.data());
  cv::Mat inner;
  cv::erode(mask, inner, cv::Mat());
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = grid.depth[i] > 0 ? inner.data[i] : 0;
  return cells;
}

/// The cells of some raw pixels, each with those around it.
std::vector<std::uint8_t> MapMotion::cells_of(const std::vector<Eigen::Vector2f>& pixels) const {
  std::vector<std::uint8_t> cells(static_cast<std::size_t>(geometry_.size()), 0);
  const auto scale = static_cast<float>(geometry_.scale());
  for (const Eigen::Vector2f& pixel : pixels) {
    const int x = static_cast<int>((pixel.x() + 0.5F) / scale);
    const int y = static_cast<int>((pixel.y() + 0.5F) / scale);
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, geometry_.height() - 1); ++v) {
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, geometry_.width() - 1); ++u) {
        const int cell = geometry_.cell_of_square()[geometry_.index(u, v)];
        if (cell >= 0) cells[static_cast<std::size_t>(cell)] = 1;
      }
    }
  }
  return cells;
}

/// The cells that move: patches in which enough surely do.
std::vector<std::uint8_t> MapMotion::moving_cells() const {
  std::vector<std::uint8_t> moving(static_cast<std::size_t>(geometry_.size()), 0);
  if (belief_.log_odds().empty()) return moving;
  cv::Mat cells(geometry_.height(), geometry_.width(), CV_8UC1, moving.data());
  for (std::size_t i = 0; i < moving.size(); ++i) moving[i] = belief_.moves(i) ? 255 : 0;
  cv::Mat labels;
  const int count = cv::connectedComponents(cells, labels, 8, CV_32S);
  const int* label = labels.ptr<int>();
  std::vector<int> sure(static_cast<std::size_t>(count), 0);
  for (std::size_t i = 0; i < moving.size(); ++i) {
    sure[static_cast<std::size_t>(label[i])] += belief_.moves_surely(i) ? 1 : 0;
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    if (sure[static_cast<std::size_t>(label[i])] < settings_.min_cells) moving[i] = 0;
  }
  return moving;
}

cv::Mat MapMotion::mask() const {
  const std::vector<std::uint8_t> squares = squares_of_cells(moving_cells(), geometry_);
  return depth_.empty() ? draw_squares(squares, geometry_.scale(), camera_)
                        : mask_of_squares(squares, geometry_.scale(), camera_, depth_);
}

cv::Mat MapMotion::moving_now(const cv::Mat& mask) const {
  if (std::find(resting_.begin(), resting_.end(), 1) == resting_.end()) return mask;
  std::vector<std::uint8_t> cells = moving_cells();
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = resting_[i] != 0 ? 0 : cells[i];
  return mask_of_squares(squares_of_cells(cells, geometry_), geometry_.scale(), camera_, depth_);
}

cv::Mat MapMotion::doubtful() const {
  std::vector<std::uint8_t> cells = moving_cells();
  for (std::size_t i = 0; i < doubtful_.size(); ++i) cells[i] |= doubtful_[i];
  return draw_squares(squares_of_cells(cells, geometry_), geometry_.scale(), camera_);
}

}  // namespace stdc
