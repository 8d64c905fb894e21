#include "simulation/scene/texture.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "simulation/scene/surface_textures.hpp"

namespace stdc::simulation {
namespace {

TEST(Texture, KeepsColoursAndFiltersThem) {
  cv::Mat checks(8, 8, CV_8UC3);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      checks.at<cv::Vec3b>(y, x) = (x + y) % 2 == 0 ? cv::Vec3b(255, 255, 255) : cv::Vec3b(0, 0, 0);
    }
  }
  const Texture texture(checks);
  EXPECT_NEAR(texture.sample(0.5F / 8, 0.5F / 8, 1).x(), 1, 1e-3);    // centre of a white texel
  EXPECT_NEAR(texture.sample(1.5F / 8, 0.5F / 8, 1).x(), 0, 1e-3);    // and of a black one
  EXPECT_NEAR(texture.sample(1.0F / 8, 0.5F / 8, 1).x(), 0.5, 1e-2);  // between them
  EXPECT_NEAR(texture.sample(-7.5F / 8, 8.5F / 8, 1).x(), 1, 1e-3);   // it repeats
  EXPECT_NEAR(texture.sample(0.3F, 0.7F, 4).x(), 0.5, 2e-2);  // from afar: half the light, not half the code
  EXPECT_NEAR(texture.mean().x(), 0.5, 1e-2);
}

TEST(Texture, KeepsRedGreenBlueApart) {
  const Texture texture(cv::Mat(2, 4, CV_8UC3, cv::Scalar(10, 100, 200)));  // blue, green, red
  const Rgb expected = rgb8(200, 100, 10);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(texture.sample(0.1F, 0.2F, 1)[c], expected[c], 5e-3) << c;
}

TEST(SurfaceTextures, AreTheSameForTheSameSeed) {
  const cv::Mat a = parquet_texture({170, 120, 70}, 3), b = parquet_texture({170, 120, 70}, 3);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0);
  EXPECT_NE(cv::norm(a, parquet_texture({170, 120, 70}, 4), cv::NORM_INF), 0);
}

TEST(FractalNoise, TilesWithoutASeam) {
  const cv::Mat noise = fractal_noise(128, 64, 4, 4, 3, 9);
  double inside = 0, seam = 0;
  for (int y = 0; y < 64; ++y) {
    inside = std::max<double>(inside, std::abs(noise.at<float>(y, 64) - noise.at<float>(y, 63)));
    seam = std::max<double>(seam, std::abs(noise.at<float>(y, 0) - noise.at<float>(y, 127)));
  }
  EXPECT_LT(seam, 2 * inside + 0.05);
}

}  // namespace
}  // namespace stdc::simulation
