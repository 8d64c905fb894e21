#include "simulation/compose/mover_paster.hpp"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "simulation/scene/colour.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kExposure = 1.55F;  // as in the rendered sequences

/// Embree needs something to look for: a speck a kilometre below.
std::unique_ptr<Mesh> speck() {
  auto mesh = std::make_unique<Mesh>();
  for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {1e-3F, 0.0F}, {0.0F, 1e-3F}, {1e-3F, 1e-3F}}) {
    mesh->positions.emplace_back(x, y, -1000.0F);
    mesh->normals.emplace_back(0.0F, 0.0F, 1.0F);
    mesh->uvs.emplace_back(0.0F, 0.0F);
  }
  mesh->finish_patch(1, 1, 0);
  return mesh;
}

/// Whether a pixel and a neighbour of it (left, right, above, below) differ in the mask.
bool on_outline(const cv::Mat& mask, int x, int y) {
  const std::uint8_t here = mask.at<std::uint8_t>(y, x);
  return (x > 0 && mask.at<std::uint8_t>(y, x - 1) != here) ||
         (x + 1 < mask.cols && mask.at<std::uint8_t>(y, x + 1) != here) ||
         (y > 0 && mask.at<std::uint8_t>(y - 1, x) != here) ||
         (y + 1 < mask.rows && mask.at<std::uint8_t>(y + 1, x) != here);
}

/// Recorded depth [m] to compare with. A hole counts as the nearer of the surfaces beside it in its row, so
/// that nothing shows through a dark screen that stands before it; 0 in rows without any depth.
cv::Mat without_holes(const cv::Mat& recorded, double units_per_metre) {
  constexpr float kNone = 1e9F;
  cv::Mat depth;
  recorded.convertTo(depth, CV_32F, 1 / units_per_metre);
  std::vector<float> from_right(static_cast<std::size_t>(depth.cols));
  for (int y = 0; y < depth.rows; ++y) {
    auto* z = depth.ptr<float>(y);
    float near = kNone;
    for (int x = depth.cols - 1; x >= 0; --x) from_right[x] = near = z[x] > 0 ? z[x] : near;
    near = kNone;
    for (int x = 0; x < depth.cols; ++x) {
      if (z[x] > 0) {
        near = z[x];
      } else {
        const float beside = std::min(near, from_right[x]);
        z[x] = beside < kNone ? beside : 0;
      }
    }
  }
  return depth;
}

}  // namespace

MoverPaster::MoverPaster(const Camera& camera, const SurfaceShader& shader)
    : camera_(camera),
      rays_(camera),
      nothing_(speck()),
      empty_(*nothing_, TreeQuality::fast),
      renderer_(rays_, empty_, shader),
      depth_sensor_(camera) {}

/// Share of each pixel that the mover covers, CV_32FC1, by the samples that RayRenderer takes: its colours
/// are multiplied by it, as nothing is behind the mover.
cv::Mat MoverPaster::covered(const IdealImage& ideal, const Pose& world_from_cam,
                             const MovingObjects& mover) const {
  constexpr int kSamples = 4;
  static constexpr std::array<std::array<float, 2>, kSamples> kOffsets{
      {{-0.125F, -0.375F}, {0.375F, -0.125F}, {0.125F, 0.375F}, {-0.375F, 0.125F}}};
  const Eigen::Matrix3f rotation = world_from_cam.rotation_matrix().cast<float>();
  const Vector3f origin = world_from_cam.translation.cast<float>();
  const cv::Mat& centres = ideal.moved;
  cv::Mat share(centres.size(), CV_32FC1);
  for (int y = 0; y < share.rows; ++y) {
    for (int x = 0; x < share.cols; ++x) {
      const bool centre = centres.at<std::uint8_t>(y, x) != 0;
      if (!on_outline(centres, x, y)) {
        share.at<float>(y, x) = centre ? 1.0F : 0.0F;
        continue;
      }
      std::array<Vector3f, kSamples> directions;
      std::array<Hit, kSamples> hits;
      for (int i = 0; i < kSamples; ++i) {
        const Eigen::Vector2f ray = rays_.at(x, y, kOffsets[i][0], kOffsets[i][1]);
        directions[i] = rotation * Vector3f(ray.x(), ray.y(), 1);
      }
      mover.trace(origin, directions.data(), kSamples, hits.data());
      int count = centre ? 1 : 0;
      for (const Hit& hit : hits) count += hit.valid() ? 1 : 0;
      share.at<float>(y, x) = static_cast<float>(count) / (kSamples + 1);
    }
  }
  return share;
}

cv::Mat MoverPaster::pasted_colour(const RgbdImage& recorded, const IdealImage& ideal, const cv::Mat& share,
                                   std::uint64_t seed) const {
  cv::Mat linear = ideal.colour.clone();
  for (int y = 0; y < linear.rows; ++y) {
    for (int x = 0; x < linear.cols; ++x) {
      const float behind = (1 - share.at<float>(y, x)) / kExposure;
      if (behind <= 0) continue;
      const auto& bgr = recorded.colour.at<cv::Vec3b>(y, x);
      auto& rgb = linear.at<cv::Vec3f>(y, x);
      for (int c = 0; c < 3; ++c) rgb[c] += behind * linear_of_byte()[bgr[2 - c]];
    }
  }
  const cv::Mat seen = colour_sensor_.image(linear, kExposure, seed);
  cv::Mat result = recorded.colour.clone();
  seen.copyTo(result, share > 0);
  return result;
}

cv::Mat MoverPaster::pasted_depth(const RgbdImage& recorded, const IdealImage& ideal, const cv::Mat& mask,
                                  std::uint64_t seed) const {
  cv::Mat scene;
  recorded.depth.convertTo(scene, CV_32F, 1 / camera_.depth_units_per_metre);
  cv::Mat infrared(scene.size(), CV_32FC1, cv::Scalar(1));
  const cv::Mat alone = depth_sensor_.image(scene, infrared, seed);
  ideal.depth.copyTo(scene, mask);
  ideal.infrared.copyTo(infrared, mask);
  const cv::Mat together = depth_sensor_.image(scene, infrared, seed);
  cv::Mat result = recorded.depth.clone();
  result.setTo(0, (alone > 0) & (together == 0));  // in the mover's shadow
  together.copyTo(result, mask);
  return result;
}

PastedFrame MoverPaster::paste(const RgbdImage& recorded, const Pose& world_from_cam,
                               const MovingObjects& mover, std::uint64_t seed) const {
  const IdealImage ideal = renderer_.render(world_from_cam, &mover);
  const cv::Mat metres = without_holes(recorded.depth, camera_.depth_units_per_metre);
  const cv::Mat hidden = (metres > 0) & (metres < ideal.depth);
  PastedFrame frame{{recorded.timestamp, {}, {}}, ideal.moved & ~hidden};
  cv::Mat share = covered(ideal, world_from_cam, mover);
  cv::Mat seen;  // outlines reach one pixel beyond
  cv::dilate(frame.mask, seen, cv::Mat::ones(3, 3, CV_8U));
  share.setTo(0, hidden | ~seen);
  frame.image.colour = pasted_colour(recorded, ideal, share, seed);
  frame.image.depth = pasted_depth(recorded, ideal, frame.mask, seed);
  return frame;
}

}  // namespace stdc::simulation
