#pragma once

#include "core/setting.hpp"

namespace stdc {

/// Noise of the measurements that a keypoint gives.
/// A depth camera that triangulates has sigma_z = k z^2 (Khoshelham and Oude Elberink, 'Accuracy and
/// Resolution of Kinect Depth Data', Sensors 2012), which is a constant sigma of the inverse depth: k.
/// It does not grow with the scale of the keypoint's pyramid level, other than the third coordinate of a
/// stereo matcher: the depth is read from the full-size image, whatever the level. What the level does add,
/// by reading beside the true spot of a slanted surface (pixel_sigma * scale * tan(slant) / (f z): 0.0015 /m
/// at 2 px, 45 degrees, 2.5 m), is small against the default. In simulations with slants up to 63 degrees,
/// sigmas grown with the scale gave poses that were 2 to 4 % worse at sigmas twice the sensor's, and at best
/// 5 % better for a sensor of 0.0015 /m with exactly that noise.
struct NoiseSettings {
  STDC_SETTING(double, pixel_sigma, 0.8, "px", 0.01, 20,
               "Noise of a keypoint on pyramid level 0; grows with the level's scale");
  STDC_SETTING(double, aligned_pixel_sigma, 0.4, "px", 0.01, 20,
               "The same, where its patch was aligned to the landmark's");
  STDC_SETTING(double, inverse_depth_sigma, 0.01, "1/m", 1e-5, 1,
               "Noise of the inverse depth: sigma_z = this * z^2");
};

}  // namespace stdc
