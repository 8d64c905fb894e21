// A later visit to a room in which a third of the furniture has moved: the map still tells where the camera
// is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <thread>

#include "core/files/test_folder.hpp"
#include "simulation/scene/shapes.hpp"
#include "simulation/sequence/rendered_sequence.hpp"
#include "slam/slam.hpp"

namespace stdc {
namespace {

using simulation::placed;
using test::TestFolder;

/// What stands in a part of the room goes elsewhere as one.
struct MovedPiece {
  Eigen::AlignedBox3f region;
  Pose shift;
};

/// Turns and shifts what stands around a place.
Pose shift_about(double x, double y, double dx, double dy, double yaw) {
  return placed(x + dx, y + dy, 0, yaw) * placed(x, y, 0).inverse();
}

const std::array kPieces{
    // The desk on the right with all that is on it: half of what is near the camera.
    MovedPiece{{Eigen::Vector3f(0, 0.15F, 0.01F), Eigen::Vector3f(1.45F, 1, 1.6F)},
               shift_about(0.7, 0.6, 0.3, -0.2, 0.12)},
    // The two chairs before the desks.
    MovedPiece{{Eigen::Vector3f(-0.85F, -0.5F, 0.01F), Eigen::Vector3f(-0.05F, 0.35F, 1.2F)},
               shift_about(-0.45, -0.05, -0.4, -0.4, 0.9)},
    MovedPiece{{Eigen::Vector3f(0.85F, -0.65F, 0.01F), Eigen::Vector3f(1.65F, 0.14F, 1.2F)},
               shift_about(1.25, -0.25, -0.6, -0.45, -0.7)},
    // A shelf full of books, and what lies on the desk on the left.
    MovedPiece{{Eigen::Vector3f(-3.3F, 2.8F, 0.01F), Eigen::Vector3f(-2.1F, 3.25F, 2.1F)},
               shift_about(-2.7, 3, 0.25, -0.3, 0)},
    MovedPiece{{Eigen::Vector3f(-1.45F, 0.15F, 0.735F), Eigen::Vector3f(-0.05F, 0.95F, 0.9F)},
               shift_about(-0.7, 0.6, 0.05, 0.06, 0.1)}};

/// The room of one visit, seen by a camera that moves on a half sphere before the desks.
struct Visit {
  Camera camera = half_sized();
  std::vector<simulation::RenderedFrame> frames;

  /// `first`: of the frames that the preset has; every third is taken.
  explicit Visit(bool moved, int first, int count) : frames(static_cast<std::size_t>(count)) {
    simulation::RenderSettings settings;
    settings.camera = camera;
    settings.with_people = false;
    if (moved) {
      settings.refurnish = [](simulation::World& world) {
        for (const MovedPiece& piece : kPieces)
          EXPECT_GT(world.mesh.move_within(piece.region, piece.shift), 10) << "nothing stands there";
      };
    }
    const simulation::RenderedSequence rendered(simulation::Preset::walking_halfsphere, settings);
    std::vector<std::thread> threads;
    for (int start = 0; start < 2; ++start) {
      threads.emplace_back([&, start] {
        for (int i = start; i < count; i += 2)
          frames[static_cast<std::size_t>(i)] = rendered.render(first + 3 * i);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }

  static Camera half_sized() {
    Camera camera = simulation::default_render_camera();
    camera.width = 320;
    camera.height = 240;
    for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value *= 0.5;
    return camera;
  }
};

/// The first visit, of which the map is, and the second one, which begins elsewhere.
class MovedFurniture : public testing::Test {
 protected:
  static const Visit& before() {
    static const Visit visit(false, 0, 100);
    return visit;
  }
  static const Visit& after() {
    static const Visit visit(true, 151, 100);
    return visit;
  }

  static Settings settings() {
    Settings settings;
    settings.segmentation.source = SegmentationSource::off;
    return settings;
  }

  void save_first_visit() const {
    Slam slam(before().camera, settings());
    for (const auto& frame : before().frames) ASSERT_EQ(slam.track(frame.image).status, TrackingStatus::ok);
    slam.finish();
    const Pose world_from_map = before().frames[0].world_from_cam;
    int moved = 0;
    for (const Eigen::Vector3d& position : slam.landmark_positions()) {
      const Eigen::Vector3f point = (world_from_map * position).cast<float>();
      moved += std::any_of(kPieces.begin(), kPieces.end(),
                           [&](const MovedPiece& piece) { return piece.region.contains(point); })
                   ? 1
                   : 0;
    }
    EXPECT_GT(3 * moved, slam.landmarks()) << "a third of what the map knows will have moved";
    slam.save_map(path());
  }

  struct Second {
    int ok = 0, uncertain = 0, lost = 0, first_ok = -1;
    int wrong = 0;     ///< frames called ok that are more than 5 cm off
    double worst = 0;  ///< of those called ok [m]
  };
  Second visit_again(Slam& slam) const {
    slam.load_map(path());
    const Pose map_from_world = before().frames[0].world_from_cam.inverse();
    Second second;
    for (std::size_t i = 0; i < after().frames.size(); ++i) {
      const TrackingResult result = slam.track(after().frames[i].image);
      second.uncertain += result.status == TrackingStatus::uncertain ? 1 : 0;
      second.lost += result.status == TrackingStatus::lost ? 1 : 0;
      if (result.status != TrackingStatus::ok) continue;
      EXPECT_EQ(result.map, MapId{0}) << i;
      if (second.first_ok < 0) second.first_ok = static_cast<int>(i);
      ++second.ok;
      const Pose expected = map_from_world * after().frames[i].world_from_cam;
      const double error = (expected.translation - result.cam_from_world->inverse().translation).norm();
      second.wrong += error > 0.05 ? 1 : 0;
      second.worst = std::max(second.worst, error);
    }
    return second;
  }

  std::filesystem::path path() const { return folder_ / "room.map"; }

 private:
  TestFolder folder_;
};

TEST_F(MovedFurniture, ACameraFindsItselfInTheSavedMap) {
  save_first_visit();
  Settings localising = settings();
  localising.system.localisation_only = true;
  Slam slam(before().camera, localising);
  const Second second = visit_again(slam);
  EXPECT_EQ(second.wrong, 0) << "worst " << second.worst << " m";
  EXPECT_GE(second.ok, 90) << second.uncertain << " uncertain, " << second.lost << " lost";
  EXPECT_LE(second.first_ok, 2);
}

TEST_F(MovedFurniture, ALaterVisitGoesOnWithTheMap) {
  save_first_visit();
  Slam slam(before().camera, settings());
  const Second second = visit_again(slam);
  EXPECT_EQ(second.wrong, 0) << "worst " << second.worst << " m";
  EXPECT_GE(second.ok, 90) << second.uncertain << " uncertain, " << second.lost << " lost";
  EXPECT_EQ(slam.maps(), 1);
}

// Furniture goes to and fro between visits, again and again: what has gone leaves the map.
TEST_F(MovedFurniture, TheMapDoesNotGrowWithEachVisit) {
  constexpr int kVisits = 8;
  Slam slam(before().camera, settings());
  double time = 0;
  std::array<int, kVisits> landmarks{}, keyframes{};
  for (int visit = 0; visit < kVisits; ++visit) {
    for (const auto& frame : (visit % 2 == 0 ? before() : after()).frames) {
      RgbdImage image = frame.image;
      image.timestamp = time += 0.1;
      slam.track(image);
    }
    slam.finish();
    landmarks[visit] = slam.landmarks();
    keyframes[visit] = slam.keyframes();
  }
  EXPECT_EQ(slam.maps(), 1);
  EXPECT_LT(landmarks[kVisits - 1], 1.25 * landmarks[3]) << testing::PrintToString(landmarks);
  EXPECT_LT(keyframes[kVisits - 1], 1.25 * keyframes[3]) << testing::PrintToString(keyframes);
}

}  // namespace
}  // namespace stdc
