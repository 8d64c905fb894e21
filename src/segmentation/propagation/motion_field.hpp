#pragma once

#include <Eigen/Core>
#include <vector>

#include "segmentation/propagation/mask_tiles.hpp"
#include "segmentation/propagation/propagation_frame.hpp"

namespace stdc {

/// Motion between two consecutive frames, measured at tracked points. A point is tracked when a tile needs
/// it, and serves all masks that are moved between the two frames.
class MotionField {
 public:
  /// Forgets everything; for frames of width x height cells.
  void reset(int width, int height);
  /// Follows points of the tiles' surfaces wherever that was not tried yet. The tiles are where `from` shows
  /// them.
  void cover(const std::vector<MaskTile>& tiles, const SmallFrame& from, const SmallFrame& to);

  struct Motion {
    Eigen::Vector2f flow = Eigen::Vector2f::Zero();  ///< [cells]
    float approach = 0;                              ///< change of depth [m]
  };
  /// The motion of a surface at that depth [m; 0: any], from the points around, the near ones first. False if
  /// there are none within reach.
  bool at(const Eigen::Vector2f& position, float depth, Motion& motion) const;

 private:
  static constexpr int kBin = 8;  ///< side of a bin [cells]; one point in each at most

  struct Point {
    Eigen::Vector2f position = Eigen::Vector2f::Zero(), flow = Eigen::Vector2f::Zero();
    float depth = 0;
    float approach = 0;
    bool measured = false;  ///< whether `approach` is
    bool good = false;
  };
  struct Wish {
    float depth = 0;
    Eigen::Vector2f velocity = Eigen::Vector2f::Zero();
    bool wanted = false;
  };
  void follow(std::size_t bin, const Wish& wish, const SmallFrame& from, const SmallFrame& to);
  bool agrees(std::size_t bin) const;
  template <typename Visit>
  void around(int column, int row, int ring, Visit&& visit) const;
  bool mean_around(const Eigen::Vector2f& position, float depth, int ring, Motion& motion) const;

  int columns_ = 0, rows_ = 0;
  std::vector<Point> points_;        ///< of each bin
  std::vector<std::uint8_t> tried_;  ///< of each bin
};

}  // namespace stdc
