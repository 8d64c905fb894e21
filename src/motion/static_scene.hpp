#pragma once

#include <cstdint>
#include <vector>

#include "atlas/atlas_snapshot.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "motion/depth_grid.hpp"
#include "motion/depth_noise.hpp"
#include "motion/motion_settings.hpp"

namespace stdc {

/// The depth of an earlier frame, and how sure it is that each surface in it rests.
struct SceneView {
  double timestamp = 0, checked = 0;  ///< [s] of the frame; of the last comparison with a later one
  KeyframeId reference;               ///< it moves with this keyframe
  Pose view_from_reference;
  DepthGrid grid;
  std::vector<float> rest;  ///< of each cell: time for which its surface has been seen at rest [s]
  std::vector<std::uint8_t> darkest, brightest;  ///< of each cell: of the 3 x 3 cells around it
  std::vector<std::uint8_t> beside_hole;         ///< of each cell: 1 if one of those 3 x 3 cells has no depth
  std::vector<std::uint8_t> doubtful;  ///< of each cell: 1 if its surface was thought to move at that time
  Pose view_from_world;                ///< as known now
  MapId map;                           ///< as known now
};

/// A frame that is compared with the earlier ones.
struct SceneFrame {
  double timestamp = 0;
  KeyframeId reference;
  Pose frame_from_reference;
  Pose cam_from_world;
  MapId map;
  DepthGrid grid;
};

/// What earlier views say about a cell of a frame.
struct CellFinding {
  std::uint8_t fresh = 0;  ///< views that have seen through the place where its surface is
  std::uint8_t known = 0;  ///< views that know the surface and did not think that it moved
  bool seen = false;       ///< a view knows the surface, whatever it thought
  float rest = 0;          ///< the surface has rested so long [s]; the longest of all views
  bool recedes = false;    ///< a moment ago there was a surface a little in front of it, which has gone
};

/// What is known of the geometry of the static scene: depths of earlier frames, at most
/// `MotionSettings.max_views`, which move with the keyframes they were seen from. A surface of a view is
/// believed once it has rested for `rest_time`; one that appears where nothing stood before is on probation;
/// one that a later frame looks through is taken out.
///
/// The test on free space is that of visibility-based change detection: every depth says that the ray up to
/// it is empty (ideas: Palazzolo et al., 'ReFusion', IROS 2019; Yguel et al., 2008). Compared along the rays
/// of the earlier view, it needs no limit on parallax.
class StaticScene {
 public:
  StaticScene(const GridGeometry& geometry, const MotionSettings& settings)
      : geometry_(geometry), settings_(settings) {}

  /// Takes account of the keyframes' present poses.
  void follow(const AtlasSnapshot& snapshot);
  /// Chooses the views that tell most about a frame: for `compare` and `learn`.
  void choose(const SceneFrame& frame);
  /// What the chosen views say about each cell.
  std::vector<CellFinding> compare(const SceneFrame& frame);
  /// Marks the cells whose surface recedes since an earlier frame: where it goes nobody has seen before, so
  /// views cannot tell.
  void find_receding(const SceneFrame& earlier, const SceneFrame& frame,
                     std::vector<CellFinding>& findings) const;
  /// Surfaces of the chosen views that the frame sees again have rested longer; those it looks through go.
  void learn(const SceneFrame& frame);
  /// Surfaces of a frame that were found to move are on probation in the chosen views that know them, unless
  /// they had rested for long: they moved when the view was made, too. `moved`: of each cell, 1 = it does.
  void doubt(const SceneFrame& frame, const std::vector<std::uint8_t>& moved);
  /// A depth of a frame at a cell.
  struct Sample {
    int column = 0, row = 0;
    float depth = 0;  ///< [m]
    int grey = 0;
  };
  /// How many samples show a surface that a chosen view knows, and how many one in front of what all see; and
  /// the share of the samples that look as they did in the view that least agrees: views that were made while
  /// the camera went astray agree with where it is now.
  struct Agreement {
    int known = 0, fresh = 0;
    double looks = 1;
  };
  Agreement agreement(const std::vector<Sample>& samples, const Pose& cam_from_world, MapId map) const;
  /// Remembers a frame. `rest`: how long each cell's surface has rested [s]; `doubtful`: see SceneView.
  void add(const SceneFrame& frame, std::vector<float> rest, std::vector<std::uint8_t> doubtful);

  /// Whether a brightness is one that a cell of a view may have, by what is around it: the pose is right to
  /// about a cell.
  bool looks_alike(const SceneView& view, int cell, float grey) const;

  bool empty() const { return views_.empty(); }
  const std::vector<SceneView>& views() const { return views_; }
  /// The views that `choose` has chosen.
  const std::vector<std::size_t>& chosen() const { return chosen_; }
  /// Differences of depth within this are noise, whatever the sensor [m].
  float tolerance(float depth) const {
    return static_cast<float>(settings_.depth_tolerance) +
           static_cast<float>(settings_.depth_tolerance_growth) * depth * depth;
  }
  /// Differences within this are noise in this recording.
  float measured_tolerance(float depth) const { return noise_.factor() * tolerance(depth); }

 private:
  void learn_from(const SceneFrame& frame, SceneView& view);
  std::vector<float> changed_share(const SceneFrame& frame, const SceneView& view,
                                   const std::vector<int>& again) const;

  const GridGeometry& geometry_;
  MotionSettings settings_;
  DepthNoise noise_;
  std::vector<SceneView> views_;  ///< by frame
  std::vector<std::size_t> chosen_;
};

}  // namespace stdc
