#include "rendering/rendered_sequence.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace stdc {
namespace {

Camera small_camera() {
  Camera camera = default_render_camera();
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 134;
  camera.cx = 80;
  camera.cy = 60;
  return camera;
}

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST(RenderedSequence, SameSeedGivesSameBytes) {
  RenderSettings settings;
  settings.camera = small_camera();
  const RenderedSequence a(Preset::static_desk, settings), b(Preset::static_desk, settings);
  const RenderedFrame late = b.render(40);  // the order of rendering must not matter
  const RenderedFrame x = a.render(3), y = b.render(3), z = a.render(40);
  EXPECT_TRUE(same(x.image.colour, y.image.colour));
  EXPECT_TRUE(same(x.image.depth, y.image.depth));
  EXPECT_TRUE(same(z.image.colour, late.image.colour));
  settings.seed = 2;
  const RenderedSequence other(Preset::static_desk, settings);
  EXPECT_FALSE(same(x.image.colour, other.render(3).image.colour));
}

TEST(RenderedSequence, UnknownPresetIsAnError) {
  EXPECT_EQ(preset_named("static-room"), Preset::static_room);
  EXPECT_THROW(preset_named("static-rooms"), Error);
}

}  // namespace
}  // namespace stdc
