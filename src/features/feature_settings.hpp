#pragma once

#include <array>
#include <utility>

#include "core/setting.hpp"

namespace stdc {

/// How keypoints are chosen among the FAST candidates.
enum class Selection {
  improved,   ///< the paper's: M levels by Eq. 2, budgets by Eq. 3-5, quadtree of Alg. 3, Harris winner
  orb_slam3,  ///< the classic: 8 levels, budget proportional to scale, split any node with two points
};

template <>
struct EnumNames<Selection> {
  static constexpr std::array values{std::pair{Selection::improved, "improved"},
                                     std::pair{Selection::orb_slam3, "orb-slam3"}};
};

/// Settings of the feature extraction.
struct FeatureSettings {
  Selection selection = Selection::improved;
  int keypoints = 1000;
  double scale_factor = 1.2;
  int levels = 0;
  int threshold_high = 20;
  int threshold_low = 7;
  int region_size = 35;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(Setting{"selection", "", "Keypoint selection: improved (the paper's quadtree) or orb-slam3"},
          self.selection);
    visit(Setting{"keypoints", "count", "Keypoints kept per image (N of Eq. 4)", 50, 20000}, self.keypoints);
    visit(Setting{"scale_factor", "ratio", "Size of a pyramid level over the next (1/s of Eq. 3)", 1.05, 2.0},
          self.scale_factor);
    visit(Setting{"levels", "count", "Pyramid levels; 0: Eq. 2 (improved) or 8 (orb-slam3)", 0, 16},
          self.levels);
    visit(Setting{"threshold_high", "grey levels", "FAST threshold T_H of high-quality candidates", 1, 255},
          self.threshold_high);
    visit(Setting{"threshold_low", "grey levels", "FAST threshold T_L, used where the budget is not met", 1,
                  255},
          self.threshold_low);
    visit(Setting{"region_size", "px", "Side of the square regions A_j of Alg. 2", 16, 256},
          self.region_size);
  }
  /// Throws Error naming the setting at fault.
  void validate() const;
};

}  // namespace stdc
