#pragma once

#include "estimation/bundle_adjustment.hpp"
#include "estimation/noise_settings.hpp"
#include "estimation/pose_graph.hpp"
#include "estimation/pose_optimisation.hpp"
#include "features/feature_settings.hpp"
#include "loop_closing/loop_settings.hpp"
#include "mapping/mapping_settings.hpp"
#include "place_recognition/place_recognition_settings.hpp"
#include "segmentation/mask_degradation.hpp"
#include "segmentation/network/network_settings.hpp"
#include "segmentation/propagation/mask_propagator.hpp"
#include "segmentation/segmentation_settings.hpp"
#include "segmentation/srm/refinement.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// Settings of the system as a whole.
struct SystemSettings {
  int mapping_latency = 4;
  int loop_latency = 15;
  bool localisation_only = false;
  bool report_keypoints = false;

  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit(
        Setting{
            "mapping_latency", "frames",
            "A keyframe's mapping runs beside tracking and is taken in after this many frames; 0: at once", 0,
            100},
        self.mapping_latency);
    visit(Setting{"loop_latency", "frames",
                  "A loop's correction runs beside tracking and is taken in after this many frames", 0, 1000},
          self.loop_latency);
    visit(Setting{"localisation_only", "", "Track in the map that was loaded, and leave it as it is"},
          self.localisation_only);
    visit(Setting{"report_keypoints", "", "Return every frame's keypoints, for drawing"},
          self.report_keypoints);
  }
};

/// All settings, by section. One YAML file mirrors them: see settings_io.hpp.
struct Settings {
  FeatureSettings features;
  SegmentationSettings segmentation;
  NetworkSettings network;
  RefinementSettings refinement;
  PropagationSettings propagation;
  MaskDegradationSettings mask_degradation;
  NoiseSettings noise;
  TrackingSettings tracking;
  PoseOptimisationSettings pose_optimisation;
  MappingSettings mapping;
  BundleSettings bundle_adjustment;
  PlaceRecognitionSettings place_recognition;
  LoopSettings loop_closing;
  PoseGraphSettings pose_graph;
  BundleSettings full_bundle_adjustment{10, 10, 1e-4};
  SystemSettings system;

  /// Calls visit("section", section_struct) for each section.
  template <typename Self, typename Visit>
  static void describe(Self& self, Visit&& visit) {
    visit("features", self.features);
    visit("segmentation", self.segmentation);
    visit("network", self.network);
    visit("refinement", self.refinement);
    visit("propagation", self.propagation);
    visit("mask_degradation", self.mask_degradation);
    visit("noise", self.noise);
    visit("tracking", self.tracking);
    visit("pose_optimisation", self.pose_optimisation);
    visit("mapping", self.mapping);
    visit("bundle_adjustment", self.bundle_adjustment);
    visit("place_recognition", self.place_recognition);
    visit("loop_closing", self.loop_closing);
    visit("pose_graph", self.pose_graph);
    visit("full_bundle_adjustment", self.full_bundle_adjustment);
    visit("system", self.system);
  }

  /// Throws Error naming "section.field".
  void validate() const;
};

}  // namespace stdc
