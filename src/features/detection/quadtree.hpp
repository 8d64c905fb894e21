#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "features/feature_settings.hpp"
#include "features/keypoint.hpp"

namespace stdc {

/// A FAST corner that the selection may keep.
struct Candidate {
  std::int16_t x = 0, y = 0;  ///< [px] of its level
  std::uint8_t score = 0;     ///< FAST score
  KeypointQuality quality = KeypointQuality::low;
  float response = 0;  ///< what decides within a node: Harris (improved) or FAST score (classic)
};

/// Pixels [left, right) x [top, bottom) of a level.
struct Cell {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Distributes keypoints by a quadtree over one level.
///
/// Improved (paper, Alg. 3): a node with more than one point of which at least one is of high quality is
/// split into 4; an empty one is removed; any other is kept as it is. Classic (Mur-Artal and Tardos,
/// ORB-SLAM, 2015): every node with more than one point is split. The point with the largest response of each
/// node is the winner; the first in order wins a tie.
///
/// What the papers leave open: the roots are near-square, max(1, round(w / h)) x max(1, round(h / w)), and
/// each is split at once into 4 (the 4 nodes of Alg. 3 for a 4:3 image). Nodes are split in passes over all
/// nodes of a depth, those with most points first (improved: with most points of high quality, then with most
/// points), and the pass stops as soon as there are `budget` nodes. The last split can yield up to 3 more
/// than the budget; the weakest winners, low quality first, are then dropped, so that there are never more
/// winners than the budget. There are fewer if no node can be split any more.
class Quadtree {
 public:
  /// @param candidates  all inside `area`, no two on the same pixel
  /// @returns indices of the winners, ascending
  const std::vector<int>& select(std::span<const Candidate> candidates, const Cell& area, int budget,
                                 Selection selection);
  /// The cells of the winners of the last select(), in the same order.
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  struct Point {
    std::int16_t x, y;
    std::uint32_t index : 31, high : 1;
  };
  struct Node {
    Cell cell;
    int begin = 0, end = 0;  // its points
    int high = 0;            // how many of them are of high quality

    int size() const { return end - begin; }
  };
  struct Winner {
    int candidate;
    Cell cell;
  };
  void make_roots(std::span<const Candidate> candidates, const Cell& area);
  void split(const Node& node);
  bool split_nodes(int budget, Selection selection);
  void collect_winners(std::span<const Candidate> candidates, int budget);

  std::vector<Point> points_, scratch_;  // those of a node side by side
  std::vector<Node> nodes_, next_;
  std::vector<int> queue_;
  std::vector<Winner> winners_;
  std::vector<int> selected_;
  std::vector<Cell> cells_;
};

}  // namespace stdc
