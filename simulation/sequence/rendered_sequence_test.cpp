#include "simulation/sequence/rendered_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "simulation/test_small_camera.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

RenderSettings small_settings() {
  RenderSettings settings;
  settings.camera = small_camera();
  return settings;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

bool same(const RenderedFrame& a, const RenderedFrame& b) {
  return same(a.image.colour, b.image.colour) && same(a.image.depth, b.image.depth) && same(a.mask, b.mask);
}

/// Of the points that frame a measures and that lie in frame b: the share that b measures at the same depth.
double agreement(const Camera& camera, const RenderedFrame& a, const RenderedFrame& b) {
  const Pose b_from_a = b.world_from_cam.inverse() * a.world_from_cam;
  int seen = 0, agreed = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const int raw = a.image.depth.at<std::uint16_t>(y, x);
      if (raw == 0) continue;
      const Vector3d p = b_from_a * camera.unproject(camera.undistort(Vector2d(x, y)), raw / 5000.0);
      if (p.z() < 0.5) continue;
      const Vector2d pixel = camera.distort(camera.project(p));
      const cv::Point at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
      if (!cv::Rect(2, 2, camera.width - 4, camera.height - 4).contains(at)) continue;
      const double there = b.image.depth.at<std::uint16_t>(at) / 5000.0;
      if (there == 0) continue;
      ++seen;
      if (std::abs(there - p.z()) < 0.03 * p.z()) ++agreed;
    }
  }
  EXPECT_GT(seen, camera.width * camera.height / 4);
  return static_cast<double>(agreed) / seen;
}

TEST(RenderedSequence, SameSeedGivesSameBytesOnAnyNumberOfThreads) {
  const RenderedSequence alone(Preset::walking_xyz, small_settings()),
      shared(Preset::walking_xyz, small_settings());
  constexpr int kFrames = 5;
  std::vector<RenderedFrame> frames(kFrames);
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t) {
    threads.emplace_back([&, t] {
      for (int i = kFrames - 1 - t; i >= 0; i -= 3) frames[i] = shared.render(20 * i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kFrames; ++i) EXPECT_TRUE(same(alone.render(20 * i), frames[i])) << i;
}

TEST(RenderedSequence, AnotherSeedGivesAnotherRoom) {
  RenderSettings settings = small_settings();
  const RenderedFrame a = RenderedSequence(Preset::static_desk, settings).render(3);
  settings.seed = 2;
  const RenderedFrame b = RenderedSequence(Preset::static_desk, settings).render(3);
  EXPECT_GT(cv::norm(a.image.colour, b.image.colour, cv::NORM_L1) / a.image.colour.total(), 10);
}

TEST(RenderedSequence, DepthPoseAndCameraBelongTogether) {
  RenderSettings settings = small_settings();
  for (const double k1 : {0.0, 0.2}) {
    settings.camera->k1 = k1;
    settings.camera->p2 = k1 / 100;
    const RenderedSequence sequence(Preset::static_room, settings);
    EXPECT_GT(agreement(sequence.camera(), sequence.render(300), sequence.render(306)), 0.9) << k1;
    EXPECT_GT(agreement(sequence.camera(), sequence.render(700), sequence.render(694)), 0.9) << k1;
  }
}

TEST(RenderedSequence, PeopleAreInTheMaskAndOnlyThey) {
  RenderSettings settings = small_settings();
  const RenderedSequence with(Preset::walking_static, settings);
  settings.with_people = false;
  const RenderedSequence without(Preset::walking_static, settings);
  double covered = 0;
  for (int i = 0; i < 240; i += 60) {
    const RenderedFrame a = with.render(i), b = without.render(i);
    EXPECT_EQ(cv::countNonZero(b.mask), 0);
    EXPECT_TRUE(a.world_from_cam.translation == b.world_from_cam.translation);
    EXPECT_TRUE(a.world_from_cam.rotation.coeffs() == b.world_from_cam.rotation.coeffs());
    covered = std::max(covered, static_cast<double>(cv::countNonZero(a.mask)) / a.mask.total());
    // Away from the people (and the shadow of the depth sensor's projector beside them) the depth is the
    // same.
    cv::Mat near, differs = (a.image.depth != b.image.depth) & (a.image.depth > 0);
    cv::dilate(a.mask, near, cv::Mat::ones(5, 13, CV_8U));
    EXPECT_EQ(cv::countNonZero(differs & ~near), 0) << i;
    // Inside, nearly everything is nearer than the room behind.
    cv::Mat inner, nearer = (a.image.depth < b.image.depth) | (b.image.depth == 0) | (a.image.depth == 0);
    cv::erode(a.mask, inner, cv::Mat::ones(3, 3, CV_8U));
    EXPECT_GT(cv::countNonZero(nearer & inner), 0.99 * cv::countNonZero(inner)) << i;
  }
  EXPECT_GT(covered, 0.15);
}

TEST(RenderedSequence, TheBoxIsDynamicOnlyWhileItMoves) {
  // Between being set down (6.3 s) and picked up the box rests; the person has gone to the chair.
  const RenderedSequence sequence(Preset::moving_box, small_settings());
  const int none = cv::countNonZero(sequence.render(330).mask);
  EXPECT_EQ(none, 0);
  EXPECT_GT(cv::countNonZero(sequence.render(100).mask), 100);
}

TEST(RenderedSequence, MotionBlurSmearsColourAndKeepsDepth) {
  RenderSettings settings = small_settings();
  const RenderedFrame sharp = RenderedSequence(Preset::static_room, settings).render(200);
  settings.motion_blur = true;
  const RenderedFrame blurred = RenderedSequence(Preset::static_room, settings).render(200);
  EXPECT_TRUE(same(sharp.image.depth, blurred.image.depth));
  const auto sharpness = [](const cv::Mat& image) {
    cv::Mat edges;
    cv::Laplacian(image, edges, CV_32F);
    return cv::norm(edges, cv::NORM_L1);
  };
  EXPECT_LT(sharpness(blurred.image.colour), 0.95 * sharpness(sharp.image.colour));
  EXPECT_NEAR(cv::mean(blurred.image.colour)[1], cv::mean(sharp.image.colour)[1], 2);
}

TEST(RenderedSequence, HasPlainFactsWithoutRendering) {
  EXPECT_EQ(preset_named("static-room"), Preset::static_room);
  EXPECT_THROW(preset_named("static-rooms"), Error);
  EXPECT_EQ(RenderedSequence::frame_count(Preset::static_room, Camera()), 1080);
  RenderSettings settings;
  settings.camera = Camera();
  settings.camera->fx = -1;
  EXPECT_THROW(RenderedSequence(Preset::static_desk, settings), Error);
}

/// Rows of an image whose rows are read one after the other are those of images taken when they were read.
TEST(RenderedSequence, ARollingShutterSeesEachRowAtItsTime) {
  RenderSettings settings = small_settings();
  settings.with_people = false;
  settings.camera->frames_per_second = 1000;
  const RenderedSequence instants(Preset::walking_rpy, settings);
  settings.camera->readout_time = 0.04;
  const RenderedSequence rolling(Preset::walking_rpy, settings);
  constexpr int kMoment = 900;  // [ms], in quick motion
  const cv::Mat image = rolling.render(kMoment).image.colour;
  const int last = image.rows - 1;
  for (const int row : {2, last / 2, last - 2}) {
    const int when = kMoment + static_cast<int>(std::lround(40 * (static_cast<double>(row) / last - 0.5)));
    const auto difference = [&](int moment) {
      return cv::norm(image.rowRange(row - 1, row + 2),
                      instants.render(moment).image.colour.rowRange(row - 1, row + 2), cv::NORM_L1);
    };
    EXPECT_LT(difference(when), 0.6 * difference(when - 20)) << row;
    EXPECT_LT(difference(when), 0.6 * difference(when + 20)) << row;
  }
}

}  // namespace
}  // namespace stdc::simulation
