#pragma once

#include <map>
#include <memory>

#include "calibration/calibration_scene.hpp"
#include "core/rgbd_image.hpp"
#include "slam/settings.hpp"
#include "slam/tracking_result.hpp"

namespace stdc {

class Pipeline;

/// Makes the scene of a calibration: tracks a recording, and keeps the depth images of its keyframes.
class SceneRecorder {
 public:
  /// @param settings  nothing is looked for that moves, whatever they say
  SceneRecorder(const Camera& camera, Settings settings);
  ~SceneRecorder();
  SceneRecorder(const SceneRecorder&) = delete;
  SceneRecorder& operator=(const SceneRecorder&) = delete;

  /// @param depth_delay  stamp of the depth image less that of the colour image [s]
  TrackingStatus track(const RgbdImage& image, double depth_delay);
  void skip(double timestamp);
  /// Of the largest map; ends the recording. Throws Error naming `where` if it is too small to tell anything.
  CalibrationScene finish(const std::string& where);

 private:
  struct KeptDepth {
    double delay = 0;
    cv::Mat depth;
  };

  std::unique_ptr<Pipeline> pipeline_;
  std::map<int, KeptDepth> depths_;  ///< by frame
};

}  // namespace stdc
