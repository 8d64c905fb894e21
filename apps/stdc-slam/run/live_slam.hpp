#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "slam/slam.hpp"

namespace stdc::app {

/// SLAM for a robot's day: begun anew, or kept to a finished map, while frames come in.
class LiveSlam {
 public:
  using MakeSegmenter = std::function<std::unique_ptr<Segmenter>()>;

  /// @param settings  with `system.localisation_only` as it is to be at first
  /// @param load_map  a map to begin with
  /// Throws Error as Slam does.
  LiveSlam(const Camera& camera, const Settings& settings, MakeSegmenter make_segmenter,
           const std::optional<std::filesystem::path>& load_map);

  Slam& slam() { return *slam_; }
  const Slam& slam() const { return *slam_; }
  bool localisation_only() const { return settings_.system.localisation_only; }

  /// Forgets all, also a map that was loaded, and makes a new one.
  void reset();
  /// From now on the camera is only found in the map as it is, or the map grows again. The camera is looked
  /// for in it at the next frame. Throws Error if there is no map yet.
  void set_localisation_only(bool only);

 private:
  void begin(const std::optional<std::filesystem::path>& map);

  Camera camera_;
  Settings settings_;
  MakeSegmenter make_segmenter_;
  std::unique_ptr<Slam> slam_;
};

}  // namespace stdc::app
