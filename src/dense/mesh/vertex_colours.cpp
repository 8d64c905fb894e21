#include "dense/mesh/vertex_colours.hpp"

#include <algorithm>
#include <cmath>

#include "dense/fusion/depth_noise.hpp"
#include "dense/fusion/view_batches.hpp"
#include "dense/fusion/view_codec.hpp"
#include "dense/parallel.hpp"

namespace stdc {
namespace {

constexpr std::size_t kRun = 256;  ///< vertices that are looked at, or passed over, together

/// Weighted sums of blue, green and red: integers, so that order does not matter.
struct ColourSum {
  std::array<std::uint32_t, 3> channels{};
  std::uint32_t weight = 0;
};

/// A ball around a run of vertices, which are near to each other: they come in the order of the blocks.
struct Ball {
  Eigen::Vector3f centre;
  float radius = 0;
};

std::vector<Ball> balls_of(const TriangleMesh& mesh) {
  std::vector<Ball> balls;
  for (std::size_t first = 0; first < mesh.positions.size(); first += kRun) {
    const std::size_t last = std::min(first + kRun, mesh.positions.size());
    Eigen::Vector3f low = mesh.positions[first], high = low;
    for (std::size_t i = first; i < last; ++i) {
      low = low.cwiseMin(mesh.positions[i]), high = high.cwiseMax(mesh.positions[i]);
    }
    balls.push_back({(low + high) / 2, (high - low).norm() / 2});
  }
  return balls;
}

class ViewColours {
 public:
  ViewColours(const ViewSamples& samples, const cv::Mat& colour, const Pose& cam_from_world, float voxel)
      : samples_(samples),
        colour_(colour),
        rotation_(cam_from_world.rotation_matrix().cast<float>()),
        shift_(cam_from_world.translation.cast<float>()),
        voxel_(voxel) {}

  bool may_see(const Ball& ball) const {
    const Eigen::Vector3f centre = rotation_ * ball.centre + shift_;
    if (centre.z() + ball.radius < kNearest) return false;
    if (centre.z() < 2 * ball.radius) return true;
    const Pinhole& pinhole = samples_.pinhole;
    const float reach_x = 2 * pinhole.fx * ball.radius / (centre.z() - ball.radius),
                reach_y = 2 * pinhole.fy * ball.radius / (centre.z() - ball.radius);
    const float u = pinhole.fx * centre.x() / centre.z() + pinhole.cx,
                v = pinhole.fy * centre.y() / centre.z() + pinhole.cy;
    return u + reach_x >= 0 && v + reach_y >= 0 && u - reach_x <= static_cast<float>(pinhole.width) &&
           v - reach_y <= static_cast<float>(pinhole.height);
  }
  void add(const Eigen::Vector3f& position, ColourSum& sum) const {
    const Eigen::Vector3f point = rotation_ * position + shift_;
    if (point.z() < kNearest) return;
    const Pinhole& pinhole = samples_.pinhole;
    const float u = pinhole.fx * point.x() / point.z() + pinhole.cx,
                v = pinhole.fy * point.y() / point.z() + pinhole.cy;
    if (!(u >= 0 && v >= 0 && u < static_cast<float>(pinhole.width - 1) &&
          v < static_cast<float>(pinhole.height - 1))) {
      return;
    }
    const auto pixel =
        static_cast<std::size_t>(static_cast<int>(v + 0.5F) * pinhole.width + static_cast<int>(u + 0.5F));
    const std::uint32_t weight = samples_.infos[pixel] & ViewSamples::kWeight;
    if (weight == 0 || std::abs(samples_.depths[pixel] - point.z()) > voxel_ + depth_tolerance(point.z()))
      return;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    // In 1/16 of a pixel, which is finer than poses are known.
    const auto a = static_cast<std::uint32_t>((u - static_cast<float>(x)) * 16),
               b = static_cast<std::uint32_t>((v - static_cast<float>(y)) * 16);
    const auto* upper = colour_.ptr<std::uint8_t>(y) + 3 * x;
    const auto* lower = colour_.ptr<std::uint8_t>(y + 1) + 3 * x;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t value =
          (16 - b) * ((16 - a) * upper[c] + a * upper[c + 3]) + b * ((16 - a) * lower[c] + a * lower[c + 3]);
      sum.channels[static_cast<std::size_t>(c)] += weight * (value >> 5U);  // 0..2040
    }
    sum.weight += weight;
  }

 private:
  static constexpr float kNearest = 0.1F;  ///< [m]
  const ViewSamples& samples_;
  const cv::Mat& colour_;
  Eigen::Matrix3f rotation_;
  Eigen::Vector3f shift_;
  float voxel_;
};

}  // namespace

void colour_vertices(TriangleMesh& mesh, const std::vector<PlacedView>& views, const Pinhole& pinhole,
                     const DenseSettings& settings, int threads) {
  threads = threads_or_cores(threads);
  const std::vector<Ball> balls = balls_of(mesh);
  std::vector<ColourSum> sums(mesh.positions.size());
  for_each_view(views, pinhole, settings.min_frames, threads, make_samples,
                [&](std::size_t first, const SampleBatch& samples) {
                  std::vector<cv::Mat> colours(samples.size());
                  parallel_for(samples.size(), threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) {
                      if (!samples[i].empty())
                        colours[i] = decode_colour(*views[first + i].view, {pinhole.width, pinhole.height});
                    }
                  });
                  parallel_for(balls.size(), threads, [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = 0; i < samples.size(); ++i) {
                      if (samples[i].empty() || colours[i].empty()) continue;
                      const ViewColours view(samples[i], colours[i], views[first + i].cam_from_world,
                                             static_cast<float>(settings.voxel));
                      for (std::size_t run = begin; run < end; ++run) {
                        if (!view.may_see(balls[run])) continue;
                        const std::size_t last = std::min((run + 1) * kRun, mesh.positions.size());
                        for (std::size_t v = run * kRun; v < last; ++v) view.add(mesh.positions[v], sums[v]);
                      }
                    }
                  });
                });
  mesh.colours.resize(sums.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const ColourSum& sum = sums[v];
    for (std::size_t c = 0; c < 3; ++c) {
      constexpr std::uint8_t kGrey = 128;
      mesh.colours[v][2 - c] =
          sum.weight == 0 ? kGrey : static_cast<std::uint8_t>((sum.channels[c] / sum.weight + 4) / 8);
    }
  }
}

}  // namespace stdc
