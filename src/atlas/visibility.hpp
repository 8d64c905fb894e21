#pragma once

#include <Eigen/Core>
#include <optional>

#include "atlas/landmark.hpp"
#include "core/camera.hpp"
#include "core/camera_motion.hpp"
#include "core/pose.hpp"
#include "features/description/matching.hpp"
#include "features/frame_features.hpp"

namespace stdc {

/// An image whose pose is about known, in which landmarks are looked for. Refers to what it is made of.
class ViewingImage {
 public:
  ViewingImage(const Camera& camera, const Pose& cam_from_world, const CameraMotion& motion,
               const FrameFeatures& features)
      : camera_(camera),
        cam_from_world_(cam_from_world),
        motion_(motion),
        features_(features),
        centre_(cam_from_world.centre()) {}

  const FrameFeatures& features() const { return features_; }
  /// Ideal pixel of a world point [m], when its row was read, if it lies before the camera and in the image.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& position) const;

  /// How an image should show a landmark.
  struct Expected {
    Eigen::Vector2f pixel;  ///< ideal pixel
    float cosine = 1;       ///< of the angle between its ray and the landmark's mean viewing direction
    int level = 0;          ///< of the pyramid, by its distance
  };
  /// The one visibility test (Mur-Artal et al., 'ORB-SLAM', T-RO 2015, sec. V-D): the landmark is projected
  /// into the image, its distance fits the range of scales, and it is seen from within 60 degrees of its mean
  /// viewing direction. Nothing if it should not be seen.
  std::optional<Expected> expect(const LandmarkGeometry& landmark) const;

  /// Where to look for what is expected there: `radius` [px of level 0] scaled to its level, on that level
  /// and the finer one next to it, and `coarser` levels more.
  SearchWindow window(const Expected& expected, double radius, int coarser) const;

 private:
  const Camera& camera_;
  const Pose& cam_from_world_;
  const CameraMotion& motion_;
  const FrameFeatures& features_;
  Eigen::Vector3d centre_;
};

}  // namespace stdc
