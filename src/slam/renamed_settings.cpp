#include "slam/renamed_settings.hpp"

#include <algorithm>
#include <array>

namespace stdc {
namespace {

constexpr std::array kRenamed{
    RenamedSetting{"segmentation.settling", "segmentation.border_trimming"},
    RenamedSetting{"propagation.memory", "propagation.history"},
    RenamedSetting{"tracking.match_distance", "tracking.max_hamming_distance"},
    RenamedSetting{"tracking.loose_match_distance", "tracking.loose_max_hamming_distance"},
    RenamedSetting{"tracking.best_to_second", "tracking.max_ratio"},
    RenamedSetting{"tracking.minimum_inliers_motion", "tracking.min_inliers_motion"},
    RenamedSetting{"tracking.minimum_inliers", "tracking.min_inliers"},
    RenamedSetting{"tracking.close_tracked_low", "tracking.min_close_tracked"},
    RenamedSetting{"tracking.close_untracked_high", "tracking.min_close_untracked"},
    RenamedSetting{"tracking.longest_gap", "tracking.max_keyframe_gap"},
    RenamedSetting{"pose_optimisation.minimum_observations", "pose_optimisation.min_observations"},
    RenamedSetting{"mapping.minimum_parallax", "mapping.min_parallax"},
    RenamedSetting{"mapping.match_distance", "mapping.max_hamming_distance"},
    RenamedSetting{"bundle_adjustment.relative_decrease_to_stop", "bundle_adjustment.min_relative_decrease"},
    RenamedSetting{"loop_closing.match_distance", "place_recognition.max_hamming_distance"},
    RenamedSetting{"loop_closing.score_ratio", "place_recognition.score_ratio"},
    RenamedSetting{"loop_closing.candidates", "place_recognition.candidates"},
    RenamedSetting{"loop_closing.consistency", "place_recognition.consistency"},
    RenamedSetting{"loop_closing.window", "place_recognition.window"},
    RenamedSetting{"loop_closing.ransac_trials", "place_recognition.ransac_trials"},
    RenamedSetting{"loop_closing.ransac_inliers", "place_recognition.ransac_inliers"},
    RenamedSetting{"loop_closing.guided_radius", "place_recognition.guided_radius"},
    RenamedSetting{"loop_closing.best_to_second", "place_recognition.max_ratio"},
    RenamedSetting{"loop_closing.least_inliers", "place_recognition.min_inliers"},
    RenamedSetting{"loop_closing.least_share", "place_recognition.min_share"},
    RenamedSetting{"loop_closing.strong_link", "loop_closing.min_covisibility"},
    RenamedSetting{"pose_graph.relative_decrease_to_stop", "pose_graph.min_relative_decrease"},
    RenamedSetting{"full_bundle_adjustment.relative_decrease_to_stop",
                   "full_bundle_adjustment.min_relative_decrease"},
};

}  // namespace

std::span<const RenamedSetting> renamed_settings() { return kRenamed; }

const RenamedSetting* find_renamed_setting(std::string_view before) {
  const auto found = std::ranges::find(kRenamed, before, &RenamedSetting::before);
  return found == kRenamed.end() ? nullptr : &*found;
}

bool is_renamed_section(std::string_view section) {
  return std::ranges::any_of(kRenamed, [&](const RenamedSetting& setting) {
    return setting.before.substr(0, setting.before.find('.')) == section;
  });
}

}  // namespace stdc
