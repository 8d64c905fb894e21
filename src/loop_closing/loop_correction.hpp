#pragma once

#include "atlas/atlas.hpp"
#include "estimation/bundle_adjustment.hpp"
#include "estimation/pose_graph.hpp"
#include "estimation/sensor_model.hpp"
#include "loop_closing/loop_report.hpp"
#include "loop_closing/loop_settings.hpp"
#include "place_recognition/loop_verification.hpp"

namespace stdc {

/// What it takes to close a loop.
struct LoopTools {
  SensorModel sensor;
  BundleSettings bundle;
  PoseGraphSettings graph;
  LoopSettings settings;
};

/// Closes a loop: the keyframe and its neighbours go to where the place puts them, landmarks that both ends
/// see become one, and the essential graph spreads the correction over the rest (Mur-Artal, Montiel and
/// Tardos, 'ORB-SLAM', T-RO 2015, sec. VII-C).
///
/// If the place belongs to another map the two become one: the younger one is moved rigidly to where it fits
/// and joined to the older one, a bundle adjustment of both neighbourhoods joins them, and the
/// essential graph spreads what that moved (Campos et al., 'ORB-SLAM3', T-RO 2021, sec. VI-B).
/// The times of the report are left to the caller.
LoopReport close_loop(const LoopTools& tools, Atlas& atlas, const VerifiedLoop& loop);

}  // namespace stdc
