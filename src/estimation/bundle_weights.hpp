#pragma once

#include "estimation/packed_bundle.hpp"

namespace stdc {

/// Noise of the observations that take part, in multiples of what the noise settings say; 1 where there are
/// too few to tell.
struct MeasuredNoise {
  double pixel = 1, depth = 1;
};

/// From the medians of the chi-squares that `classify_bundle` has noted, corrected for the degrees of freedom
/// that poses and points take. From 0.05 to 1: less is rounding, more is not believed.
MeasuredNoise measured_noise(const PackedBundle& packed);

/// Multiplies the weight of each observation that takes part by Cauchy's, 1 / (1 + chi^2 / c^2): one step of
/// a redescending M-estimator from the minimum of Huber's (Bickel, 'One-Step Huber Estimates in the Linear
/// Model', JASA 1975), with a measured scale as in Kerl, Sturm and Cremers, 'Robust Odometry Estimation for
/// RGB-D Cameras', ICRA 2013. With the measured noise s, c^2 = (width s)^2 / (1 - (width s / bend)^2): where
/// the noise is as expected, width s reaches the bend of Huber's kernel and nothing is weighed down any more.
///
/// Keypoints on outlines are no points of the room: where depth breaks off they slide along it. They are off
/// by half a pixel to one, within the gates, where those on surfaces are within a tenth, and with Huber's
/// kernel make up two thirds of the cost. How far "off" begins differs from camera to camera by a factor of
/// four, so it is measured in each problem.
void weigh_by_residuals(double width, PackedBundle& packed);

}  // namespace stdc
