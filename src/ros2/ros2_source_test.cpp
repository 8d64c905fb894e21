#include "ros2/ros2_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "input/frame_decoder.hpp"
#include "ros2/test_node.hpp"

namespace stdc::ros2 {
namespace {

constexpr std::int64_t kStart = 1'700'000'000'000'000'000, kPeriod = 33'000'000;
constexpr int kWidth = 96, kHeight = 72;

/// A camera in a node of its own, which says what it is told to.
class TestCamera {
 public:
  TestCamera() {
    const auto advertise = [this](const char* topic, const char* type) {
      return node_.advertise(topic, type, {.reliable = true, .depth = 0, .large = true});
    };
    colour_ = advertise("/c/color/image_raw", "sensor_msgs/msg/Image");
    depth_ = advertise("/c/aligned_depth_to_color/image_raw", "sensor_msgs/msg/Image");
    info_ = advertise("/c/color/camera_info", "sensor_msgs/msg/CameraInfo");
  }
  static CameraTopics topics() {
    return {"/c/color/image_raw", "/c/aligned_depth_to_color/image_raw", "/c/color/camera_info",
            "/c/aligned_depth_to_color/camera_info"};
  }
  bool connected() const {
    return colour_->subscribers() > 0 && depth_->subscribers() > 0 && info_->subscribers() > 0;
  }
  void send_info(Style style = Style::cdr_little) {
    Camera camera;
    camera.width = kWidth, camera.height = kHeight;
    camera.fx = camera.fy = 60, camera.cx = 47.5, camera.cy = 35.5;
    info_->publish(test::camera_info_message(style, "optical", camera, "plumb_bob", {0, 0, 0, 0, 0}).bytes());
  }
  void send_colour(std::int64_t stamp, Style style = Style::cdr_little) {
    const std::vector<std::uint8_t> pixels(3 * kWidth * kHeight, 50);
    send(*colour_, test::image_message(style, stamp, "optical", kWidth, kHeight, "rgb8", pixels).bytes());
  }
  void send_depth(std::int64_t stamp, Style style = Style::cdr_little) {
    const std::vector<std::uint8_t> pixels(2 * kWidth * kHeight, 7);
    send(*depth_, test::image_message(style, stamp, "optical", kWidth, kHeight, "16UC1", pixels,
                                      style == Style::cdr_big)
                      .bytes());
  }
  void send_frames(int first, int end, std::int64_t start = kStart) {
    for (int i = first; i < end; ++i) {
      send_colour(start + i * kPeriod);
      send_depth(start + i * kPeriod + 1'000'000);
    }
  }
  void send_bytes(const std::vector<std::uint8_t>& bytes) { send(*colour_, bytes); }

 private:
  /// A publisher that keeps all gives up after a while if its readers have no room.
  static void send(Publication& publication, const std::vector<std::uint8_t>& bytes) {
    EXPECT_TRUE(eventually([&] { return publication.publish(bytes); }));
  }

  Node node_{test_domain()};
  std::unique_ptr<Publication> colour_, depth_, info_;
};

Ros2SourceOptions options(Reception reception = Reception::every_frame) {
  return {.topics = TestCamera::topics(), .reception = reception};
}

class Ros2SourceTest : public ::testing::Test {
 protected:
  void open(Reception reception = Reception::every_frame) {
    source_ = std::make_unique<Ros2Source>(node_, options(reception));
    ASSERT_TRUE(eventually([&] { return camera_.connected(); }));
  }
  void wait_for_cameras() {
    ASSERT_TRUE(eventually([&] {
      if (source_->wait_for_cameras(std::chrono::milliseconds(20))) return true;
      camera_.send_info();  // as cameras do with each image: what is sent before both sides know each other
                            // is lost
      return false;
    }));
  }

  Node node_{test_domain()};
  std::unique_ptr<Ros2Source> source_;
  TestCamera
      camera_;  ///< goes first: Fast DDS 2.9 may stand still where a reader leaves a writer that keeps all
};

TEST_F(Ros2SourceTest, GivesAllFramesInOrderWithTheCameraOfTheInfo) {
  open();
  camera_.send_info();
  std::jthread sending([&] { camera_.send_frames(0, 60); });
  wait_for_cameras();
  ASSERT_TRUE(source_->cameras().has_value());
  EXPECT_EQ(source_->cameras()->colour.fx, 60);
  EXPECT_EQ(source_->cameras()->colour.depth_units_per_metre, 1000) << "millimetres";
  EXPECT_EQ(source_->cameras()->colour.frames_per_second, 30);
  EXPECT_FALSE(source_->cameras()->depth.has_value()) << "registered";
  const FrameDecoder decoder(*source_->cameras());
  for (int i = 0; i < 59; ++i) {
    const auto frame = source_->next();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(source_->stamp_of(frame->timestamp), kStart + i * kPeriod);
    EXPECT_TRUE(source_->arrival_of(frame->timestamp).has_value());
    const RgbdImage image = decoder.decode(*frame, ColourMode::as_stored);
    EXPECT_EQ(image.depth.at<std::uint16_t>(0, 0), 0x0707);
  }
  sending.join();
  source_->stop();
  EXPECT_EQ(source_->stamp_of(source_->next()->timestamp), kStart + 59 * kPeriod) << "at the end what waited";
  EXPECT_FALSE(source_->next().has_value());
  EXPECT_EQ(source_->dropped(), 0);
  EXPECT_EQ(source_->image_frame(), "optical");
  EXPECT_TRUE(source_->is_live());
  EXPECT_FALSE(source_->can_rewind());
}

TEST_F(Ros2SourceTest, HearsOfTheCameraWhereImagesHaveNoRoom) {
  open();
  constexpr int kRoom = 15, kFrames = 40;
  std::jthread sending([&] { camera_.send_frames(0, kFrames); });
  ASSERT_TRUE(eventually([&] { return source_->counts().depth >= kRoom; }));
  wait_for_cameras();
  for (int i = 0; i < kFrames - 1; ++i) {
    const auto frame = source_->next();
    ASSERT_TRUE(frame.has_value());
    EXPECT_EQ(source_->stamp_of(frame->timestamp), kStart + i * kPeriod);
  }
  EXPECT_EQ(source_->dropped(), 0);
}

TEST_F(Ros2SourceTest, ReadsBigEndianAsWell) {
  open();
  camera_.send_info(Style::cdr_big);
  for (int i = 0; i < 7; ++i) {
    camera_.send_colour(kStart + i * kPeriod, Style::cdr_big);
    camera_.send_depth(kStart + i * kPeriod, Style::cdr_big);
  }
  wait_for_cameras();
  EXPECT_EQ(source_->cameras()->colour.fx, 60);
  const FrameDecoder decoder(*source_->cameras());
  EXPECT_EQ(decoder.decode(*source_->next(), ColourMode::grey).depth.at<std::uint16_t>(0, 0), 0x0707);
}

TEST_F(Ros2SourceTest, KeepsOnlyTheNewestWhereNobodyAsks) {
  open(Reception::reliable);
  camera_.send_info();
  for (int i = 0; i < 100; ++i) {
    camera_.send_frames(i, i + 1);
    // One after the other, so that the middleware's own short queue has no part in it.
    ASSERT_TRUE(eventually([&] { return source_->counts().depth == i + 1; }));
  }
  wait_for_cameras();
  EXPECT_EQ(source_->dropped(), 85) << "while nobody is ready yet half a second is kept";
  for (int i = 85; i < 100; ++i) {
    EXPECT_EQ(source_->stamp_of(source_->next()->timestamp), kStart + i * kPeriod);
  }
  camera_.send_frames(100, 105);
  ASSERT_TRUE(eventually([&] { return source_->counts().depth == 105; }));
  EXPECT_EQ(source_->dropped(), 87);
  ASSERT_EQ(source_->faults().size(), 1U);
  EXPECT_NE(source_->faults()[0].find("87 frames came too late"), std::string::npos);
}

TEST_F(Ros2SourceTest, SurvivesMessagesThatAreNone) {
  open();
  camera_.send_info();
  for (const std::size_t size : {1, 4, 5, 11, 40}) camera_.send_bytes(std::vector<std::uint8_t>(size, 0xFF));
  std::vector<std::uint8_t> lengths_that_lie(64, 0xFF);
  lengths_that_lie[0] = 0, lengths_that_lie[1] = 1;
  camera_.send_bytes(lengths_that_lie);
  camera_.send_frames(0, 7);
  wait_for_cameras();
  EXPECT_TRUE(source_->next().has_value());
  EXPECT_GE(source_->counts().damaged, 5);
}

TEST_F(Ros2SourceTest, GoesOnWithAPublisherThatBeganAnew) {
  open();
  camera_.send_info();
  camera_.send_frames(0, 7);
  wait_for_cameras();
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(source_->next().has_value());
  camera_.send_frames(0, 3, kStart - 3'600'000'000'000);
  const auto frame = source_->next();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(source_->stamp_of(frame->timestamp), kStart - 3'600'000'000'000);
  EXPECT_EQ(source_->counts().restarts, 1);
}

TEST_F(Ros2SourceTest, SaysWhatKeepsImagesFromComing) {
  open();
  Node other(test_domain());
  const auto wrong = other.advertise("/c/color/image_raw", "std_msgs/msg/Empty", {});
  const auto says = [&](const std::string& what) {
    const std::vector<std::string> problems = source_->problems();
    return std::any_of(problems.begin(), problems.end(),
                       [&](const std::string& problem) { return problem.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(eventually([&] { return says("/c/color/image_raw is published as std_msgs/msg/Empty"); }));
  source_ = std::make_unique<Ros2Source>(
      node_, Ros2SourceOptions{.topics = {"/no/image", "/no/depth", "/no/info", "/no/depth_info"}});
  EXPECT_TRUE(says("nobody publishes /no/image"));
  EXPECT_TRUE(says("nobody publishes /no/info"));
  EXPECT_FALSE(says("depth_info")) << "is not needed";
  EXPECT_FALSE(source_->wait_for_cameras(std::chrono::milliseconds(1)));
}

}  // namespace
}  // namespace stdc::ros2
