#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/sensor_model.hpp"

namespace stdc {

/// How a landmark is looked for in a keyframe that might see it.
struct FuseSearch {
  double radius = 3;              ///< around where it should be [px on level 0]
  int max_hamming_distance = 50;  ///< [bits] largest distance of the descriptors
  /// Of two landmarks that are one the given one stays; else the one that more keyframes see.
  bool keep_given = false;
};

/// Lets a keyframe see a landmark if it can; where the keypoint has a landmark already the two are merged
/// (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. VI-C). The observations of what is left are aligned to its
/// first one. True if the map changed. The keyframe's covisibility is not updated.
bool fuse_landmark(Atlas& atlas, KeyframeId keyframe, LandmarkId landmark, const SensorModel& sensor,
                   const FuseSearch& search);

/// Two landmarks are one: all that sees `from` sees `into`, and is aligned to its first observation.
void merge_landmarks(Atlas& atlas, LandmarkId from, LandmarkId into, const SensorModel& sensor);

}  // namespace stdc
