#include "dense/background_fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "dense/depth_splat.hpp"
#include "dense/sampling.hpp"

namespace stdc {
namespace {

constexpr int kMaxViews = 32;

/// A view's part in filling.
struct Source {
  const BackgroundView* view;
  Eigen::Matrix3f rotation;  ///< of view_from_frame
  Eigen::Vector3f translation;
  cv::Vec3f gain;
  float vote;
  SplatDepth splat;
};

/// Numbers in a fixed space: at most one for each view.
struct Depths {
  std::array<float, kMaxViews> z;
  int count = 0;
  void add(float value) { z[static_cast<std::size_t>(count++)] = value; }
};

/// What the views say about a surface.
struct Opinion {
  float score = 0;       ///< votes for it less those against it
  float depth = 0;       ///< as measured by those that see it [m, frame]; 0: none
  cv::Vec3f colour{0, 0, 0};
  float colours = 0;     ///< weight of the colours in `colour`
};

class Filler {
 public:
  Filler(std::vector<Source> sources, const RayTable& rays, const InpaintingSettings& settings)
      : sources_(std::move(sources)),
        rays_(rays),
        tolerance_(static_cast<float>(settings.depth_tolerance)),
        growth_(static_cast<float>(settings.depth_tolerance_growth)),
        colour_tolerance_(static_cast<float>(settings.colour_tolerance)) {}

  /// The surface at a pixel and its colour; `colours` is 0 if nothing is known.
  Opinion at(int x, int y) const {
    Depths measured, guessed;
    for (const Source& source : sources_) {
      if (const float z = source.splat.measured.at<float>(y, x); z > 0) measured.add(z);
      if (const float z = source.splat.guessed.at<float>(y, x); z > 0) guessed.add(z);
    }
    const Opinion best = best_surface(x, y, measured);
    if (best.colours > 0 || guessed.count == 0) return best;
    return ask(rays_.point(x, y, guessed.z[0]), true);  // of the preferred view
  }

 private:
  float tolerance(float z) const { return tolerance_ + growth_ * z * z; }

  Opinion best_surface(int x, int y, Depths& depths) const {
    std::sort(depths.z.begin(), depths.z.begin() + depths.count);
    Opinion best;
    best.score = -1e9F;
    for (int first = 0; first < depths.count;) {
      const float nearest = depths.z[static_cast<std::size_t>(first)];
      int end = first + 1;
      while (end < depths.count && depths.z[static_cast<std::size_t>(end)] < nearest + tolerance(nearest)) ++end;
      const float z = depths.z[static_cast<std::size_t>((first + end - 1) / 2)];
      const Opinion opinion = ask(rays_.point(x, y, z), false);
      if (opinion.colours > 0 && opinion.score > 0) return opinion;
      if (opinion.colours > 0 && opinion.score > best.score) best = opinion;
      first = end;
    }
    return best;
  }

  /// @param guess  whether the depth of the point is one
  Opinion ask(const Eigen::Vector3f& point, bool guess) const {
    Opinion opinion;
    float depths = 0, depth_sum = 0;
    cv::Vec3f first;
    for (const Source& source : sources_) {
      const Eigen::Vector3f p = source.rotation * point + source.translation;
      if (p.z() < 0.05F) continue;
      const Eigen::Vector2f pixel = rays_.project(p);
      if (!inside(pixel, rays_.size(), 0)) continue;
      const int x = static_cast<int>(pixel.x() + 0.5F), y = static_cast<int>(pixel.y() + 0.5F);
      const Seen seen = source.view->seen_at(x, y);
      if (seen == Seen::nothing) continue;
      const float difference = source.view->depth.at<float>(y, x) - p.z();
      const bool same = std::abs(difference) < (guess ? 0.15F * p.z() : tolerance(p.z()));
      if (!guess) {
        if (seen != Seen::surface) continue;
        if (!same) {
          if (difference > 0) opinion.score -= source.vote;
          continue;
        }
        opinion.score += source.vote;
        depth_sum += source.vote * (point.z() + difference);
        depths += source.vote;
      } else if (!same) {
        continue;
      }
      cv::Vec3f colour = sample_colour(source.view->colour, pixel.x(), pixel.y());
      for (int c = 0; c < 3; ++c) colour[c] *= source.gain[c];
      if (opinion.colours == 0) first = colour;
      const cv::Vec3f apart = colour - first;
      const float most = std::max({std::abs(apart[0]), std::abs(apart[1]), std::abs(apart[2])});
      const float weight = opinion.colours == 0 ? 1 : std::max(0.F, 1 - most / colour_tolerance_);
      opinion.colour += weight * colour;
      opinion.colours += weight;
    }
    if (depths > 0) opinion.depth = depth_sum / depths;
    if (opinion.colours > 0) opinion.colour *= 1 / opinion.colours;
    return opinion;
  }

  std::vector<Source> sources_;
  const RayTable& rays_;
  float tolerance_, growth_, colour_tolerance_;
};

}  // namespace

BackgroundFill fill_background(const ViewPose& at, const std::vector<AlignedView>& views, const cv::Mat& region,
                               const RayTable& rays, const InpaintingSettings& settings) {
  BackgroundFill fill;
  fill.depth = cv::Mat(region.size(), CV_32FC1, cv::Scalar(0));
  fill.known = cv::Mat(region.size(), CV_8UC1, cv::Scalar(0));
  const int type = views.empty() ? CV_8UC3 : views[0].view->colour.type();
  fill.colour = cv::Mat(region.size(), type, cv::Scalar::all(0));
  std::vector<Source> sources;
  for (const AlignedView& aligned : views) {
    const double apart = std::abs(aligned.view->at.timestamp - at.timestamp);
    sources.push_back({aligned.view, aligned.view_from_frame.rotation_matrix().cast<float>(),
                       aligned.view_from_frame.translation.cast<float>(), aligned.gain,
                       static_cast<float>(1 / (1 + apart / settings.memory)),
                       splat_depth(aligned, region, rays)});
    if (sources.size() == kMaxViews) break;
  }
  const Filler filler(std::move(sources), rays, settings);
  for (int y = 0; y < region.rows; ++y) {
    for (int x = 0; x < region.cols; ++x) {
      if (region.at<std::uint8_t>(y, x) == 0 || std::isnan(rays.ray(x, y)[0])) continue;
      const Opinion opinion = filler.at(x, y);
      if (opinion.colours == 0) continue;
      fill.known.at<std::uint8_t>(y, x) = 255;
      fill.depth.at<float>(y, x) = opinion.depth;
      std::uint8_t* pixel = fill.colour.ptr<std::uint8_t>(y) + x * fill.colour.channels();
      for (int c = 0; c < fill.colour.channels(); ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(opinion.colour[c]);
    }
  }
  return fill;
}

}  // namespace stdc
