#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "dense/inpainting/depth_splat.hpp"
#include "dense/inpainting/inpainting_settings.hpp"
#include "dense/inpainting/view_alignment.hpp"

namespace stdc {

/// What views show in a region of a frame. Only the region's pixels have a meaning.
struct BackgroundFill {
  cv::Mat colour;  ///< CV_8UC3, or CV_8UC1 if the frame is grey
  cv::Mat depth;   ///< CV_32FC1 [m], 0 = not measured by any view
  cv::Mat known;   ///< CV_8UC1, 255 = a view shows what is there
};

/// Fills a region of a frame from views, the first ones preferred.
///
/// Every surface that some view carries to a pixel is asked about in all views: those that see it there vote
/// for it, those that see through it vote against it, those that something hides it from say nothing. The
/// nearest surface with more votes for than against it is taken; votes of views further away in time weigh
/// less. Colour comes from the preferred view that sees the surface, averaged with those that agree with it.
/// @param views   one or more, of the same type of image
/// @param splats  what each view gives to the region
/// @param votes   weight of each view
/// @param region  CV_8UC1, not 0 = wanted
BackgroundFill fill_background(const std::vector<AlignedView>& views, const std::vector<SplatDepth>& splats,
                               const std::vector<float>& votes, const cv::Mat& region, const RayTable& rays,
                               const InpaintingSettings& settings);

}  // namespace stdc
