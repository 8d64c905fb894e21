#pragma once

namespace stdc {

/// Standard deviation of a depth [m] at distance z [m] along the axis: that of the first Kinect, which other
/// sensors for rooms stay below. Khoshelham and Elberink, Sensors 2012, eq. 10: it grows with z squared; the
/// constant part is that of Nguyen, Izadi and Lovell, 3DIMPVT 2012, eq. 3.
inline float depth_sigma(float z) { return 0.001F + 0.0016F * z * z; }

inline constexpr float kMaxMeanSigma = 0.015F;  ///< [m]

/// Whether the mean of so many depths at z [m] is known well enough to be drawn: a wall at 5 m needs eight
/// frames, else it is a relief of noise.
inline bool is_known(float z, int frames) {
  return depth_sigma(z) * depth_sigma(z) <= kMaxMeanSigma * kMaxMeanSigma * static_cast<float>(frames);
}

/// Depths of two frames that differ by less may be of the same surface [m].
inline float depth_tolerance(float z) { return 0.008F + 3 * depth_sigma(z); }

/// Neighbouring pixels whose depths differ by more are not of the same surface [m]: a floor seen at a flat
/// angle has steep gradients, the more so the further away.
inline float depth_step(float z) { return 0.02F + 0.015F * z + 4 * depth_sigma(z); }

}  // namespace stdc
