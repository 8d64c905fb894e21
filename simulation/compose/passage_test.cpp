#include "simulation/compose/passage.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "simulation/compose/mover_paster.hpp"
#include "simulation/scene/motion_curves.hpp"
#include "simulation/sequence/camera_path.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc::simulation {
namespace {

class PassageTest : public testing::Test {
 protected:
  PassageTest() {
    camera_ = default_render_camera();
    camera_.width = 96;
    camera_.height = 72;
    camera_.fx = camera_.fy = 80;
    camera_.cx = 48;
    camera_.cy = 36;
  }
  /// A camera that sways, somewhere in a world with another heading than the room.
  static RecordedPath swaying(int frames) {
    RecordedPath path;
    for (int i = 0; i < frames; ++i) {
      const double t = i / 30.0;
      path.times.push_back(1000 + t);
      const Eigen::Vector3d eye(5 + 0.1 * wave(t, 3), 4, 1.5);
      path.world_from_cam.push_back(look_at(eye, eye + Eigen::Vector3d(1, 0.1 * wave(t, 4), -0.3)));
    }
    return path;
  }
  double share(const Passage& passage, int frame) const {
    const RgbdImage nothing{0, cv::Mat::zeros(72, 96, CV_8UC3), cv::Mat::zeros(72, 96, CV_16UC1)};
    const MoverPaster paster(camera_, shader_);
    return cv::countNonZero(
               paster.paste(nothing, passage.room_from_cam(frame), *passage.mover(frame), 1).mask) /
           (96.0 * 72);
  }
  Passage passage(const PassageSettings& settings, int frames = 300) const {
    return {settings, swaying(frames), camera_, room_, light_};
  }

  Camera camera_;
  Room room_ = make_room(1, false);
  RayScene rays_{room_.world.mesh, TreeQuality::good};
  BakedLight light_{room_.world, rays_};
  SurfaceShader shader_{room_.world, light_};
};

TEST_F(PassageTest, TheBoardCoversTheShareThatIsAskedFor) {
  for (const double wanted : {0.6, 0.8}) {
    const Passage p = passage({.mover = PastedMover::board, .share = wanted});
    double sum = 0;
    for (int i = 0; i < 14; ++i) sum += share(p, p.first() + 35 + 10 * i) / 14;
    EXPECT_NEAR(sum, wanted, 0.05);
    EXPECT_EQ(share(p, p.first()), 0);
    EXPECT_EQ(share(p, p.last() - 1), 0);
  }
}

TEST_F(PassageTest, BoxAndPersonComeInAndGo) {
  for (const PastedMover mover : {PastedMover::box, PastedMover::person}) {
    const Passage p = passage({.mover = mover, .distance = 1.2});
    EXPECT_EQ(share(p, p.first()), 0) << enum_name(mover);
    EXPECT_GT(share(p, (p.first() + p.last()) / 2), 0.08) << enum_name(mover);
    EXPECT_EQ(share(p, p.last() - 1), 0) << enum_name(mover);
  }
}

TEST_F(PassageTest, ARecordingMustBeLongEnough) {
  EXPECT_THROW(passage({.mover = PastedMover::board}, 100), Error);
  EXPECT_THROW(passage({.mover = PastedMover::box, .start = 200}), Error);
}

}  // namespace
}  // namespace stdc::simulation
