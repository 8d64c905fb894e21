#pragma once

#include <span>
#include <vector>

#include "features/detection/fast.hpp"
#include "features/detection/quadtree.hpp"
#include "features/feature_settings.hpp"

namespace stdc {

/// Which corners of a level go into the quadtree (Alg. 2).
///
/// Improved: all corners that reach T_H; if those are fewer than the budget, corners that reach only T_L are
/// added until there are `budget` in all. The paper visits the regions in raster order and stops when the
/// budget is met, which leaves the bottom of the picture without any; here the region with the fewest
/// candidates gives its strongest remaining corner next (ties: the stronger corner, then raster order), so
/// empty regions come first. Classic: in each region the corners that reach T_H or, if there is none, all
/// that reach T_L.
class CandidateChooser {
 public:
  /// @param corners  found at T_L, in raster order, all inside `area`
  /// @param area     divided into regions of about settings.region_size px
  /// @returns candidates in raster order, their response set to the FAST score
  const std::vector<Candidate>& choose(std::span<const Corner> corners, const Cell& area, int budget,
                                       const FeatureSettings& settings);

 private:
  void choose_improved(std::span<const Corner> corners, const Cell& area, int budget,
                       const FeatureSettings& settings);
  void choose_classic(std::span<const Corner> corners, const Cell& area, const FeatureSettings& settings);
  void assign_regions(std::span<const Corner> corners, const Cell& area, int region_size);

  struct LowCorner {
    int rank;   // candidates that its region has before it
    int index;  // of the corner
  };
  std::vector<int> region_of_;   // by corner
  std::vector<int> high_count_;  // by region; then all candidates that it has given
  std::vector<int> low_, chosen_;
  std::vector<LowCorner> turns_;
  std::vector<Candidate> candidates_;
};

}  // namespace stdc
