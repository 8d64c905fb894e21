#include "dense/inpainting/background_store.hpp"

#include <gtest/gtest.h>

#include "dense/inpainting/test_plane.hpp"

namespace stdc {
namespace {

using test::PlaneScene;

class BackgroundStoreTest : public testing::Test {
 protected:
  std::shared_ptr<const BackgroundView> view(int frame, double x, cv::Rect mover = {},
                                             MapId map = {0}) const {
    return std::make_shared<const BackgroundView>(
        make_view(PlaneScene::image(x, mover), PlaneScene::mask(mover), 4,
                  {frame, frame / 30.0, map, PlaneScene::world_from_cam(x)}, rays_));
  }

  RayTable rays_{PlaneScene::camera()};
  InpaintingSettings settings_;
};

TEST_F(BackgroundStoreTest, KeepsAViewNowAndThenAndWhenSomethingIsUncovered) {
  const cv::Rect mover(40, 20, 60, 60);
  BackgroundStore store(settings_);
  store.add(view(0, 0, mover));
  EXPECT_EQ(store.size(), 1U);
  store.add(view(1, 0, mover));
  EXPECT_EQ(store.size(), 1U);  // the same again
  store.add(view(2, 0, mover + cv::Point(30, 0)));
  EXPECT_EQ(store.size(), 2U);  // uncovers
  store.add(view(3, 0, mover + cv::Point(30, 0)));
  EXPECT_EQ(store.size(), 2U);
  store.add(view(2 + settings_.view_interval, 0, mover));
  EXPECT_EQ(store.size(), 3U);  // it is time
}

TEST_F(BackgroundStoreTest, IsBoundedAndDropsWhatOthersShow) {
  settings_.max_views = 3;
  BackgroundStore store(settings_);
  store.add(view(0, 5));  // nobody else is there
  for (int i = 1; i < 10; ++i) store.add(view(20 * i, 0.001 * i));
  EXPECT_EQ(store.size(), 3U);
  const cv::Mat region = PlaneScene::mask({60, 40, 30, 30});
  const auto there = store.choose({300, 10, MapId{0}, PlaneScene::world_from_cam(5)}, region, rays_);
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(there[0]->at.frame, 0);
}

TEST_F(BackgroundStoreTest, ChoosesViewsThatShowTheRegionInTheSameMap) {
  const cv::Rect mover(60, 40, 30, 30);
  BackgroundStore store(settings_);
  store.add(view(0, 0));
  store.add(view(20, 0, mover));         // hides it as well
  store.add(view(40, 0, {}, MapId{1}));  // elsewhere
  store.add(view(60, 3));                // looks past it
  const auto chosen =
      store.choose({80, 80 / 30.0, MapId{0}, PlaneScene::world_from_cam(0)}, PlaneScene::mask(mover), rays_);
  ASSERT_FALSE(chosen.empty());
  EXPECT_EQ(chosen[0]->at.frame, 0);
  for (const auto& one : chosen) {
    EXPECT_NE(one->at.frame, 40);
    EXPECT_NE(one->at.frame, 60);
  }
  EXPECT_TRUE(
      store.choose({0, 0, MapId{0}, PlaneScene::world_from_cam(0)}, PlaneScene::mask({}), rays_).empty());
}

}  // namespace
}  // namespace stdc
