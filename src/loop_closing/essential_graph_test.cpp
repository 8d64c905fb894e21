#include "loop_closing/essential_graph.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "atlas/test_scene.hpp"
#include "core/random.hpp"

namespace stdc {
namespace {

using test::angle_error;
using test::centre_error;

/// A ring of cameras around a point, each of which sees a few points together with the next.
struct Ring {
  static constexpr int kKeyframes = 24;
  static constexpr int kShared = 20;
  Atlas atlas;
  std::vector<Pose> truth;
  std::shared_ptr<const FrameFeatures> features;

  static Pose place(int k) {
    const double angle = 2 * std::numbers::pi * k / kKeyframes;
    return test::camera_at(2 * std::sin(angle), 0, 2 * std::cos(angle), 0, angle);
  }

  /// @param sigma  of the error of each step [m, and a quarter of it in rad]
  explicit Ring(double sigma, std::uint64_t seed = 5) {
    Random random(seed);
    StoredFeatures stored;
    stored.keypoints.resize(2 * kShared);
    stored.pixels.resize(2 * kShared, Eigen::Vector2f::Zero());
    stored.depths.resize(2 * kShared, 1.0F);
    stored.descriptors.resize(2 * kShared);
    stored.levels = 1;
    features = std::make_shared<FrameFeatures>(Camera(), std::move(stored));
    Pose drifted = place(0);
    for (int k = 0; k < kKeyframes; ++k) {
      truth.push_back(place(k));
      Vector6d error;
      for (int i = 0; i < 6; ++i) error[i] = (i < 3 ? sigma : sigma / 4) * random.normal();
      if (k > 0) drifted = Pose::exp(error) * place(k) * place(k - 1).inverse() * drifted;
      add(k, drifted);
    }
  }

  void add(int k, const Pose& pose) {
    NewKeyframe made_of{k, 0.1 * k, pose, {}, features, std::vector<Measurement>(2 * kShared)};
    const KeyframeId id = atlas.add_keyframe(made_of);
    for (int i = 0; k > 0 && i < kShared; ++i)
      atlas.observe(id, i, atlas.keyframe({id.value - 1}).landmarks[kShared + i]);
    for (int i = 0; i < kShared; ++i)
      atlas.observe(id, kShared + i, atlas.add_landmark(Eigen::Vector3d::Random(), id));
    atlas.update_covisibility(id);
  }

  /// The last keyframe sees the first one's points.
  void fuse_ends() {
    const KeyframeId last{kKeyframes - 1};
    for (int i = 0; i < kShared; ++i) atlas.observe({0}, i, atlas.keyframe(last).landmarks[kShared + i]);
    atlas.update_covisibility(last);
  }

  double worst_error() const {
    double worst = 0;
    for (std::uint32_t k = 0; k < kKeyframes; ++k)
      worst = std::max(worst, centre_error(atlas.keyframe({k}).cam_from_world, truth[k]));
    return worst;
  }
};

constexpr double kDrift = 0.015;

TEST(EssentialGraph, SpreadsTheErrorOfARoundOverIt) {
  constexpr KeyframeId kLast{Ring::kKeyframes - 1};
  double before = 0, after = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Ring ring(kDrift, seed);
    before += ring.worst_error();
    ring.fuse_ends();
    const LoopEnds ends{keyframe_poses(ring.atlas), {{kLast, KeyframeId{0}}}, {}};
    ring.atlas.set_pose(kLast, ring.truth.back());  // what the loop says
    EXPECT_TRUE(optimise_essential_graph(ring.atlas, {0}, ends, {}, {}).usable);
    after += ring.worst_error();
    EXPECT_LT(centre_error(ring.atlas.keyframe(kLast).cam_from_world, ring.truth.back()), 0.02);
    EXPECT_EQ(ring.atlas.keyframe({0}).cam_from_world.translation, ring.truth[0].translation)
        << "the world stays";
  }
  EXPECT_LT(after, 0.6 * before);
}

TEST(EssentialGraph, WithoutNewsNothingMoves) {
  Ring ring(kDrift);
  const KeyframePoses before = keyframe_poses(ring.atlas);
  optimise_essential_graph(ring.atlas, {0}, {before, {}, {}}, {}, {});
  for (std::uint32_t k = 0; k < Ring::kKeyframes; ++k) {
    EXPECT_LT(centre_error(ring.atlas.keyframe({k}).cam_from_world, before[k]), 1e-9);
    EXPECT_LT(angle_error(ring.atlas.keyframe({k}).cam_from_world, before[k]), 1e-7);
  }
}

TEST(EssentialGraph, FixedKeyframesStayAndTheRestFollows) {
  Ring ring(0);
  const KeyframePoses before = keyframe_poses(ring.atlas);
  const Pose moved = before[12] * Pose(Eigen::Quaterniond::Identity(), {0.1, 0, 0});
  ring.atlas.set_pose({12}, moved);
  optimise_essential_graph(ring.atlas, {0}, {before, {}, {KeyframeId{12}}}, {}, {});
  EXPECT_EQ(ring.atlas.keyframe({12}).cam_from_world.translation, moved.translation);
  const double half = centre_error(ring.atlas.keyframe({6}).cam_from_world, before[6]);
  EXPECT_GT(half, 0.01);
  EXPECT_LT(half, 0.1);
}

TEST(EssentialGraph, AnEarlierLoopStillHolds) {
  Ring ring(kDrift);
  constexpr KeyframeId kLast{Ring::kKeyframes - 1};
  ring.fuse_ends();
  LoopEnds ends{keyframe_poses(ring.atlas), {{kLast, KeyframeId{0}}}, {}};
  ring.atlas.set_pose(kLast, ring.truth.back());
  optimise_essential_graph(ring.atlas, {0}, ends, {}, {});
  ring.atlas.add_loop_edge(kLast, {0});
  const double closed = ring.worst_error();
  // A push in the middle, as by a bad link, does not open the ring again.
  const KeyframePoses before = keyframe_poses(ring.atlas);
  Vector6d push = Vector6d::Zero();
  push[0] = 0.05;
  ring.atlas.set_pose({10}, Pose::exp(push) * before[10]);
  optimise_essential_graph(ring.atlas, {0}, {before, {}, {}}, {}, {});
  EXPECT_LT(ring.worst_error(), closed + 1e-3);
}

}  // namespace
}  // namespace stdc
