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
  STDC_SETTING(Selection, selection, Selection::improved,
               "Keypoint selection: improved (the paper's quadtree) or orb-slam3");
  STDC_SETTING(int, keypoints, 1000, "count", 50, 20000, "Keypoints kept per image (N of Eq. 4)");
  STDC_SETTING(double, scale_factor, 1.2, "ratio", 1.05, 2.0,
               "Size of a pyramid level over the next (1/s of Eq. 3)");
  STDC_SETTING(int, levels, 0, "count", 0, 16, "Pyramid levels; 0: Eq. 2 (improved) or 8 (orb-slam3)");
  STDC_SETTING(int, threshold_high, 20, "grey levels", 1, 255,
               "FAST threshold T_H of high-quality candidates");
  STDC_SETTING(int, threshold_low, 7, "grey levels", 1, 255,
               "FAST threshold T_L, used where the budget is not met");
  STDC_SETTING(int, region_size, 35, "px", 16, 256, "Side of the square regions A_j of Alg. 2");
  /// Throws Error naming the setting at fault.
  void validate() const;
};

}  // namespace stdc
