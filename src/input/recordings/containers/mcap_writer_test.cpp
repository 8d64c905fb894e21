#include "input/recordings/containers/mcap_writer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/error.hpp"
#include "core/files/test_folder.hpp"
#include "input/recordings/messages/message_definitions.hpp"
#include "input/recordings/messages/ros2_messages.hpp"
#include "input/recordings/open_recording.hpp"

namespace stdc {
namespace {

constexpr std::int64_t kFirstTime = 1'700'000'000'000'000'000;

/// Two topics, in several chunks.
void write_two_topics(const std::filesystem::path& path, int count) {
  McapWriter writer(path);
  const auto image =
      writer.add_topic("/image", "sensor_msgs/msg/Image", message_definition("sensor_msgs/msg/Image"));
  const auto pose = writer.add_topic("/pose", "geometry_msgs/msg/PoseStamped",
                                     message_definition("geometry_msgs/PoseStamped"));
  for (int i = 0; i < count; ++i) {
    const std::int64_t time = kFirstTime + i * 1'000'000;
    cv::Mat pixels(480, 640, CV_8UC3);
    cv::randu(pixels, 0, 255);
    writer.write(image, time, ros2::image_message({time, "camera"}, pixels));
    writer.write(pose, time, ros2::pose_message({time, "map"}, Pose()));
  }
  writer.commit();
}

TEST(McapWriter, IsReadBack) {
  const test::TestFolder folder;
  constexpr int kCount = 12;
  write_two_topics(folder / "a.mcap", kCount);
  const auto recording = open_recording(folder / "a.mcap");
  ASSERT_EQ(recording->topics().size(), 2U);
  EXPECT_EQ(recording->topics()[0].name, "/image");
  EXPECT_EQ(recording->topics()[0].type, "sensor_msgs/Image");
  EXPECT_EQ(recording->topics()[1].name, "/pose");
  EXPECT_TRUE(recording->faults().empty());
  recording->start(std::array{0, 1});
  int messages = 0;
  std::int64_t last = 0;
  while (const auto message = recording->next()) {
    EXPECT_GE(message->log_time, last);
    last = message->log_time;
    ++messages;
  }
  EXPECT_EQ(messages, 2 * kCount);
  EXPECT_EQ(last, kFirstTime + (kCount - 1) * 1'000'000);
}

TEST(McapWriter, LeavesNothingBehindUnlessItIsFinished) {
  const test::TestFolder folder;
  {
    McapWriter writer(folder / "a.mcap");
    writer.add_topic("/pose", "geometry_msgs/msg/PoseStamped", "");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(McapWriter(folder / "none/a.mcap"), Error);
}

TEST(MessageDefinition, HasAllTypesThatItUsesOnce) {
  const std::string text = message_definition("sensor_msgs/msg/CameraInfo");
  EXPECT_TRUE(text.starts_with("std_msgs/Header header\n"));
  for (const char* type :
       {"MSG: std_msgs/Header\n", "MSG: builtin_interfaces/Time\n", "MSG: sensor_msgs/RegionOfInterest\n"}) {
    const auto first = text.find(type);
    EXPECT_NE(first, std::string::npos) << type;
    EXPECT_EQ(text.find(type, first + 1), std::string::npos) << type;
  }
  EXPECT_THROW(message_definition("std_msgs/msg/Empty"), std::invalid_argument);
}

}  // namespace
}  // namespace stdc
