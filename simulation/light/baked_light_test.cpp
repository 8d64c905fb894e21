#include "simulation/light/baked_light.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "simulation/light/test_plain_world.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3f;

constexpr float kSide = 0.1F, kHeight = 2;

/// A floor below a small lamp.
World lit_floor() {
  World world = test::plain_world();
  ShapeBuilder(world.mesh, world.materials, 1).rectangle({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {});
  const Vector3f corner(-kSide / 2, kSide / 2, kHeight);
  world.lights.push_back({corner, {kSide, 0, 0}, {0, -kSide, 0}, Rgb(10, 20, 30)});
  return world;
}

TEST(BakedLight, ASmallLampGivesLightByTheInverseSquareLaw) {
  const World world = lit_floor();
  const RayScene scene(world.mesh, TreeQuality::good);
  const BakedLight light(world, scene);
  const float below = kSide * kSide / (std::numbers::pi_v<float> * kHeight * kHeight);
  const Rgb middle = light.at(0, 0.5F, 0.5F);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(middle[c], below * world.lights[0].radiance[c], 0.002) << c;
  // Aside by d: cos^4 of the angle.
  const Rgb aside = light.at(0, 0.75F, 0.5F);
  const float cosine_square = kHeight * kHeight / (kHeight * kHeight + 1);
  EXPECT_NEAR(aside.z(), 30 * below * cosine_square * cosine_square, 0.002);
  EXPECT_EQ(light.gather({0, 0, 1}, {0, 0, -1}, 1).x(),
            light.gather({0, 0, 1}, {0, 0, -1}, 2).x());  // no lamp in sight
}

TEST(BakedLight, AThingInBetweenCastsAShadow) {
  World world = lit_floor();
  ShapeBuilder(world.mesh, world.materials, 1).box({0, 0, 1}, {0.4, 0.4, 0.1}, Finish{});
  const RayScene scene(world.mesh, TreeQuality::good);
  const BakedLight light(world, scene);
  EXPECT_LT(light.at(0, 0.5F, 0.5F).z(), 0.5F * light.at(0, 0.8F, 0.5F).z());
}

TEST(BakedLight, IsTheSameInWhateverOrderThreadsAsk) {
  const World world = lit_floor();
  const RayScene scene(world.mesh, TreeQuality::good);
  const BakedLight alone(world, scene), shared(world, scene);
  constexpr int kCount = 400;
  const auto at = [](int i) { return static_cast<float>(i * 37 % kCount) / kCount; };
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < kCount; ++i) shared.at(0, at(i + 91 * t), at(7 * i + t));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (int i = 0; i < kCount; ++i) EXPECT_EQ(alone.at(0, at(i), at(7 * i)), shared.at(0, at(i), at(7 * i)));
}

}  // namespace
}  // namespace stdc::simulation
