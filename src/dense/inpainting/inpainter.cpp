#include "dense/inpainting/inpainter.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "dense/inpainting/background_fill.hpp"
#include "dense/inpainting/depth_splat.hpp"
#include "dense/inpainting/mask_growth.hpp"
#include "dense/inpainting/view_alignment.hpp"

namespace stdc {
namespace {

/// Depth shadows of what moves reach further than its margin.
constexpr int kShadowMargins = 4;

/// The views fitted to the frame, the one that fits best first; an old view must fit better.
std::vector<AlignedView> align_views(const BackgroundView& frame, const BackgroundStore::Views& views,
                                     const RayTable& rays, bool align) {
  constexpr double kAge = 20;  // [s] after which a view must fit twice as well
  const AlignmentTarget target(frame, rays);
  std::vector<AlignedView> aligned;
  for (const auto& view : views) {
    // Grey cannot stand in for colour.
    if (view->colour.type() == frame.colour.type()) aligned.push_back(target.align(*view, align));
  }
  const auto badness = [&](const AlignedView& one) {
    return (1 + one.residual) * (1 + std::abs(one.view->at.timestamp - frame.at.timestamp) / kAge);
  };
  std::stable_sort(aligned.begin(), aligned.end(),
                   [&](const AlignedView& a, const AlignedView& b) { return badness(a) < badness(b); });
  return aligned;
}

/// Puts the fill over the image in the region, going over into the image along its rim.
void blend_colour(const BackgroundFill& fill, const cv::Mat& region, int feather, cv::Mat& colour) {
  cv::Mat depth_in_region;  // [px] to the next pixel outside
  cv::distanceTransform(region, depth_in_region, cv::DIST_L2, 3);
  const int channels = colour.channels();
  for (int y = 0; y < colour.rows; ++y) {
    for (int x = 0; x < colour.cols; ++x) {
      if (region.at<std::uint8_t>(y, x) == 0) continue;
      const bool known = fill.known.at<std::uint8_t>(y, x) != 0;
      const float share =
          known ? std::min(1.F, depth_in_region.at<float>(y, x) / static_cast<float>(feather + 1)) : 1;
      std::uint8_t* out = colour.ptr<std::uint8_t>(y) + x * channels;
      const std::uint8_t* in = fill.colour.ptr<std::uint8_t>(y) + x * channels;
      for (int c = 0; c < channels; ++c) {
        out[c] = known ? cv::saturate_cast<std::uint8_t>(share * in[c] + (1 - share) * out[c]) : 0;
      }
    }
  }
}

void replace_depth(const BackgroundFill& fill, const cv::Mat& region, double units_per_metre,
                   cv::Mat& depth) {
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (region.at<std::uint8_t>(y, x) == 0) continue;
      const float z = fill.depth.at<float>(y, x);
      if (depth.type() == CV_16UC1) {
        depth.at<std::uint16_t>(y, x) = cv::saturate_cast<std::uint16_t>(z * units_per_metre);
      } else {
        depth.at<float>(y, x) = z;
      }
    }
  }
}

}  // namespace

Inpainter::Inpainter(const Camera& camera, const InpaintingSettings& settings)
    : settings_(settings), rays_(camera) {}

BackgroundView Inpainter::view(const RgbdImage& image, const cv::Mat& dynamic, const ViewPose& at) const {
  return make_view(image, dynamic, settings_.margin, at, rays_);
}

cv::Mat Inpainter::region(const cv::Mat& dynamic) const {
  if (dynamic.empty() || cv::countNonZero(dynamic) == 0) return cv::Mat(rays_.size(), CV_8UC1, cv::Scalar(0));
  return grown(dynamic, settings_.margin);
}

InpaintedFrame Inpainter::inpaint(const RgbdImage& image, const BackgroundView& frame, const cv::Mat& dynamic,
                                  const BackgroundStore::Views& views) const {
  if (views.empty() || dynamic.empty() || cv::countNonZero(dynamic) == 0) return blank(image, dynamic);
  const std::vector<AlignedView> aligned = align_views(frame, views, rays_, settings_.align);
  if (aligned.empty()) return blank(image, dynamic);
  const cv::Mat zone = grown(dynamic, settings_.growth + kShadowMargins * settings_.margin);
  std::vector<SplatDepth> splats;
  std::vector<float> votes;
  for (const AlignedView& one : aligned) {
    splats.push_back(splat_depth(one, zone, rays_));
    const double apart = std::abs(one.view->at.timestamp - frame.at.timestamp);
    votes.push_back(static_cast<float>(1 / (1 + apart / settings_.memory)));
  }
  const cv::Mat mask = settings_.growth == 0
                           ? dynamic
                           : grow_mask(depth_in_metres(image, rays_), dynamic,
                                       grown(dynamic, settings_.growth), splats, votes, settings_);
  const cv::Mat replaced = region(mask);
  const cv::Mat shadows =
      grown(mask, kShadowMargins * settings_.margin) & (frame.seen == static_cast<int>(Seen::colour));
  const cv::Mat wanted = replaced | shadows;
  const BackgroundFill fill = fill_background(aligned, splats, votes, wanted, rays_, settings_);
  InpaintedFrame result{image.colour.clone(), image.depth.clone(), replaced, replaced & (fill.known == 0)};
  blend_colour(fill, replaced, std::min(settings_.feather, settings_.margin), result.colour);
  replace_depth(fill, wanted, rays_.camera().depth_units_per_metre, result.depth);
  return result;
}

InpaintedFrame Inpainter::blank(const RgbdImage& image, const cv::Mat& dynamic) const {
  InpaintedFrame result{image.colour.clone(), image.depth.clone(), region(dynamic), region(dynamic)};
  result.colour.setTo(0, result.unknown);
  if (!result.depth.empty()) result.depth.setTo(0, result.unknown);
  return result;
}

}  // namespace stdc
