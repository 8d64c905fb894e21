// What must hold of every preset: the camera and the people have room, and masks and poses tell the truth.
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "simulation/light/ray_scene.hpp"
#include "simulation/people/person_motion.hpp"
#include "simulation/people/walk_planner.hpp"
#include "simulation/scene/room.hpp"
#include "simulation/sequence/camera_path.hpp"
#include "simulation/sequence/rendered_sequence.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr MotionKind kPresetMotions[] = {MotionKind::desk, MotionKind::room_loop,  MotionKind::watch,
                                         MotionKind::xyz,  MotionKind::halfsphere, MotionKind::rpy,
                                         MotionKind::held, MotionKind::follow};

class StillRoom : public testing::Test {
 protected:
  /// Distance to the nearest surface around a point, and whether any is seen from its back (the point is
  /// inside).
  std::pair<float, bool> clearance(const Vector3f& eye) const {
    float nearest = 100;
    bool inside = false;
    constexpr int kDirections = 60;
    for (int i = 0; i < kDirections; ++i) {
      const double z = 1 - (2 * i + 1.0) / kDirections, a = 2.39996 * i, r = std::sqrt(1 - z * z);
      const Vector3f direction = Vector3d(r * std::cos(a), r * std::sin(a), z).cast<float>();
      const Hit hit = scene_.trace(eye, direction, 0, 100);
      if (!hit.valid()) {
        inside = true;  // outside of the room is no better
        continue;
      }
      nearest = std::min(nearest, hit.distance);
      const auto& q = room_.world.mesh.quads[hit.quad];
      const auto& p = room_.world.mesh.positions;
      const bool back = (p[q[1]] - p[q[0]]).cross(p[q[3]] - p[q[0]]).dot(direction) > 0;
      inside |= back && hit.distance < 0.3F;
    }
    return {nearest, inside};
  }

  Room room_ = make_room(1, true);
  RayScene scene_{room_.world.mesh, TreeQuality::good};
};

TEST_F(StillRoom, TheCameraHasRoomAllAlongEveryPath) {
  for (const MotionKind kind : kPresetMotions) {
    const CameraPath motion(kind, 1);
    for (double t = 0; t < 40; t += 0.2) {
      const auto [nearest, inside] = clearance(motion.world_from_cam(t).translation.cast<float>());
      EXPECT_GT(nearest, 0.3) << static_cast<int>(kind) << " at " << t;
      EXPECT_FALSE(inside) << static_cast<int>(kind) << " at " << t;
    }
  }
}

TEST_F(StillRoom, PeopleHaveRoomAndKeepAwayFromTheCamera) {
  std::vector<Route> routes = plan_walks(60, 1);
  const Skeleton skeleton({});
  for (std::size_t who = 0; who < 2; ++who) {
    const PersonMotion person(skeleton, routes[who], 1);
    for (double t = 0; t < 55; t += 0.25) {
      const BodyPose pose = person.pose(t);
      for (const MotionKind kind :
           {MotionKind::xyz, MotionKind::halfsphere, MotionKind::rpy, MotionKind::held}) {
        const Vector3d eye = CameraPath(kind, 1).world_from_cam(t).translation;
        EXPECT_GT((pose[Bone::head].translation - eye).norm(), 0.45) << static_cast<int>(kind) << " at " << t;
      }
      if (person.route().speed(t) < 0.2) continue;  // sitting and standing are nearer to things
      for (const Bone bone : {Bone::pelvis, Bone::chest}) {
        const auto [nearest, inside] = clearance(pose[bone].translation.cast<float>());
        EXPECT_GT(nearest, 0.17) << t;
        EXPECT_FALSE(inside) << t;
      }
    }
  }
}

TEST(Presets, HaveTheMotionsOfTheirNames) {
  const std::pair<Preset, MotionKind> pairs[] = {
      {Preset::static_desk, MotionKind::desk},        {Preset::static_room, MotionKind::room_loop},
      {Preset::walking_xyz, MotionKind::xyz},         {Preset::walking_halfsphere, MotionKind::halfsphere},
      {Preset::walking_rpy, MotionKind::rpy},         {Preset::walking_static, MotionKind::held},
      {Preset::moving_box, MotionKind::watch},        {Preset::board, MotionKind::watch},
      {Preset::balloon_tracking, MotionKind::follow}, {Preset::camera_blocked, MotionKind::xyz},
  };
  RenderSettings settings;
  settings.with_people = false;
  for (const auto& [preset, kind] : pairs) {
    const RenderedSequence sequence(preset, settings);
    const Pose seen = sequence.world_from_cam(200),
               wanted = CameraPath(kind, settings.seed).world_from_cam(200 / 30.0);
    EXPECT_LT((seen.inverse() * wanted).log().norm(), 1e-6) << enum_name(preset);
  }
}

}  // namespace
}  // namespace stdc::simulation
