#include "slam/threads/back_end.hpp"

#include <gtest/gtest.h>

#include "place_recognition/test_revisit.hpp"

namespace stdc {
namespace {

using test::Revisit;
using test::Scene;

/// A back end with both visits of a room in its atlas, of which it maps the second again, a keyframe every
/// ten frames.
struct TwoVisits {
  explicit TwoVisits(const Settings& settings) : revisit{Scene(500)} {
    revisit.visit_first(5);
    revisit.visit_second(revisit.mapped.scene, 5);
    Settings keep_all = settings;
    keep_all.mapping.redundant_share = 1;  // no keyframe is culled
    back_end = std::make_unique<BackEnd>(revisit.mapped.scene.camera, keep_all);
    back_end->set_atlas(std::move(revisit.mapped.atlas));
    back_end->collect(0, true);
  }
  /// Runs for some frames; @returns the loops that were collected.
  int run(int frames) {
    int loops = 0;
    std::size_t next = 0;
    for (int frame = 1; frame <= frames; ++frame) {
      const BackEndUpdate update = back_end->collect(frame, false);
      loops += update.loop ? 1 : 0;
      if (frame % 10 == 0 && next < revisit.second.size() && back_end->idle() && !back_end->has_pending()) {
        back_end->map_keyframe(revisit.second[next++], back_end->atlas().landmark_id_limit(), frame);
      }
      back_end->start_pending(frame);
    }
    return loops;
  }
  Revisit revisit;
  std::unique_ptr<BackEnd> back_end;
};

TEST(BackEnd, AJobIsCollectedAtItsFrameAndNotBefore) {
  Settings settings;
  settings.system.mapping_latency = 3;
  settings.loop_closing.active = false;
  TwoVisits visits(settings);
  BackEnd& back_end = *visits.back_end;
  ASSERT_TRUE(back_end.idle());
  back_end.map_keyframe(visits.revisit.second[0], back_end.atlas().landmark_id_limit(), 10);
  for (int frame = 10; frame < 13; ++frame) {
    EXPECT_FALSE(back_end.collect(frame, false).atlas_changed) << frame;
    EXPECT_FALSE(back_end.idle());
    EXPECT_GT(back_end.snapshot().keyframe_count(), 0) << "the state can be asked for all the same";
  }
  const BackEndUpdate update = back_end.collect(13, false);
  EXPECT_TRUE(update.atlas_changed && update.mapping && update.place_recognition_ms);
  EXPECT_TRUE(back_end.idle());
  EXPECT_FALSE(back_end.busy());
}

TEST(BackEnd, AnAtlasThatWasGivenIsSeenBeforeAndAfterItsPlacesAreLearnt) {
  Revisit revisit{Scene(500)};
  revisit.visit_first(5);
  BackEnd back_end(revisit.mapped.scene.camera, Settings());
  const int landmarks = revisit.mapped.atlas.landmark_count();
  back_end.set_atlas(std::move(revisit.mapped.atlas));
  for (const bool learnt : {false, true}) {
    EXPECT_EQ(back_end.snapshot().keyframe_count(), 5) << learnt;
    EXPECT_EQ(back_end.snapshot().landmark_count(), landmarks) << learnt;
    if (learnt) continue;
    EXPECT_TRUE(back_end.collect(0, true).atlas_changed);
  }
}

TEST(BackEnd, ClosesALoopAndAdjustsTheWholeMapAfterIt) {
  TwoVisits visits((Settings()));
  EXPECT_EQ(visits.run(200), 1);
  EXPECT_FALSE(visits.back_end->busy()) << "the global bundle adjustment has been applied";
}

TEST(BackEnd, LoopClosingCanBeSwitchedOff) {
  Settings settings;
  settings.loop_closing.active = false;
  TwoVisits visits(settings);
  EXPECT_EQ(visits.run(200), 0);
}

}  // namespace
}  // namespace stdc
