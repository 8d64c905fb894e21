#include "dead_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

struct Leaf {
  double x, y, radius;            // [px]
  double cosine, sine;            // of its rotation
  double aspect;                  // height over width
  bool is_box;                    // else an ellipse
  double grey, slope_u, slope_v;  // grey level at the centre, and its change per radius along the axes
};

Leaf random_leaf(cv::Size size, Random& random) {
  constexpr double kMin = 3, kMax = 250;
  Leaf leaf{};
  leaf.x = random.uniform(-0.1, 1.1) * size.width;
  leaf.y = random.uniform(-0.1, 1.1) * size.height;
  // Inverse of the distribution function of r^-3 between the two radii.
  const double low = 1 / (kMin * kMin), high = 1 / (kMax * kMax);
  leaf.radius = 1 / std::sqrt(low + random.uniform() * (high - low));
  const double rotation = random.uniform(0, 2 * std::numbers::pi);
  leaf.cosine = std::cos(rotation);
  leaf.sine = std::sin(rotation);
  leaf.aspect = random.uniform(0.25, 1);
  leaf.is_box = random.below(2) == 0;
  leaf.grey = random.uniform(10, 245);
  leaf.slope_u = 12 * random.normal();
  leaf.slope_v = 12 * random.normal();
  return leaf;
}

void paint(const Leaf& leaf, cv::Mat& image) {
  const int reach = static_cast<int>(std::ceil(leaf.radius * std::numbers::sqrt2));
  const int left = std::max(0, static_cast<int>(leaf.x) - reach),
            top = std::max(0, static_cast<int>(leaf.y) - reach);
  const int right = std::min(image.cols - 1, static_cast<int>(leaf.x) + reach);
  const int bottom = std::min(image.rows - 1, static_cast<int>(leaf.y) + reach);
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double dx = (x - leaf.x) / leaf.radius, dy = (y - leaf.y) / leaf.radius;
      const double u = leaf.cosine * dx + leaf.sine * dy;
      const double v = (leaf.cosine * dy - leaf.sine * dx) / leaf.aspect;
      const bool inside = leaf.is_box ? std::max(std::abs(u), std::abs(v)) <= 1 : u * u + v * v <= 1;
      if (inside) image.at<float>(y, x) = static_cast<float>(leaf.grey + leaf.slope_u * u + leaf.slope_v * v);
    }
  }
}

}  // namespace

cv::Mat dead_leaves(cv::Size size, std::uint64_t seed) {
  constexpr double kBlur = 0.7, kNoise = 2;
  Random random(seed);
  cv::Mat image(size, CV_32FC1, cv::Scalar(128));
  const int leaves = size.area() / 40;  // enough that nothing of the ground is left
  for (int i = 0; i < leaves; ++i) paint(random_leaf(size, random), image);
  cv::GaussianBlur(image, image, {}, kBlur);
  cv::Mat grey(size, CV_8UC1);
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double value = std::lround(image.at<float>(y, x) + kNoise * random.normal());
      grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
    }
  }
  return grey;
}

}  // namespace stdc
