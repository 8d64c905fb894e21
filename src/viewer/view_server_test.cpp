#include "viewer/view_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <initializer_list>
#include <string>
#include <thread>

#include "slam/system_tests/test_sequence.hpp"
#include "viewer/messages/test_message.hpp"
#include "viewer/server/test_web.hpp"
#include "viewer/view_topic.hpp"

namespace stdc {
namespace {

using test::TestSequence;

constexpr int kFrames = 40;

Settings settings_with_dense() {
  Settings settings;
  settings.dense.active = true;
  settings.dense.voxel = 0.04;
  settings.segmentation.source = SegmentationSource::off;
  return settings;
}

/// A page that takes all that it is sent, on a thread of its own.
class TestPage {
 public:
  explicit TestPage(int port) : line_(port) {
    line_.send(test::upgrade());
    line_.receive_head();  // RFC 6455, 4.1: before that a client sends nothing
    line_.send(test::frame("want 31"));
    thread_ = std::thread([this] {
      std::string bytes;
      while (true) {
        const std::string more = line_.receive(1);
        if (more.empty()) return;
        bytes += more;
        take(bytes);
      }
    });
  }
  ~TestPage() {
    line_.hang_up();
    thread_.join();
  }
  TestPage(const TestPage&) = delete;
  TestPage& operator=(const TestPage&) = delete;
  void send(const std::string& request) const { line_.send(test::frame(request)); }
  /// Whether a piece of each of them came, within a minute: how soon depends on what else the machine does.
  bool has(std::initializer_list<ViewTopic> topics) const {
    unsigned wanted = 0;
    for (const ViewTopic topic : topics) wanted |= 1U << static_cast<unsigned>(topic);
    for (int i = 0; i < 6000 && (seen_ & wanted) != wanted; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return (seen_ & wanted) == wanted;
  }
  /// Whether the image of a frame came last, within a minute.
  bool shows_image_of(int frame) const {
    for (int i = 0; i < 6000 && frame_of_image_ != frame; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return frame_of_image_ == frame;
  }

 private:
  /// Takes whole messages off the front.
  void take(std::string& bytes) {
    while (const auto payload = test::take_frame(bytes)) {
      if (payload->empty()) continue;
      const bool begins_image = payload->front() == static_cast<char>(ViewTopic::image) &&
                                test::number_at<std::uint32_t>(*payload, 12) == 0;
      if (begins_image) frame_of_image_ = test::number_at<int>(*payload, kPieceHeader);
      seen_ |= 1U << static_cast<unsigned>(payload->front());
    }
  }

  test::Line line_;
  std::atomic<unsigned> seen_ = 0;  ///< bit by ViewTopic
  std::atomic<int> frame_of_image_ = -1;
  std::thread thread_;
};

std::vector<FramePose> run_alone(const TestSequence& sequence) {
  Slam slam(sequence.camera, settings_with_dense());
  for (int i = 0; i < kFrames; ++i) slam.track(sequence.frames[static_cast<std::size_t>(i)].image);
  slam.finish();
  return slam.trajectory();
}

TEST(ViewServer, ResultsAreTheSameWithPagesAndWithout) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, settings_with_dense());
  auto view = std::make_unique<ViewServer>(ViewOptions{{"127.0.0.1", 0}},
                                           ViewSubject{.name = "test", .camera = sequence.camera});
  Trajectory truth;
  for (const auto& frame : sequence.frames) truth.push_back({frame.image.timestamp, frame.world_from_cam});
  view->set_truth(truth);
  EXPECT_EQ(view->link(), fmt::format("http://localhost:{}/", view->port()));
  {
    std::vector<std::unique_ptr<TestPage>> pages;
    for (int i = 0; i < 3; ++i) pages.push_back(std::make_unique<TestPage>(view->port()));
    view->wait_for_page({});
    for (int i = 0; i < kFrames; ++i) {
      const RgbdImage& image = sequence.frames[static_cast<std::size_t>(i)].image;
      view->show(&image, slam.track(image), slam);
      if (i == 10) pages.pop_back();  // closed in the middle of it
    }
    view->finish(slam, slam.finish());
    for (const auto& page : pages) {
      EXPECT_TRUE(page->has(
          {ViewTopic::state, ViewTopic::frames, ViewTopic::image, ViewTopic::map, ViewTopic::mesh}));
    }
    view.reset();
  }
  EXPECT_TRUE(test::same_bytes(slam.trajectory(), run_alone(sequence)));
}

TEST(ViewServer, TheLastImageIsShownThoughItCameTooSoon) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, settings_with_dense());
  ViewServer view({{"127.0.0.1", 0}}, {.name = "test", .camera = sequence.camera});
  const TestPage page(view.port());
  view.wait_for_page({});
  constexpr int kCount = 4;
  std::vector<TrackingResult> results;
  for (int i = 0; i < kCount; ++i) {
    results.push_back(slam.track(sequence.frames[static_cast<std::size_t>(i)].image));
  }
  RgbdImage reused;
  for (int i = 0; i < kCount; ++i) {  // much faster than images are shown
    const RgbdImage& image = sequence.frames[static_cast<std::size_t>(i)].image;
    image.colour.copyTo(reused.colour);
    image.depth.copyTo(reused.depth);
    view.show(&reused, results[static_cast<std::size_t>(i)], slam);
  }
  reused.colour.setTo(0);
  view.finish(slam, slam.finish());
  EXPECT_TRUE(page.shows_image_of(kCount - 1));
}

TEST(ViewServer, APageHoldsTheRunAndStepsThroughIt) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, settings_with_dense());
  auto view = std::make_unique<ViewServer>(ViewOptions{{"127.0.0.1", 0}},
                                           ViewSubject{.name = "test", .camera = sequence.camera});
  const TestPage page(view->port());
  page.send("pause");
  view->wait_for_page({});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::atomic<int> done = 0;
  std::thread run([&] {
    for (int i = 0; i < 4; ++i) {
      const RgbdImage& image = sequence.frames[static_cast<std::size_t>(i)].image;
      const TrackingResult result = slam.track(image);
      done = i + 1;
      view->show(&image, result, slam);
    }
  });
  const auto soon = [&done](int count) {
    for (int i = 0; i < 500 && done < count; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return done.load();
  };
  EXPECT_EQ(soon(1), 1);
  page.send("step");
  EXPECT_EQ(soon(2), 2);
  page.send("resume");
  EXPECT_EQ(soon(4), 4);
  run.join();
  view.reset();
}

TEST(ViewServer, AHeldRunCanBeGivenUp) {
  const TestSequence& sequence = TestSequence::of_a_desk();
  Slam slam(sequence.camera, settings_with_dense());
  auto view = std::make_unique<ViewServer>(ViewOptions{{"127.0.0.1", 0}},
                                           ViewSubject{.name = "test", .camera = sequence.camera});
  const TestPage page(view->port());
  page.send("pause");
  view->wait_for_page({});
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const RgbdImage& image = sequence.frames[0].image;
  int asked = 0;
  view->show(&image, slam.track(image), slam, [&asked] { return ++asked > 3; });
  EXPECT_EQ(asked, 4);
  view->show(nullptr, slam.skip(1e9), slam, [] { return true; });  // a frame without an image
  view.reset();
}

}  // namespace
}  // namespace stdc
