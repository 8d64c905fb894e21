#pragma once

#include <cstdint>
#include <vector>

#include "motion/depth_grid.hpp"
#include "motion/motion_settings.hpp"
#include "motion/static_scene.hpp"

namespace stdc {

/// Where what a cell shows would have been in the last frame if it moved.
struct CellSource {
  int cell = -1;                                    ///< -1: nothing that moves is expected there
  Eigen::Vector2f shift = Eigen::Vector2f::Zero();  ///< to where it is now [cells]
  bool measured = false;                            ///< by points that were followed
};

/// For each cell of a frame how likely it is that what it shows moves: log-odds, above 0 rather than not. A
/// Bayesian filter: carried from frame to frame with the surfaces, each finding adds to it, and cells on the
/// same surface share what they know (diffusion that stops at depth edges: Perona and Malik, PAMI 1990).
class MotionBelief {
 public:
  MotionBelief(const GridGeometry& geometry, const MotionSettings& settings)
      : geometry_(geometry), settings_(settings) {}

  /// Carries the belief to the next frame: a cell takes over from the cell that saw its surface before.
  /// @param last, now      the two grids
  /// @param last_from_now  motion of the camera
  /// @param sources        of each cell
  /// @param little_known   of the room as a whole: what no view tells anything about stays open then, see
  /// smooth() What was followed and has not moved like a thing at rest before this camera is more likely to
  /// move.
  void carry(const DepthGrid& last, const DepthGrid& now, const Pose& last_from_now,
             const std::vector<CellSource>& sources, bool little_known = false);
  /// Adds what was found about each cell.
  void add(const std::vector<CellFinding>& findings);
  /// Adds what others than the views say: `dynamic` of each cell 0 or not, `weight` log-odds.
  /// @param whole  it is meant to cover things whole, as a segmenter does: then what a thing touches, such as
  /// the
  ///               floor that a person stands on, is not joined to it, see smooth()
  void add_opinion(const std::vector<std::uint8_t>& dynamic, float weight, bool whole = false);
  /// Neighbours on the same surface share what they know.
  void smooth(const DepthGrid& now);

  /// Nothing is known.
  void reset();
  bool moves(std::size_t cell) const { return log_odds_[cell] > kWeak; }
  /// That it moves is more likely than not, but only its neighbours say so.
  bool is_suspect(std::size_t cell) const {
    return little_known_ && cell < unknown_.size() && unknown_[cell] != 0 && log_odds_[cell] > 0;
  }
  bool moves_surely(std::size_t cell) const { return log_odds_[cell] > kSure; }
  const std::vector<float>& log_odds() const { return log_odds_; }

  // Hysteresis: what moves begins where that is sure and ends where it is unlikely.
  static constexpr float kSure = 1.5F, kWeak = 0.3F;

 private:
  void join_unknown(const DepthGrid& now);
  void fill_unknown(const DepthGrid& now);

  const GridGeometry& geometry_;
  MotionSettings settings_;
  bool little_known_ = false;
  std::vector<float> log_odds_;
  // Of a cell about whose surface no view has told anything so far (else 0): 1, or where its belief is from.
  static constexpr std::uint8_t kFilled = 2, kTakenOver = 3, kVisited = 4, kOpinion = 5;
  std::vector<std::uint8_t> unknown_;
};

}  // namespace stdc
