#include "dense/inpainting/inpainter.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/core.hpp>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

constexpr int kMargin = 4;
const cv::Rect kMover(60, 40, 30, 30);

InpaintingSettings settings() {
  InpaintingSettings settings;
  settings.margin = kMargin;
  settings.feather = 2;
  return settings;
}

class InpainterTest : public testing::Test {
 protected:
  std::shared_ptr<const BackgroundView> view(int frame, double x, cv::Rect mover = {}, double exposure = 1,
                                             bool detected = true) const {
    const cv::Mat mask = PlaneScene::mask(detected ? mover : cv::Rect());
    return std::make_shared<const BackgroundView>(
        inpainter_.view(PlaneScene::image(x, mover, exposure), mask,
                        {frame, frame / 30.0, MapId{0}, PlaneScene::world_from_cam(x)}));
  }
  /// The mover at kMover before a camera at x = 0.
  InpaintedFrame inpaint(const BackgroundStore::Views& views, int frame = 30) const {
    const auto present = view(frame, 0, kMover);
    return inpainter_.inpaint(PlaneScene::image(0, kMover), *present, PlaneScene::mask(kMover), views);
  }
  static double worst_colour(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF); }

  Inpainter inpainter_{PlaneScene::camera(), settings()};
};

TEST_F(InpainterTest, FillsWhatAnEarlierViewSaw) {
  const InpaintedFrame result = inpaint({view(0, 0.1), view(10, -0.13)});
  const RgbdImage clean = PlaneScene::image(0);
  EXPECT_EQ(cv::countNonZero(result.unknown), 0);
  EXPECT_LE(worst_colour(result.colour, clean.colour), 5);
  EXPECT_LE(cv::norm(result.depth, clean.depth, cv::NORM_INF), 2);  // of 5000 a metre
}

TEST_F(InpainterTest, WhatNoViewSawStaysUnknown) {
  // The view has the mover too: 15 px of parallax before the wall uncover a part only.
  const InpaintedFrame result = inpaint({view(0, 0.2, kMover)});
  const cv::Mat region = inpainter_.region(PlaneScene::mask(kMover));
  const int unknown = cv::countNonZero(result.unknown);
  EXPECT_GT(unknown, cv::countNonZero(region) / 4);
  EXPECT_LT(unknown, cv::countNonZero(region) * 3 / 4);
  EXPECT_EQ(cv::countNonZero(result.unknown & ~region), 0);
  cv::Mat black;
  cv::inRange(result.colour, cv::Scalar::all(0), cv::Scalar::all(0), black);
  EXPECT_EQ(cv::countNonZero(result.unknown & ~black), 0);
  EXPECT_EQ(cv::countNonZero(result.unknown & (result.depth != 0)), 0);
  const RgbdImage clean = PlaneScene::image(0);
  cv::Mat known = clean.colour.clone();
  known.setTo(0, result.unknown);
  EXPECT_LE(worst_colour(result.colour, known), 5);
}

TEST_F(InpainterTest, WithoutViewsAllIsUnknown) {
  const InpaintedFrame result = inpaint({});
  EXPECT_EQ(cv::countNonZero(result.unknown != inpainter_.region(PlaneScene::mask(kMover))), 0);
}

TEST_F(InpainterTest, WithoutAMaskTheFrameStaysAsItIs) {
  const RgbdImage image = PlaneScene::image(0);
  const auto present = view(30, 0);
  const InpaintedFrame result = inpainter_.inpaint(image, *present, PlaneScene::mask({}), {view(0, 0.1)});
  EXPECT_EQ(worst_colour(result.colour, image.colour), 0);
  EXPECT_EQ(cv::norm(result.depth, image.depth, cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(result.unknown), 0);
}

TEST_F(InpainterTest, MatchesTheExposure) {
  const InpaintedFrame result = inpaint({view(0, 0.1, {}, 0.7)});
  EXPECT_LE(worst_colour(result.colour, PlaneScene::image(0).colour), 6);
}

TEST_F(InpainterTest, AViewThatStillHasTheMoverIsOutvoted) {
  // The newest and nearest view shows the mover unmasked; two older ones see through it.
  const InpaintedFrame result = inpaint({view(28, 0, kMover, 1, false), view(10, 0.1), view(14, -0.1)});
  EXPECT_LE(worst_colour(result.colour, PlaneScene::image(0).colour), 6);
  EXPECT_EQ(cv::countNonZero(result.unknown), 0);
}

TEST_F(InpainterTest, CompletesAMaskThatMissesAPartOfTheMover) {
  const auto present = view(30, 0, kMover);
  cv::Mat half = PlaneScene::mask(kMover);
  half.colRange(kMover.x + 12, half.cols) = 0;
  const InpaintedFrame result =
      inpainter_.inpaint(PlaneScene::image(0, kMover), *present, half, {view(0, 0.1), view(10, -0.1)});
  EXPECT_EQ(cv::countNonZero(PlaneScene::mask(kMover) & ~result.replaced), 0);
  EXPECT_LE(worst_colour(result.colour, PlaneScene::image(0).colour), 5);
  // Elsewhere the frame stays as it is.
  EXPECT_EQ(cv::countNonZero(result.replaced & ~inpainter_.region(PlaneScene::mask(kMover))), 0);
}

TEST_F(InpainterTest, DepthlessPixelsAreFilledInColour) {
  // The sensor is blind on a part of the wall, as beyond its range.
  RgbdImage earlier = PlaneScene::image(0.05);
  earlier.depth(cv::Rect(50, 30, 50, 50)) = 0;
  const auto blind = std::make_shared<const BackgroundView>(
      inpainter_.view(earlier, PlaneScene::mask({}), {0, 0, MapId{0}, PlaneScene::world_from_cam(0.05)}));
  const InpaintedFrame result = inpaint({blind});
  EXPECT_EQ(cv::countNonZero(result.unknown), 0);
  EXPECT_LE(worst_colour(result.colour, PlaneScene::image(0).colour), 5);
  EXPECT_EQ(cv::countNonZero(result.depth(kMover)), 0);  // nobody measured it
}

TEST_F(InpainterTest, CorrectsThePoseOfAView) {
  // 1 cm off, 0.75 px on the wall.
  auto wrong = std::make_shared<BackgroundView>(*view(0, 0.1));
  wrong->at.world_from_cam = PlaneScene::world_from_cam(0.11);
  const InpaintedFrame result = inpaint({wrong});
  EXPECT_LE(worst_colour(result.colour, PlaneScene::image(0).colour), 8);
}

TEST_F(InpainterTest, AGreyViewIsNoUseToAColourFrame) {
  RgbdImage grey = PlaneScene::image(0.1);
  cv::extractChannel(grey.colour, grey.colour, 0);
  const auto earlier = std::make_shared<const BackgroundView>(
      inpainter_.view(grey, PlaneScene::mask({}), {0, 0, MapId{0}, PlaneScene::world_from_cam(0.1)}));
  EXPECT_GT(cv::countNonZero(inpaint({earlier}).unknown), 0);
}

TEST_F(InpainterTest, GivesTheSameBytesAgain) {
  const BackgroundStore::Views views{view(0, 0.1), view(5, 0.2, kMover), view(10, -0.1)};
  const InpaintedFrame a = inpaint(views), b = inpaint(views);
  EXPECT_EQ(worst_colour(a.colour, b.colour), 0);
  EXPECT_EQ(cv::norm(a.depth, b.depth, cv::NORM_INF), 0);
}

TEST_F(InpainterTest, WorksOnGreyImagesAndThroughALens) {
  Camera lens = PlaneScene::camera();
  lens.k1 = -0.1;
  const Inpainter inpainter(lens, settings());
  const auto image = [&](double x, cv::Rect mover) {
    RgbdImage out = PlaneScene::image(x, mover);
    out.colour.create(lens.height, lens.width, CV_8UC1);
    for (int v = 0; v < lens.height; ++v) {
      for (int u = 0; u < lens.width; ++u) {
        const Eigen::Vector3d p = lens.unproject(lens.undistort({u, v}), PlaneScene::kWall);
        out.colour.at<std::uint8_t>(v, u) =
            cv::saturate_cast<std::uint8_t>(PlaneScene::paint(p.x() + x, p.y(), 0));
      }
    }
    if (!mover.empty()) out.colour(mover) = 250;
    return out;
  };
  const auto view_at = [&](int frame, double x, cv::Rect mover) {
    return std::make_shared<const BackgroundView>(
        inpainter.view(image(x, mover), PlaneScene::mask(mover),
                       {frame, frame / 30.0, MapId{0}, PlaneScene::world_from_cam(x)}));
  };
  const InpaintedFrame result = inpainter.inpaint(image(0, kMover), *view_at(9, 0, kMover),
                                                  PlaneScene::mask(kMover), {view_at(0, 0.1, {})});
  EXPECT_EQ(cv::countNonZero(result.unknown), 0);
  EXPECT_LE(worst_colour(result.colour, image(0, {}).colour), 5);
}

}  // namespace
}  // namespace stdc
