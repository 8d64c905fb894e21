#pragma once

#include "core/rgbd_image.hpp"
#include "dense/inpainting/background_store.hpp"
#include "dense/inpainting/inpainting_settings.hpp"
#include "dense/ray_table.hpp"

namespace stdc {

/// A frame without what moves.
struct InpaintedFrame {
  cv::Mat colour;    ///< as that of the frame; black where unknown
  cv::Mat depth;     ///< as that of the frame; 0 where unknown, or where no view measured one
  cv::Mat replaced;  ///< CV_8UC1, 255 = not that of the frame: the mask, what it missed, and the margin
  cv::Mat unknown;   ///< CV_8UC1, 255 = no view shows what is there
};

/// Replaces what moves in a frame by what views from elsewhere, or at other times, saw there: the background
/// inpainting of DynaSLAM (Bescos et al., RA-L 2018, III-F), which projects the last keyframes into the
/// frame. Beyond that, here views are chosen by what they uncover, aligned to the frame by brightness, asked
/// for consent about each surface, matched in exposure, and blended in; colour is carried where the sensor
/// has no depth, too.
///
/// For cameras without rolling shutter, or slow ones: a view is taken as seen at once.
class Inpainter {
 public:
  Inpainter(const Camera& camera, const InpaintingSettings& settings);

  const RayTable& rays() const { return rays_; }
  /// A frame as a view; see make_view().
  BackgroundView view(const RgbdImage& image, const cv::Mat& dynamic, const ViewPose& at) const;
  /// What is replaced: the mask with a margin around it; CV_8UC1.
  cv::Mat region(const cv::Mat& dynamic) const;
  /// @param frame    of the same image
  /// @param dynamic  CV_8UC1, 255 = dynamic, of the size of the camera
  /// @param views    what BackgroundStore::choose() gives for the frame
  InpaintedFrame inpaint(const RgbdImage& image, const BackgroundView& frame, const cv::Mat& dynamic,
                         const BackgroundStore::Views& views) const;
  /// A frame of which no pose is known: what moves in it stays unknown.
  InpaintedFrame blank(const RgbdImage& image, const cv::Mat& dynamic) const;

 private:
  InpaintingSettings settings_;
  RayTable rays_;
};

}  // namespace stdc
