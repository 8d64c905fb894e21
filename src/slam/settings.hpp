#pragma once

#include "core/setting.hpp"
#include "dense/dense_settings.hpp"
#include "dense/inpainting/inpainting_settings.hpp"
#include "estimation/bundle_settings.hpp"
#include "estimation/noise_settings.hpp"
#include "estimation/pose_graph_settings.hpp"
#include "estimation/pose_optimisation_settings.hpp"
#include "features/feature_settings.hpp"
#include "loop_closing/loop_settings.hpp"
#include "mapping/mapping_settings.hpp"
#include "motion/motion_settings.hpp"
#include "place_recognition/place_recognition_settings.hpp"
#include "segmentation/mask_degradation.hpp"
#include "segmentation/network/network_settings.hpp"
#include "segmentation/propagation/propagation_settings.hpp"
#include "segmentation/segmentation_settings.hpp"
#include "segmentation/srm/refinement.hpp"
#include "tracking/tracking_settings.hpp"

namespace stdc {

/// Settings of the system as a whole.
struct SystemSettings {
  STDC_SETTING(
      int, mapping_latency, 4, "frames", 0, 100,
      "A keyframe's mapping runs beside tracking and takes effect this many frames later; 0: at once");
  STDC_SETTING(int, loop_latency, 15, "frames", 0, 1000,
               "A loop's correction runs beside tracking and takes effect this many frames later");
  STDC_SETTING(bool, localisation_only, false, "Track in the loaded map and leave it unchanged");
  STDC_SETTING(bool, report_keypoints, false, "Return every frame's keypoints, for drawing");
  STDC_SETTING(bool, report_masks, false, "Return every frame's mask of what moves, waiting for it");
};

/// All settings, by section. One YAML file mirrors them: see settings_io.hpp.
struct Settings {
  STDC_SECTION(FeatureSettings, features, {});
  STDC_SECTION(SegmentationSettings, segmentation, {});
  STDC_SECTION(NetworkSettings, network, {});
  STDC_SECTION(RefinementSettings, refinement, {});
  STDC_SECTION(PropagationSettings, propagation, {});
  STDC_SECTION(MotionSettings, motion, {});
  STDC_SECTION(InpaintingSettings, inpainting, {});
  STDC_SECTION(DenseSettings, dense, {});
  STDC_SECTION(MaskDegradationSettings, mask_degradation, {});
  STDC_SECTION(NoiseSettings, noise, {});
  STDC_SECTION(TrackingSettings, tracking, {});
  STDC_SECTION(PoseOptimisationSettings, pose_optimisation, {});
  STDC_SECTION(MappingSettings, mapping, {});
  STDC_SECTION(BundleSettings, bundle_adjustment, {});
  STDC_SECTION(PlaceRecognitionSettings, place_recognition, {});
  STDC_SECTION(LoopSettings, loop_closing, {});
  STDC_SECTION(PoseGraphSettings, pose_graph, {});
  STDC_SECTION(BundleSettings, full_bundle_adjustment, {10, 10, 1e-4, 4});
  STDC_SECTION(SystemSettings, system, {});

  /// Throws Error naming "section.field".
  void validate() const;
};

}  // namespace stdc
