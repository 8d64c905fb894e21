#include "dense/inpainting/background_fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
  float z = 0;      ///< [m, frame] where it was asked about
  float score = 0;  ///< votes for it less those against it
  float depth = 0;  ///< as measured by those that see it [m, frame]; 0: none
  cv::Vec3f colour{0, 0, 0};
  float colours = 0;  ///< weight of the colours in `colour`
};

class Filler {
 public:
  Filler(std::vector<Source> sources, const RayTable& rays, const InpaintingSettings& settings)
      : sources_(std::move(sources)),
        rays_(rays),
        tolerance_(static_cast<float>(settings.depth_tolerance)),
        growth_(static_cast<float>(settings.depth_tolerance_growth)),
        colour_tolerance_(static_cast<float>(settings.colour_tolerance)) {
    for (std::size_t i = 0; i < sources_.size(); ++i) by_distance_.push_back(i);
    std::stable_sort(by_distance_.begin(), by_distance_.end(), [this](std::size_t a, std::size_t b) {
      return sources_[a].translation.norm() < sources_[b].translation.norm();
    });
  }

  /// The surface at a pixel and its colour; `colours` is 0 if nothing is known.
  Opinion at(int x, int y) const {
    Depths measured;
    for (const Source& source : sources_) {
      if (const float z = source.splat.measured.at<float>(y, x); z > 0) measured.add(z);
    }
    const Opinion best = best_surface(x, y, measured);
    if (best.colours > 0) return best;
    for (const std::size_t i : by_distance_) {
      const float z = sources_[i].splat.guessed.at<float>(y, x);
      if (z > 0) return ask(rays_.point(x, y, z), true);
    }
    return {};
  }

  /// The same where no view carries a surface to a pixel, but to its neighbours.
  Opinion beside(int x, int y, const cv::Mat& surface) const {
    float far = 0;
    int count = 0;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= surface.cols || y + dy >= surface.rows) continue;
        const float z = surface.at<float>(y + dy, x + dx);
        count += z > 0 ? 1 : 0;
        far = std::max(far, z);  // a hole beside an edge is behind it
      }
    }
    if (count < 2) return {};
    const Opinion seen = ask(rays_.point(x, y, far), false);
    return seen.colours > 0 && seen.score > 0 ? seen : ask(rays_.point(x, y, far), true);
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
      while (end < depths.count && depths.z[static_cast<std::size_t>(end)] < nearest + tolerance(nearest))
        ++end;
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
    opinion.z = point.z();
    float depths = 0, depth_sum = 0;
    cv::Vec3f first;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      // Seen from nearby a wrong guess does less harm.
      const Source& source = sources_[guess ? by_distance_[i] : i];
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
      const float max_difference = std::max({std::abs(apart[0]), std::abs(apart[1]), std::abs(apart[2])});
      const float weight = opinion.colours == 0 ? 1 : std::max(0.F, 1 - max_difference / colour_tolerance_);
      opinion.colour += weight * colour;
      opinion.colours += weight;
    }
    if (depths > 0) opinion.depth = depth_sum / depths;
    if (opinion.colours > 0) opinion.colour *= 1 / opinion.colours;
    return opinion;
  }

  std::vector<Source> sources_;
  std::vector<std::size_t> by_distance_;  ///< indices of the sources, the nearest first
  const RayTable& rays_;
  float tolerance_, growth_, colour_tolerance_;
};

/// Filling under way.
class Canvas {
 public:
  Canvas(const cv::Mat& region, int type)
      : fill_{cv::Mat(region.size(), type, cv::Scalar::all(0)),
              cv::Mat(region.size(), CV_32FC1, cv::Scalar(0)),
              cv::Mat(region.size(), CV_8UC1, cv::Scalar(0))},
        surface_(region.size(), CV_32FC1, cv::Scalar(0)) {}

  void put(int x, int y, const Opinion& opinion) {
    fill_.known.at<std::uint8_t>(y, x) = 255;
    fill_.depth.at<float>(y, x) = opinion.depth;
    surface_.at<float>(y, x) = opinion.z;
    const int channels = fill_.colour.channels();
    std::uint8_t* pixel = fill_.colour.ptr<std::uint8_t>(y) + x * channels;
    for (int c = 0; c < channels; ++c) pixel[c] = cv::saturate_cast<std::uint8_t>(opinion.colour[c]);
  }
  /// Cracks beside depth edges, where views know a colour but carry no surface to: from the rim inwards.
  void close_cracks(const Filler& filler, std::vector<cv::Point> missing) {
    constexpr int kRounds = 6;  // px
    for (int round = 0; round < kRounds && !missing.empty(); ++round) {
      const cv::Mat before = surface_.clone();
      std::erase_if(missing, [&](cv::Point at) {
        const Opinion opinion = filler.beside(at.x, at.y, before);
        if (opinion.colours == 0) return false;
        put(at.x, at.y, opinion);
        return true;
      });
    }
  }
  BackgroundFill take() { return std::move(fill_); }

 private:
  BackgroundFill fill_;
  cv::Mat surface_;  ///< CV_32FC1 [m], also where it is a guess
};

std::vector<Source> make_sources(const std::vector<AlignedView>& views, const std::vector<SplatDepth>& splats,
                                 const std::vector<float>& votes) {
  std::vector<Source> sources;
  for (std::size_t i = 0; i < std::min<std::size_t>(views.size(), kMaxViews); ++i) {
    sources.push_back({views[i].view, views[i].view_from_frame.rotation_matrix().cast<float>(),
                       views[i].view_from_frame.translation.cast<float>(), views[i].gain, votes[i],
                       splats[i]});
  }
  return sources;
}

}  // namespace

BackgroundFill fill_background(const std::vector<AlignedView>& views, const std::vector<SplatDepth>& splats,
                               const std::vector<float>& votes, const cv::Mat& region, const RayTable& rays,
                               const InpaintingSettings& settings) {
  const Filler filler(make_sources(views, splats, votes), rays, settings);
  Canvas canvas(region, views[0].view->colour.type());
  std::vector<cv::Point> missing;
  for (int y = 0; y < region.rows; ++y) {
    for (int x = 0; x < region.cols; ++x) {
      if (region.at<std::uint8_t>(y, x) == 0 || std::isnan(rays.ray(x, y)[0])) continue;
      const Opinion opinion = filler.at(x, y);
      if (opinion.colours > 0) {
        canvas.put(x, y, opinion);
      } else {
        missing.emplace_back(x, y);
      }
    }
  }
  canvas.close_cracks(filler, std::move(missing));
  return canvas.take();
}

}  // namespace stdc
