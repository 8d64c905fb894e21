#include "features/extractor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/every_target.hpp"
#include "features/description/hamming.hpp"
#include "features/detection/fast.hpp"
#include "features/detection/pyramid.hpp"
#include "features/test_images.hpp"

namespace stdc {
namespace {

bool same(const Features& a, const Features& b) {
  if (a.keypoints.size() != b.keypoints.size() || a.descriptors != b.descriptors) return false;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const Keypoint &p = a.keypoints[i], &q = b.keypoints[i];
    if (p.x != q.x || p.y != q.y || p.angle != q.angle || p.response != q.response || p.level != q.level ||
        p.quality != q.quality)
      return false;
  }
  return true;
}

// What holds for every result.
void expect_sound(const Features& features, const FeatureExtractor& extractor, cv::Size size) {
  ASSERT_EQ(features.keypoints.size(), features.descriptors.size());
  EXPECT_EQ(features.keypoints.size(), extractor.cells().size());
  EXPECT_LE(static_cast<int>(features.keypoints.size()), extractor.settings().keypoints);
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const Keypoint& k = features.keypoints[i];
    ASSERT_LT(k.level, extractor.levels(size));
    const float margin = kBorder * extractor.scale(k.level) - 0.5F;
    ASSERT_GE(std::min(k.x, k.y), std::min(margin, static_cast<float>(kBorder)));
    ASSERT_LE(k.x, static_cast<float>(size.width) - kBorder);
    ASSERT_LE(k.y, static_cast<float>(size.height) - kBorder);
    ASSERT_TRUE(std::abs(k.angle) <= std::numbers::pi_v<float> && std::isfinite(k.response));
    const SelectionCell& cell = extractor.cells()[i];
    ASSERT_TRUE(cell.level == k.level && k.x > cell.left && k.x < cell.right && k.y > cell.top &&
                k.y < cell.bottom);
    if (i == 0) continue;
    const Keypoint& before = features.keypoints[i - 1];
    ASSERT_TRUE(std::tuple(before.level, before.y, before.x) < std::tuple(k.level, k.y, k.x));
  }
}

TEST(Extractor, MeetsTheBudgetWhereThereIsTexture) {
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    for (const cv::Size size : {cv::Size(640, 480), cv::Size(641, 477), cv::Size(320, 240)}) {
      FeatureExtractor extractor({.selection = selection, .keypoints = 300});
      const Features features = extractor.extract(test::rectangles_image(size.width, size.height, 4, 600));
      expect_sound(features, extractor, size);
      EXPECT_EQ(features.keypoints.size(), 300U);
    }
  }
}

TEST(Extractor, ServesEverySizeAndContent) {
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    for (const cv::Size size : {cv::Size(64, 64), cv::Size(65, 200), cv::Size(333, 64), cv::Size(1283, 95)}) {
      FeatureExtractor extractor({.selection = selection});
      for (const int grey : {0, 255}) {
        EXPECT_TRUE(extractor.extract(cv::Mat(size, CV_8UC1, cv::Scalar(grey))).keypoints.empty());
      }
      const Features features = extractor.extract(test::noise_image(size.width, size.height, 1));
      expect_sound(features, extractor, size);
      EXPECT_GT(features.keypoints.size(), 3U);
    }
  }
}

TEST(Extractor, RefusesWhatItCannotUse) {
  FeatureExtractor extractor;
  EXPECT_THROW(FeatureExtractor({.keypoints = 1}), Error);
  EXPECT_THROW(extractor.select(), Error);
  EXPECT_THROW(extractor.reject({}), Error);
  EXPECT_THROW(extractor.extract({}), Error);
  EXPECT_THROW(extractor.extract(cv::Mat(63, 640, CV_8UC1)), Error);
  EXPECT_THROW(extractor.extract(cv::Mat(480, 640, CV_8UC3)), Error);
  EXPECT_THROW(extractor.extract(cv::Mat(480, 640, CV_32FC1)), Error);
  extractor.detect(test::noise_image(100, 80, 1));
  EXPECT_THROW(extractor.reject(cv::Mat(80, 101, CV_8UC1, cv::Scalar(0))), Error);
  EXPECT_THROW(extractor.reject(cv::Mat(80, 100, CV_8UC3, cv::Scalar(0))), Error);
}

TEST(Extractor, GivesTheSameBytesAgainAndOnEveryTarget) {
  const cv::Mat image = test::rectangles_image(641, 477, 9, 500);
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    FeatureExtractor extractor({.selection = selection});
    const Features first = extractor.extract(image);
    extractor.extract(test::noise_image(200, 100, 3));
    EXPECT_TRUE(same(extractor.extract(image), first));
    EXPECT_TRUE(same(FeatureExtractor({.selection = selection}).extract(image), first));
    test::on_every_target([&] { EXPECT_TRUE(same(extractor.extract(image), first)); });
  }
}

TEST(Extractor, ReadsViewsOfLargerImages) {
  const cv::Mat large = test::rectangles_image(500, 400, 2);
  const cv::Mat view = large(cv::Rect(37, 21, 320, 240));
  FeatureExtractor extractor;
  EXPECT_TRUE(same(extractor.extract(view), extractor.extract(view.clone())));
}

TEST(Extractor, HighQualityIsWhatReachesTheHighThreshold) {
  const cv::Mat image = test::rectangles_image(640, 480, 6, 60, 12);
  FeatureExtractor extractor({.keypoints = 800});
  const Features features = extractor.extract(image);
  std::vector<Corner> corners;
  const PaddedImage padded = test::padded(image);
  find_fast_corners(padded.view(), kBorder, 7, corners);
  int checked = 0;
  for (const Keypoint& k : features.keypoints) {
    if (k.level != 0) continue;
    const auto corner = std::find_if(corners.begin(), corners.end(), [&](const Corner& c) {
      return static_cast<float>(c.x) == k.x && static_cast<float>(c.y) == k.y;
    });
    ASSERT_NE(corner, corners.end());
    EXPECT_EQ(k.quality == KeypointQuality::high, corner->score >= 20);
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

TEST(Extractor, TheMaskTakesKeypointsAndTheBudgetGoesToTheRest) {
  const cv::Mat image = test::rectangles_image(640, 480, 15, 900);
  cv::Mat mask(480, 640, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(100, 80, 300, 400)) = 255;
  for (const Selection selection : {Selection::improved, Selection::orb_slam3}) {
    FeatureExtractor extractor({.selection = selection, .keypoints = 400});
    extractor.detect(image);
    extractor.reject(mask);
    const Features features = extractor.select();
    expect_sound(features, extractor, image.size());
    EXPECT_EQ(features.keypoints.size(), 400U);
    for (const Keypoint& k : features.keypoints) {
      const float margin = 4 * extractor.scale(k.level);
      const float dx = std::max(100 - k.x, k.x - 399), dy = std::max(80 - k.y, k.y - 479);
      ASSERT_GT(std::max(dx, dy), margin);
    }
  }
}

TEST(Extractor, LowCandidatesStepInForMaskedHighOnes) {
  // High corners on the left only, low ones on the right; the mask hides the left.
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(100));
  for (int y = 30; y < 210; y += 14) {
    for (int x = 30; x < 300; x += 14) image(cv::Rect(x, y, 6, 6)) = x < 160 ? 180 : 112;
  }
  cv::Mat mask(240, 320, CV_8UC1, cv::Scalar(0));
  mask(cv::Rect(0, 0, 160, 240)) = 1;
  FeatureExtractor extractor({.keypoints = 60});
  const auto is_high = [](const Keypoint& k) { return k.quality == KeypointQuality::high; };
  const Features all = extractor.extract(image);
  EXPECT_TRUE(std::all_of(all.keypoints.begin(), all.keypoints.end(), is_high));
  extractor.detect(image);
  extractor.reject(mask);
  const Features masked = extractor.select();
  EXPECT_GT(masked.keypoints.size(), 4U);
  EXPECT_TRUE(std::none_of(masked.keypoints.begin(), masked.keypoints.end(), is_high));
}

TEST(Extractor, AFullMaskLeavesNothing) {
  FeatureExtractor extractor;
  extractor.detect(test::noise_image(200, 160, 2));
  extractor.reject(cv::Mat(160, 200, CV_8UC1, cv::Scalar(255)));
  EXPECT_TRUE(extractor.select().keypoints.empty());
}

// Share of keypoints that are found again, within 2 px of their level, at the place that `move` says, and
// with a descriptor that differs in at most 64 bits.
double found_again(const Features& a, const Features& b, const FeatureExtractor& extractor,
                   const std::function<cv::Point2f(cv::Point2f)>& move, cv::Size size) {
  int possible = 0, found = 0;
  for (std::size_t i = 0; i < a.keypoints.size(); ++i) {
    const cv::Point2f p = move({a.keypoints[i].x, a.keypoints[i].y});
    if (std::min(p.x, p.y) < 50 || p.x > static_cast<float>(size.width) - 51 ||
        p.y > static_cast<float>(size.height) - 51) {
      continue;
    }
    ++possible;
    for (std::size_t k = 0; k < b.keypoints.size(); ++k) {
      const Keypoint& q = b.keypoints[k];
      const bool near = std::hypot(q.x - p.x, q.y - p.y) < 2 * extractor.scale(q.level);
      if (near && hamming_distance(a.descriptors[i], b.descriptors[k]) <= 64) {
        ++found;
        break;
      }
    }
  }
  return possible > 0 ? static_cast<double>(found) / possible : 0;
}

cv::Mat rotated(const cv::Mat& image, double angle) {
  cv::Mat result(image.size(), CV_8UC1);
  const double c = std::cos(angle), s = std::sin(angle);
  const double cx = (image.cols - 1) / 2.0, cy = (image.rows - 1) / 2.0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double u = std::clamp(cx + c * (x - cx) + s * (y - cy), 0.0, image.cols - 1.001);
      const double v = std::clamp(cy - s * (x - cx) + c * (y - cy), 0.0, image.rows - 1.001);
      const int u0 = static_cast<int>(u), v0 = static_cast<int>(v);
      const auto at = [&](int row, int column) {
        return static_cast<double>(image.at<std::uint8_t>(row, column));
      };
      const double top = (1 - (u - u0)) * at(v0, u0) + (u - u0) * at(v0, u0 + 1);
      const double bottom = (1 - (u - u0)) * at(v0 + 1, u0) + (u - u0) * at(v0 + 1, u0 + 1);
      result.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround((1 - (v - v0)) * top + (v - v0) * bottom));
    }
  }
  return result;
}

TEST(Extractor, FindsTurnedPicturesAgain) {
  const cv::Size size(400, 400);
  const cv::Mat image = rotated(test::rectangles_image(400, 400, 31, 120, 2), 0.05);  // softens the steps
  FeatureExtractor extractor({.keypoints = 400});
  const Features original = extractor.extract(image);
  for (const double angle : {0.3, 0.8, 1.9, 3.1, -1.2}) {
    const auto move = [&](cv::Point2f p) {
      const auto c = static_cast<float>(std::cos(angle)), s = static_cast<float>(std::sin(angle));
      return cv::Point2f(199.5F + c * (p.x - 199.5F) - s * (p.y - 199.5F),
                         199.5F + s * (p.x - 199.5F) + c * (p.y - 199.5F));
    };
    const Features features = extractor.extract(rotated(image, angle));
    EXPECT_GT(found_again(original, features, extractor, move, size), 0.6) << angle;
  }
}

TEST(Extractor, DescriptorsIgnoreBrightnessAndContrast) {
  const cv::Mat image = test::rectangles_image(400, 300, 5, 150, 2);
  cv::Mat other;
  image.convertTo(other, CV_8UC1, 0.8, 25);
  FeatureExtractor extractor({.keypoints = 400});
  const Features original = extractor.extract(image);
  const auto stay = [](cv::Point2f p) { return p; };
  EXPECT_GT(found_again(original, extractor.extract(other), extractor, stay, image.size()), 0.8);
}

}  // namespace
}  // namespace stdc
