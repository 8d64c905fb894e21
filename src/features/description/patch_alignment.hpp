#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "features/image.hpp"

namespace stdc {

/// The surroundings of a keypoint on its pyramid level: the keypoint is the pixel (kCentre, kCentre).
struct Patch {
  static constexpr int kSide = 16;
  static constexpr int kCentre = 8;
  std::array<std::uint8_t, kSide * kSide> pixels{};

  ImageView view() const { return {pixels.data(), kSide, kSide, kSide}; }
};

/// Copies the patch around a pixel of a level; it must lie at least 8 pixels inside.
Patch cut_patch(const ImageView& level, int x, int y);

/// A patch as another view should see it, ready to be aligned: 8 x 8 values and what the alignment derives
/// from them.
class PatchTemplate {
 public:
  static constexpr int kSide = 8;
  static constexpr int kPixels = kSide * kSide;

  /// @param view_from_patch  linear map from offsets [px] in the patch to offsets [px] in the view's level
  /// @returns false if the map reaches out of the patch or the patch shows too little to be aligned (a flat
  ///          area or a straight edge)
  bool make(const Patch& patch, const Eigen::Matrix2f& view_from_patch);

  /// Moves `position` [px of the level] to where the image looks like the template, up to gain and offset of
  /// brightness: inverse compositional Lucas-Kanade (Baker and Matthews, IJCV 2004), as used to refine
  /// feature positions by Forster et al., 'SVO', ICRA 2014. False, and `position` unchanged, if it does not
  /// converge within `reach` [px] of the start, leaves the image, or the image looks different there.
  bool align(const ImageView& level, float reach, Eigen::Vector2f& position) const;

 private:
  using Row = std::array<float, kPixels>;
  bool derive();
  bool sample(const ImageView& level, const Eigen::Vector2f& position, Row& values) const;

  Row values_{};  ///< mean 0
  Row gradient_x_{}, gradient_y_{};
  Eigen::Matrix4f inverse_hessian_;  ///< over (x, y, gain, offset)
  float variance_ = 0;
};

}  // namespace stdc
