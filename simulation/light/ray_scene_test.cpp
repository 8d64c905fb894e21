#include "simulation/light/ray_scene.hpp"

#include <gtest/gtest.h>

#include "simulation/scene/shapes.hpp"

namespace stdc::simulation {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

class RaySceneTest : public testing::Test {
 protected:
  Mesh mesh_;
  std::vector<Material> materials_{Material()};
  ShapeBuilder builder_{mesh_, materials_, 1};
};

TEST_F(RaySceneTest, DistanceToAPlaneIsExact) {
  builder_.rectangle({-20, 3, -20}, {40, 0, 0}, {0, 1, 40}, {});  // a wall that leans back
  const RayScene scene(mesh_, TreeQuality::good);
  const Vector3d normal = Vector3d(40, 0, 0).cross(Vector3d(0, 1, 40)).normalized();
  const Vector3f origin(0.3F, -1, 0.5F);
  for (int i = 0; i < 200; ++i) {
    const Vector3f direction(-1 + 0.01F * static_cast<float>(i), 1, 0.5F - 0.005F * static_cast<float>(i));
    const Hit hit = scene.trace(origin, direction, 0, 1000);
    ASSERT_TRUE(hit.valid());
    const Vector3d from = Vector3d(-20, 3, -20) - origin.cast<double>();
    const double expected = normal.dot(from) / normal.dot(direction.cast<double>());
    EXPECT_NEAR(hit.distance, expected, 1e-6 * expected);
    const Vector3d at = origin.cast<double>() + expected * direction.cast<double>();
    EXPECT_NEAR(hit.u, (at.x() + 20) / 40, 1e-6);
    EXPECT_NEAR(hit.v, (at.z() + 20) / 40, 1e-6);
  }
}

TEST_F(RaySceneTest, PacketsAgreeWithSingleRays) {
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    builder_.world_from_local =
        placed(random.uniform(-2, 2), random.uniform(2, 6), random.uniform(-2, 2), random.uniform(0, 6));
    builder_.box({0, 0, 0}, {0.5, 0.3, 0.4}, Finish{});
  }
  const RayScene scene(mesh_, TreeQuality::fast);
  const Vector3f origin(0, -1, 0);
  int hits_seen = 0;
  for (int packet = 0; packet < 100; ++packet) {
    std::array<Vector3f, RayScene::kPacket> directions;
    std::array<Hit, RayScene::kPacket> hits;
    for (Vector3f& d : directions)
      d = Vector3d(random.uniform(-0.6, 0.6), 1, random.uniform(-0.6, 0.6)).cast<float>();
    const int count = 1 + packet % RayScene::kPacket;
    const bool any = scene.trace(origin, directions.data(), count, hits.data());
    int valid = 0;
    for (int i = 0; i < count; ++i) {
      const Hit single = scene.trace(origin, directions[i], 0, 1000);
      EXPECT_EQ(hits[i].valid(), single.valid());
      EXPECT_EQ(scene.occluded(origin, directions[i], 1000), single.valid());
      if (!single.valid()) continue;
      ++valid;
      EXPECT_FLOAT_EQ(hits[i].distance, single.distance);
      EXPECT_FALSE(scene.occluded(origin, directions[i], 0.999F * single.distance));
    }
    EXPECT_EQ(any, valid > 0);
    hits_seen += valid;
  }
  EXPECT_GT(hits_seen, 50);
}

TEST_F(RaySceneTest, AKnownNearerHitIsKept) {
  builder_.rectangle({-1, 3, -1}, {2, 0, 0}, {0, 0, 2}, {});
  const RayScene scene(mesh_, TreeQuality::good);
  const Vector3f direction(0, 1, 0);
  Hit hit;
  hit.distance = 2;
  hit.quad = 77;
  EXPECT_FALSE(scene.trace(Vector3f::Zero(), &direction, 1, &hit));
  EXPECT_EQ(hit.quad, 77U);
  hit.distance = 4;
  EXPECT_TRUE(scene.trace(Vector3f::Zero(), &direction, 1, &hit));
  EXPECT_FLOAT_EQ(hit.distance, 3);
}

TEST_F(RaySceneTest, ShapesFaceOutward) {
  builder_.box({0, 0, 0}, {1, 1, 1}, Finish{});
  builder_.cylinder({30, 0, 0}, 0.5, 1, {}, {});
  builder_.ellipsoid({60, 0, 0.5}, {0.5, 0.5, 0.5}, {});
  builder_.rod({{90, 0, 0}, {90, 0, 0.5}, {90.1, 0, 1}}, 0.3, {});
  const RayScene scene(mesh_, TreeQuality::good);
  for (const float x : {0.0F, 30.0F, 60.0F, 90.0F}) {
    for (int i = 0; i < 12; ++i) {
      const float a = 0.52F * static_cast<float>(i) + 0.1F;
      const Vector3f out(std::cos(a), std::sin(a), 0), origin = Vector3f(x, 0, 0.45F) + 3 * out;
      const Hit hit = scene.trace(origin, -out, 0, 10);
      ASSERT_TRUE(hit.valid());
      EXPECT_GT(mesh_.normals[mesh_.quads[hit.quad][0]].dot(out), 0) << x << " " << i;
    }
  }
}

}  // namespace
}  // namespace stdc::simulation
