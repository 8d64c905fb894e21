// The presets with movers: nothing runs into the camera or the furniture, and both masks tell the truth.
#include "simulation/sequence/movers.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "simulation/light/ray_scene.hpp"
#include "simulation/sequence/make_dynamic_scene.hpp"
#include "simulation/sequence/rendered_sequence.hpp"
#include "simulation/test_small_camera.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

RenderSettings movers_settings(bool with_movers = true) {
  RenderSettings settings;
  settings.camera = small_camera();
  settings.with_people = with_movers;
  return settings;
}

double share(const cv::Mat& mask) { return static_cast<double>(cv::countNonZero(mask)) / mask.total(); }

bool same_images(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

/// The scenes of all presets with movers, without rendering.
class Movers : public testing::Test {
 protected:
  std::vector<Preset> presets() const {
    std::vector<Preset> result;
    for (const auto& [preset, name] : EnumNames<Preset>::values) {
      if (preset > Preset::moving_box) result.push_back(preset);
    }
    return result;
  }
  DynamicScene scene(Preset preset) const { return *make_dynamic_scene(preset, 1, true, room_, light_); }

  /// Whether something of the room lies between the middle of a prop and one of its vertices (which may touch
  /// the floor).
  bool touches_the_room(const Prop& prop, double time) const {
    const Pose pose = prop.world_from_prop(time);
    Vector3f middle = Vector3f::Zero();
    for (const Vector3f& p : prop.mesh().positions)
      middle += p / static_cast<float>(prop.mesh().positions.size());
    const Vector3f from = (pose * middle.cast<double>()).cast<float>();
    return std::any_of(prop.mesh().positions.begin(), prop.mesh().positions.end(), [&](const Vector3f& p) {
      return rays_.occluded(from, (pose * p.cast<double>()).cast<float>() - from, 0.98F);
    });
  }

  static double distance(const Prop& prop, double time, const Vector3d& eye) {
    const Vector3f local = (prop.world_from_prop(time).inverse() * eye).cast<float>();
    float nearest = 100;
    for (const Vector3f& p : prop.mesh().positions) nearest = std::min(nearest, (p - local).norm());
    return nearest;
  }

  Room room_ = make_room(1, false);
  RayScene rays_{room_.world.mesh, TreeQuality::good};
  BakedLight light_{room_.world, rays_};
};

TEST_F(Movers, ThingsKeepClearOfTheCameraAndTheRoom) {
  for (const Preset preset : presets()) {
    const DynamicScene all = scene(preset);
    const CameraPath camera(motion_of(preset), 1);
    for (double t = 0; t < seconds_of(preset); t += 0.2) {
      for (const Prop& prop : all.props()) {
        const double least = preset == Preset::camera_blocked ? 0.15 : 0.5;
        EXPECT_GT(distance(prop, t, camera.world_from_cam(t).translation), least)
            << enum_name(preset) << " at " << t;
        EXPECT_FALSE(touches_the_room(prop, t)) << enum_name(preset) << " at " << t;
      }
    }
  }
}

TEST_F(Movers, PeopleKeepClearOfTheCameraAndTheRoom) {
  for (const Preset preset : presets()) {
    const DynamicScene all = scene(preset);
    const CameraPath camera(motion_of(preset), 1);
    for (const Person& person : all.people()) {
      for (double t = 0; t < seconds_of(preset); t += 0.2) {
        const BodyPose pose = person.motion.pose(t);
        const Vector3f chest = pose[Bone::chest].translation.cast<float>();
        EXPECT_GT((pose[Bone::head].translation - camera.world_from_cam(t).translation).norm(), 0.45)
            << enum_name(preset) << " at " << t;
        for (int i = 0; i < 12; ++i) {
          const double a = i * 0.5236;
          const Vector3f out(static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), 0);
          EXPECT_FALSE(rays_.occluded(chest, out, 0.17F)) << enum_name(preset) << " at " << t;
        }
      }
    }
  }
}

TEST(MoverMasks, TheBoardCoversMostOfTheViewFromNear) {
  const RenderedSequence sequence(Preset::board, movers_settings());
  int covered = 0;
  for (int i = 300; i < 480; i += 6) {
    const RenderedFrame frame = sequence.render(i);
    const double now = share(frame.mask);
    EXPECT_LT(now, 0.82) << i;
    if (now < 0.58) continue;
    ++covered;
    cv::Mat inner;  // at outlines the sensor mixes up near and far
    cv::erode(frame.mask, inner, cv::Mat::ones(3, 5, CV_8U));
    for (int y = 0; y < frame.mask.rows; ++y) {
      for (int x = 0; x < frame.mask.cols; ++x) {
        const int raw = frame.image.depth.at<std::uint16_t>(y, x);
        if (inner.at<std::uint8_t>(y, x) == 0 || raw == 0) continue;
        ASSERT_TRUE(raw > 0.8 * 5000 && raw < 1.6 * 5000) << raw / 5000.0;
      }
    }
  }
  EXPECT_GE(covered, 140 / 6);
  EXPECT_EQ(cv::countNonZero(sequence.render(0).moved), 0);
}

TEST(MoverMasks, MovedShowsTheBoxWhileItRests) {
  const RenderedSequence sequence(Preset::box_removed, movers_settings());
  const RenderedFrame before = sequence.render(30), during = sequence.render(270),
                      after = sequence.render(590);
  EXPECT_EQ(cv::countNonZero(before.mask), 0);
  EXPECT_GT(share(before.moved), 0.01);
  EXPECT_GT(share(during.mask), 0.05);
  EXPECT_EQ(cv::countNonZero(during.mask & ~during.moved), 0);
  EXPECT_EQ(cv::countNonZero(after.moved), 0);
}

TEST(MoverMasks, TheCleanRoomHasNoMovers) {
  const RenderedSequence with(Preset::box_removed, movers_settings()),
      without(Preset::box_removed, movers_settings(false));
  const RenderedFrame clean = without.render(30), boxed = with.render(30);
  EXPECT_EQ(cv::countNonZero(clean.mask), 0);
  EXPECT_TRUE(clean.moved.empty());
  EXPECT_FALSE(
      same_images(clean.image.depth, boxed.image.depth));  // the box stands there, but not in the clean room
  // After the errand both rooms are the same.
  const RenderedFrame left = with.render(590), empty = without.render(590);
  EXPECT_TRUE(same_images(left.image.depth, empty.image.depth));
}

}  // namespace
}  // namespace stdc::simulation
