#pragma once

#include <optional>
#include <vector>

#include "atlas/atlas.hpp"
#include "features/extractor.hpp"
#include "footage.hpp"
#include "mapping/local_mapper.hpp"
#include "slam/settings.hpp"
#include "tracking/tracker.hpp"

namespace stdc {

/// Tracks and maps footage in one thread, as Pipeline does with mapping_latency 0, but step by step, so that
/// a benchmark can time any of the steps. Begins anew, with an empty map, where the footage
/// ends or tracking is lost.
class Replay {
 public:
  /// `footage` must outlive it. Throws Error if there are fewer than two frames.
  Replay(const Footage& footage, const Settings& settings);

  /// Extracts the features of the next frame that is to be tracked, and gathers the local map for it.
  void look();
  /// Tracks that frame. Gives the keyframe that was made of it, if so; it is not mapped yet.
  std::optional<KeyframeId> track();
  /// Both, until there is a keyframe. Throws Error if the footage gives none.
  KeyframeId next_keyframe();

  /// Maps a keyframe: all of it,
  MappingReport map_keyframe(KeyframeId keyframe);
  /// or in three parts, of which these are the steps of LocalMapper before bundle adjustment,
  void prepare_bundle(KeyframeId keyframe);
  LocalBundleReport adjust(KeyframeId keyframe);
  /// and this is what comes after it.
  void after_bundle(KeyframeId keyframe);
  /// Lets the tracker know that the map has changed.
  void follow_atlas();

  const Camera& camera() const { return footage_.camera; }
  const Settings& settings() const { return settings_; }
  const RgbdImage& image() const { return footage_.frames[next_]; }  ///< of the frame looked at
  const TrackedFrame& frame() const { return frame_; }
  const LocalMap& local_map() const { return local_map_; }
  std::shared_ptr<const Pyramid> pyramid() const { return extractor_.pyramid(); }
  const Tracker& tracker() const { return tracker_; }
  const Atlas& atlas() const { return atlas_; }
  KeyframeId last_keyframe() const { return last_keyframe_; }

 private:
  void begin_anew();
  TrackedFrame extract();
  KeyframeId make_keyframe();

  const Footage& footage_;
  Settings settings_;
  FeatureExtractor extractor_;
  Tracker tracker_;
  LocalMapper mapper_;
  std::vector<LandmarkId> recent_;  ///< on probation, for mapping in parts
  Atlas atlas_;
  LocalMap local_map_;
  TrackedFrame frame_;
  std::size_t next_ = 0;  ///< index of the frame looked at
  int last_keyframe_frame_ = 0;
  KeyframeId last_keyframe_;
};

}  // namespace stdc
