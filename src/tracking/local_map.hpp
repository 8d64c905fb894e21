#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "atlas/atlas.hpp"
#include "atlas/landmark_alignment.hpp"
#include "core/ids.hpp"
#include "core/pose.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// What the tracker needs to know of a landmark.
struct LocalLandmark : LandmarkGeometry {
  LandmarkId id;
  Descriptor descriptor;
  bool established = false;  ///< seen by three keyframes or more
  int view = 0;              ///< index into LocalMap::reference_views
  int view_keypoint = 0;
  Eigen::Vector2f view_pixel = Eigen::Vector2f::Zero();  ///< ideal pixel at which the reference view sees it
};

/// A keyframe that saw some of the landmarks first.
struct LocalReferenceView {
  std::shared_ptr<const FrameFeatures> features;
  Pose cam_from_world;
  double timestamp = 0;  ///< [s]
};

/// The part of the map around the camera, copied out, so that the tracker can go on while the mapper changes
/// the map: landmarks of the keyframes that see what the frame sees, and of their neighbours (Mur-Artal et
/// al., 'ORB-SLAM', T-RO 2015, sec. V-D).
struct LocalMap {
  std::vector<LocalLandmark> landmarks;  ///< by id
  std::vector<LocalReferenceView> reference_views;
  KeyframeId reference;  ///< the keyframe that shares most landmarks with the frame
  Pose reference_from_world;
  std::shared_ptr<const FrameFeatures> reference_features;
  std::vector<int> reference_landmarks;  ///< per keypoint of the reference: index into landmarks, or -1

  /// Index of a landmark, or -1.
  int find(LandmarkId id) const;
  /// Of the reference keyframe's landmarks: all, or those seen by three keyframes.
  int count_reference_landmarks(bool established_only) const;
};

/// @param seen       landmarks that the frame sees; those that are gone are passed over
/// @param fallback   reference keyframe if none of them is seen by any keyframe
/// @param keyframes  most keyframes to take landmarks from
LocalMap make_local_map(const Atlas& atlas, std::span<const LandmarkId> seen, KeyframeId fallback,
                        int keyframes);

}  // namespace stdc
