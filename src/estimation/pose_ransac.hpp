#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/camera.hpp"
#include "core/pose.hpp"
#include "estimation/pose_optimisation.hpp"

namespace stdc {

/// Settings of the search for a pose without a prior.
struct PoseRansacSettings {
  int trials = 300;           ///< at most
  double gate = 6;            ///< [px] on level 0: an alignment of three noisy depths is rough
  double confidence = 0.999;  ///< of having drawn three good ones, before it ends early
  int min_inliers = 15;
  std::uint64_t seed = 1;
};

/// The alignment of three observed points (3D-3D: Umeyama, PAMI 1991) with which most observations agree
/// (RANSAC: Fischler and Bolles, CACM 1981): cam_from_world, rough, to be optimised. Three points with depth
/// are needed; those without vote. Triples that are nearly on a line are not tried. Nothing if fewer than
/// `min_inliers` agree. Same input and seed, same result.
std::optional<Pose> find_pose(const Camera& camera, std::span<const PoseObservation> observations,
                              const PoseRansacSettings& settings);

}  // namespace stdc
