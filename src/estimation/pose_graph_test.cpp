#include "estimation/pose_graph.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "estimation/se3.hpp"
#include "estimation/test_pose_graph_scene.hpp"

namespace stdc {
namespace {

using test::camera_on_path;
using test::disturbed;
using test::information;
using test::Loop;
using test::make_loop;
using test::same;

TEST(PoseGraph, TrueEdgesGiveTheTrueLoop) {
  Loop loop = make_loop(60, 3, 0);
  EXPECT_GT(loop.max_error(), 0.05);
  const PoseGraphResult result = optimise_pose_graph(loop.graph);
  EXPECT_TRUE(result.usable);
  EXPECT_LT(result.final_cost, 1e-12 * result.initial_cost);
  EXPECT_LT(loop.max_error(), 1e-6);
  EXPECT_TRUE(same(loop.graph.node_from_world[0], loop.truth[0])) << "what is fixed stays";
}

TEST(PoseGraph, AHalfTurnOfErrorIsUndone) {
  Loop loop = make_loop(12, 2, 0);
  Vector6d twist;
  twist << 0.5, -0.3, 0.4, 0.3, 2.4, -0.8;
  for (std::size_t k = 6; k < 12; ++k)
    loop.graph.node_from_world[k] = Pose::exp(twist) * loop.graph.node_from_world[k];
  EXPECT_TRUE(optimise_pose_graph(loop.graph, {.iterations = 100}).usable);
  EXPECT_LT(loop.max_error(), 1e-6);
}

TEST(PoseGraph, ANoisyLoopIsCloserToTheTruthThanBefore) {
  Loop loop = make_loop(200, 5, 0.002);
  const double before = loop.max_error();
  const PoseGraphResult result = optimise_pose_graph(loop.graph);
  EXPECT_TRUE(result.usable);
  EXPECT_LT(loop.max_error(), before / 4);
}

TEST(PoseGraph, TheSolutionIsAMinimum) {
  Loop loop = make_loop(30, 3, 0.02);
  const PoseGraphResult result = optimise_pose_graph(loop.graph, {.min_relative_decrease = 0});
  Random random(4);
  for (int n = 0; n < 200; ++n) {
    PoseGraph moved = loop.graph;
    const std::size_t k = 1 + random.below(29);
    moved.node_from_world[k] = disturbed(moved.node_from_world[k], random, 1e-3, 1e-3);
    const PoseGraphResult there = optimise_pose_graph(moved, {.iterations = 1});
    EXPECT_GT(there.initial_cost, result.final_cost);
  }
}

TEST(PoseGraph, ARobustKernelTurnsAWrongLoopDown) {
  for (const bool robust : {false, true}) {
    Loop loop = make_loop(60, 3, 0.0005);
    loop.graph.edges.push_back(
        {10, 40, Pose(Eigen::Quaterniond::Identity(), {0, 0, 0.5}), information(0.01, 0.005), robust});
    EXPECT_TRUE(optimise_pose_graph(loop.graph).usable);
    if (robust) {
      EXPECT_LT(loop.max_error(), 0.1);
    } else {
      EXPECT_GT(loop.max_error(), 0.3);
    }
  }
}

TEST(PoseGraph, InformationDecidesWhoGivesWay) {
  PoseGraph graph;
  graph.node_from_world.resize(2);
  graph.fixed = {1, 0};
  Pose one, two;
  one.translation.x() = 1;
  two.translation.x() = 2;
  graph.edges = {{1, 0, one, information(0.1, 0.1)}, {1, 0, two, information(0.2, 0.1)}};
  ASSERT_TRUE(optimise_pose_graph(graph).usable);
  EXPECT_NEAR(graph.node_from_world[1].translation.x(), (1 * 4 + 2 * 1) / 5.0, 1e-9);
}

TEST(PoseGraph, DirectionOfAnEdgeDoesNotMatter) {
  Loop forth = make_loop(40, 3, 0.01), back = forth;
  for (PoseGraphEdge& edge : back.graph.edges) {
    std::swap(edge.a, edge.b);
    // The error is one of the other frame now, and of the inverse.
    const Matrix6d transport = adjoint(edge.a_from_b);
    edge.information = transport.transpose() * edge.information * transport;
    edge.a_from_b = edge.a_from_b.inverse();
  }
  const PoseGraphSettings settings{.min_relative_decrease = 0};
  const double cost = optimise_pose_graph(forth.graph, settings).final_cost;
  EXPECT_NEAR(optimise_pose_graph(back.graph, settings).final_cost, cost, 1e-6 * cost);
  for (std::size_t k = 0; k < 40; ++k) {
    EXPECT_LT((forth.graph.node_from_world[k].translation - back.graph.node_from_world[k].translation).norm(),
              1e-5);
  }
}

TEST(PoseGraph, WithoutAFixedNodeTheFirstStays) {
  Loop loop = make_loop(20, 2, 0);
  loop.graph.fixed.assign(20, 0);
  EXPECT_TRUE(optimise_pose_graph(loop.graph).usable);
  EXPECT_LT(loop.max_error(), 1e-6);
}

TEST(PoseGraph, WhatIsNotTiedStays) {
  Loop loop = make_loop(20, 2, 0);
  const Pose lonely = camera_on_path(100), island = camera_on_path(50);
  Pose step;
  step.translation.x() = 0.1;
  loop.graph.node_from_world.insert(loop.graph.node_from_world.end(), {lonely, island, step * island});
  loop.graph.fixed.insert(loop.graph.fixed.end(), {0, 0, 0});
  loop.graph.edges.push_back({22, 21, step, information(0.01, 0.01)});
  ASSERT_TRUE(optimise_pose_graph(loop.graph).usable);
  EXPECT_LT(loop.max_error(), 1e-6);
  EXPECT_LT((loop.graph.node_from_world[20].translation - lonely.translation).norm(), 1e-9);
  EXPECT_LT((loop.graph.node_from_world[21].translation - island.translation).norm(), 1e-9);
}

TEST(PoseGraph, WhatSaysNothingIsLeftOut) {
  Loop clean = make_loop(20, 2, 0.01), dirty = clean;
  Pose broken;
  broken.translation.y() = NAN;
  Matrix6d endless = Matrix6d::Identity();
  endless(2, 2) = INFINITY;
  dirty.graph.edges.push_back({3, 3, Pose(), Matrix6d::Identity()});
  dirty.graph.edges.push_back({3, 5, broken, Matrix6d::Identity()});
  dirty.graph.edges.push_back({3, 5, Pose(), endless});
  dirty.graph.edges.push_back({3, 15, Pose(), Matrix6d::Zero()});
  ASSERT_TRUE(optimise_pose_graph(clean.graph).usable);
  ASSERT_TRUE(optimise_pose_graph(dirty.graph).usable);
  for (std::size_t k = 0; k < 20; ++k) {
    EXPECT_LT(
        (clean.graph.node_from_world[k].translation - dirty.graph.node_from_world[k].translation).norm(),
        1e-9);
  }
}

TEST(PoseGraph, WithNothingToSolveItIsLeftAsItWas) {
  PoseGraph empty;
  EXPECT_FALSE(optimise_pose_graph(empty).usable);
  Loop fixed = make_loop(5, 2, 0.1);
  fixed.graph.fixed.assign(5, 1);
  EXPECT_FALSE(optimise_pose_graph(fixed.graph).usable);
  Loop bare = make_loop(5, 2, 0.1);
  bare.graph.edges.clear();
  EXPECT_FALSE(optimise_pose_graph(bare.graph).usable);
  Loop broken = make_loop(5, 2, 0.1);
  broken.graph.node_from_world[3].translation.x() = NAN;
  const PoseGraph before = broken.graph;
  EXPECT_FALSE(optimise_pose_graph(broken.graph).usable);
  EXPECT_TRUE(same(broken.graph.node_from_world[2], before.node_from_world[2]));
}

TEST(PoseGraph, SameInputSameBytes) {
  Loop a = make_loop(100, 4, 0.01), b = make_loop(100, 4, 0.01);
  optimise_pose_graph(a.graph);
  optimise_pose_graph(b.graph);
  for (std::size_t k = 0; k < 100; ++k)
    EXPECT_TRUE(same(a.graph.node_from_world[k], b.graph.node_from_world[k]));
}

}  // namespace
}  // namespace stdc
