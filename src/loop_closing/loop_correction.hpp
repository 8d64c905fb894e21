#pragma once

#include "atlas/atlas.hpp"
#include "core/camera.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/noise_settings.hpp"
#include "estimation/pose_graph.hpp"
#include "loop_closing/loop_settings.hpp"
#include "place_recognition/loop_verification.hpp"

namespace stdc {

/// What closing a loop did.
struct LoopCorrection {
  bool merged = false;  ///< two maps became one
  int keyframes = 0;    ///< of the map that was corrected
  int fused = 0;        ///< landmarks that turned out to be one, and new observations
  double drift = 0;     ///< [m] between where the keyframe was thought to be and where it is
};

/// What it takes to close a loop.
struct LoopTools {
  Camera camera;
  NoiseSettings noise;
  BundleSettings bundle;
  PoseGraphSettings graph;
  LoopSettings settings;
};

/// Closes a loop: the keyframe and its neighbours go to where the place puts them, landmarks that both ends
/// see become one, and the essential graph spreads the correction over the rest (Mur-Artal, Montiel and
/// Tardos, 'ORB-SLAM', T-RO 2015, sec. VII-C).
///
/// If the place belongs to another map the two become one: the younger one is moved rigidly to where it fits
/// and joined to the older one, the seam is welded by a bundle adjustment of both neighbourhoods, and the
/// essential graph spreads what that moved (Campos et al., 'ORB-SLAM3', T-RO 2021, sec. VI-B).
LoopCorrection close_loop(const LoopTools& tools, Atlas& atlas, const VerifiedLoop& loop);

}  // namespace stdc
