#include "segmentation/srm/refinement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/every_target.hpp"
#include "core/files/test_folder.hpp"
#include "core/files/text_file.hpp"
#include "core/images/image_codec.hpp"
#include "core/random.hpp"
#include "segmentation/srm/test_literal_refinement.hpp"

namespace stdc {
namespace {

using test::literal_refinement;
using test::on_every_target;

constexpr double kDepthUnits = 5000;

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_L1) == 0;
}

/// Holds `refine` against the definition for 16-bit depths and for the same depths in metres.
void expect_exact(const cv::Mat& mask, const cv::Mat& depth, const RefinementSettings& settings = {}) {
  const cv::Mat wanted = literal_refinement(mask, depth, kDepthUnits, settings);
  cv::Mat metres;
  depth.convertTo(metres, CV_32F, 1 / kDepthUnits);
  const cv::Mat wanted_in_metres = literal_refinement(mask, metres, kDepthUnits, settings);
  on_every_target([&] {
    EXPECT_TRUE(same(refine(mask, depth, kDepthUnits, settings), wanted));
    EXPECT_TRUE(same(refine(mask, metres, kDepthUnits, settings), wanted_in_metres));
  });
}

/// Depths and mask of blobs and slopes that overlap, with holes: what a person before a desk looks like.
struct Scene {
  cv::Mat mask, depth;
};

Scene blobs(cv::Size size, Random& random) {
  Scene scene{cv::Mat::zeros(size, CV_8UC1), cv::Mat(size, CV_16UC1)};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x)
      scene.depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(9000 + 20 * x + 30 * y);
  }
  for (int i = 0; i < 12; ++i) {
    const cv::Point centre(static_cast<int>(random.below(static_cast<unsigned>(size.width))),
                           static_cast<int>(random.below(static_cast<unsigned>(size.height))));
    const cv::Size axes(3 + static_cast<int>(random.below(40)), 3 + static_cast<int>(random.below(40)));
    const double depth = random.uniform(3000, 14000);
    cv::ellipse(scene.depth, centre, axes, random.uniform(0, 180), 0, 360, cv::Scalar(depth), cv::FILLED);
    if (i % 2 == 0)
      cv::ellipse(scene.mask, centre, {axes.width * 4 / 5, axes.height * 4 / 5}, 0, 0, 360,
                  cv::Scalar(1 + i * 20), cv::FILLED);
    if (i % 4 == 1) cv::circle(scene.depth, centre, 5, cv::Scalar(0), cv::FILLED);
  }
  for (int i = 0; i < size.area() / 2; ++i) {
    auto& depth =
        scene.depth.at<std::uint16_t>(static_cast<int>(random.below(static_cast<unsigned>(size.height))),
                                      static_cast<int>(random.below(static_cast<unsigned>(size.width))));
    if (depth != 0) depth = static_cast<std::uint16_t>(depth + random.below(60));
  }
  return scene;
}

TEST(Refinement, EqualsTheDefinitionOnScenes) {
  Random random(1);
  for (const cv::Size size : {cv::Size(320, 240), {131, 97}, {64, 200}, {17, 17}, {16, 5}, {5, 40}}) {
    for (int i = 0; i < 3; ++i) {
      const Scene scene = blobs(size, random);
      expect_exact(scene.mask, scene.depth);
    }
  }
}

TEST(Refinement, EqualsTheDefinitionOnNoise) {
  Random random(2);
  for (const double dynamic : {0.001, 0.02, 0.5, 1.0}) {
    for (const unsigned depths : {3U, 2000U, 65536U}) {
      cv::Mat mask(90, 150, CV_8UC1), depth(90, 150, CV_16UC1);
      for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
          mask.at<std::uint8_t>(y, x) =
              random.uniform() < dynamic ? static_cast<std::uint8_t>(1 + random.below(255)) : 0;
          depth.at<std::uint16_t>(y, x) =
              static_cast<std::uint16_t>(random.below(depths) * (depths == 3 ? 800 : 1));
        }
      }
      expect_exact(mask, depth);
    }
  }
}

TEST(Refinement, EqualsTheDefinitionForOtherWindowsAndThresholds) {
  Random random(3);
  const Scene scene = blobs({200, 120}, random);
  for (const int window : {1, 3, 5, 15, 31, 65}) {
    for (const double tau : {0.0, 0.02, 0.1, 10.0}) expect_exact(scene.mask, scene.depth, {window, tau});
  }
}

TEST(Refinement, ComparesDepthsAtBothEndsOfTheirRange) {
  Random random(4);
  cv::Mat mask(40, 60, CV_8UC1), depth(40, 60, CV_16UC1);
  const std::uint16_t depths[] = {0, 1, 2, 499, 500, 501, 502, 1001, 64535, 65034, 65035, 65534, 65535};
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      mask.at<std::uint8_t>(y, x) = random.below(40) == 0 ? 255 : 0;
      depth.at<std::uint16_t>(y, x) = depths[random.below(13)];
    }
  }
  expect_exact(mask, depth);
  expect_exact(mask, depth, {3, 0.1});
  expect_exact(mask, depth, {17, 10});
}

TEST(Refinement, TakesDepthsThatAreNotNumbersForMissing) {
  Random random(5);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const float depths[] = {0, -1, -kInfinity, kInfinity, std::nanf(""), 0.05F, 1, 1.05F, 1.2F, 3};
  cv::Mat mask(50, 70, CV_8UC1), depth(50, 70, CV_32FC1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      mask.at<std::uint8_t>(y, x) = random.below(60) == 0 ? 255 : 0;
      depth.at<float>(y, x) = depths[random.below(10)];
    }
  }
  const cv::Mat wanted = literal_refinement(mask, depth, kDepthUnits, {});
  on_every_target([&] { EXPECT_TRUE(same(refine(mask, depth, kDepthUnits), wanted)); });
}

TEST(Refinement, ThresholdIsInMetresAndInclusive) {
  cv::Mat mask = cv::Mat::zeros(1, 9, CV_8UC1), depth(1, 9, CV_16UC1, cv::Scalar(0));
  mask.at<std::uint8_t>(0, 4) = 7;
  const int depths[] = {1000, 1500, 1501, 999, 1000, 500, 499, 1350, 1351};
  for (int x = 0; x < 9; ++x) depth.at<std::uint16_t>(0, x) = static_cast<std::uint16_t>(depths[x]);
  const cv::Mat by_500 = (cv::Mat_<std::uint8_t>(1, 9) << 255, 255, 0, 255, 255, 255, 0, 255, 255);
  EXPECT_TRUE(same(refine(mask, depth, 5000), by_500));
  // 0.07 * 5000 is a little less than 350 in binary.
  const cv::Mat by_350 = (cv::Mat_<std::uint8_t>(1, 9) << 255, 0, 0, 255, 255, 0, 0, 255, 0);
  EXPECT_TRUE(same(refine(mask, depth, 5000, {17, 0.07}), by_350));
  EXPECT_TRUE(same(refine(mask, depth, 1000, {17, 0.35}), by_350));
}

TEST(Refinement, ReachesTheCornersOfTheWindowAndNotBeyond) {
  cv::Mat mask = cv::Mat::zeros(40, 40, CV_8UC1);
  const cv::Mat depth(40, 40, CV_16UC1, cv::Scalar(5000));
  mask.at<std::uint8_t>(20, 15) = 255;
  cv::Mat wanted = cv::Mat::zeros(40, 40, CV_8UC1);
  wanted(cv::Rect(15 - 8, 20 - 8, 17, 17)) = 255;
  EXPECT_TRUE(same(refine(mask, depth, kDepthUnits), wanted));
}

TEST(Refinement, PixelsWithoutDepthKeepThemselvesOnly) {
  cv::Mat mask = cv::Mat::zeros(30, 30, CV_8UC1), depth(30, 30, CV_16UC1, cv::Scalar(100));
  mask.at<std::uint8_t>(15, 15) = 255;
  depth.at<std::uint16_t>(15, 15) = 0;
  const cv::Mat result = refine(mask, depth, kDepthUnits);
  EXPECT_EQ(cv::countNonZero(result), 1);
  EXPECT_EQ(result.at<std::uint8_t>(15, 15), 255);
}

TEST(Refinement, EmptyMasksStayEmpty) {
  const cv::Mat depth(48, 64, CV_16UC1, cv::Scalar(5000));
  EXPECT_EQ(cv::countNonZero(refine(cv::Mat::zeros(48, 64, CV_8UC1), depth, kDepthUnits)), 0);
  EXPECT_TRUE(refine(cv::Mat(0, 0, CV_8UC1), cv::Mat(0, 0, CV_16UC1), kDepthUnits).empty());
}

TEST(Refinement, WorksOnPartsOfLargerImages) {
  Random random(6);
  const Scene scene = blobs({160, 120}, random);
  const cv::Rect part(13, 7, 101, 77);
  expect_exact(scene.mask(part), scene.depth(part));
}

TEST(Refinement, MayReplaceTheMask) {
  Random random(7);
  const Scene scene = blobs({160, 120}, random);
  cv::Mat mask = scene.mask.clone();
  refine(mask, scene.depth, kDepthUnits, {}, mask);
  EXPECT_TRUE(same(mask, refine(scene.mask, scene.depth, kDepthUnits)));
}

TEST(Refinement, RefusesWhatDoesNotFit) {
  using test::message_of;
  const cv::Mat mask(48, 64, CV_8UC1, cv::Scalar(0)), depth(48, 64, CV_16UC1, cv::Scalar(0));
  EXPECT_NE(message_of([&] { refine(mask, depth.rowRange(0, 40), kDepthUnits); }).find("64 x 48"),
            std::string::npos);
  EXPECT_NE(message_of([&] { refine(depth, depth, kDepthUnits); }), "");
  EXPECT_NE(message_of([&] { refine(mask, mask, kDepthUnits); }), "");
  EXPECT_NE(message_of([&] {
              refine(mask, depth, kDepthUnits, {16, 0.1});
            }).find("refinement.window"),
            std::string::npos);
  EXPECT_NE(message_of([&] {
              refine(mask, depth, kDepthUnits, {17, std::nan("")});
            }).find("refinement.tau"),
            std::string::npos);
}

/// Real depth images, with what is nearer than the median for a mask. They are not part of the project.
TEST(Refinement, EqualsTheDefinitionOnRealDepth) {
  const std::filesystem::path folder = std::filesystem::path(STDC_SHARED_DATA) / "sequences";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "there are no real sequences in " << folder;
  int images = 0;
  for (const auto& sequence : std::filesystem::directory_iterator(folder)) {
    int index = 0;
    for (const auto& entry : std::filesystem::directory_iterator(sequence.path() / "depth")) {
      if (index++ % 120 != 0) continue;
      const std::string bytes = read_file(entry.path(), "");
      const cv::Mat depth =
          decode_depth({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {640, 480}).image;
      ASSERT_FALSE(depth.empty()) << entry.path();
      cv::Mat mask = (depth > 0) & (depth < cv::sum(depth)[0] / cv::countNonZero(depth));
      cv::erode(mask, mask, cv::Mat(), {-1, -1}, 4);
      const cv::Mat refined = refine(mask, depth, kDepthUnits);
      EXPECT_TRUE(same(refined, literal_refinement(mask, depth, kDepthUnits, {}))) << entry.path();
      ++images;
    }
  }
  EXPECT_GT(images, 0);
}

}  // namespace
}  // namespace stdc
