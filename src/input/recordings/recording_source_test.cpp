#include "input/recordings/recording_source.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"
#include "input/camera_file.hpp"
#include "input/frame_decoder.hpp"
#include "input/recordings/messages/test_messages.hpp"
#include "input/recordings/messages/test_pattern.hpp"
#include "input/recordings/topic_names.hpp"

namespace stdc {
namespace {

using test::message_of;
using Style = test::MessageWriter::Style;

constexpr std::int64_t kSecond = 1'000'000'000, kStart = 1'700'000'000 * kSecond;
constexpr const char* kColour = "/camera/color/image_raw";
constexpr const char* kDepth = "/camera/aligned_depth_to_color/image_raw";
constexpr const char* kInfo = "/camera/color/camera_info";
constexpr const char* kFrame = "camera_color_optical_frame";
constexpr int kWidth = 64, kHeight = 64;

Camera small_camera() {
  Camera camera;
  camera.width = kWidth, camera.height = kHeight, camera.fx = 70, camera.fy = 70, camera.cx = 31.5,
  camera.cy = 31.5;
  return camera;
}

struct Images {
  std::string colour = kColour, depth = kDepth, frame = kFrame, depth_frame = kFrame;
  std::string encoding = "rgb8", depth_encoding = "16UC1";
  int frames = 4;
  std::int64_t depth_later = 3'000'000;  // [ns]
  std::int64_t depth_clock = 0;          // [ns], its stamps only
  int depth_width = kWidth;
};

std::int64_t time_of(int frame) { return kStart + frame * kSecond / 30; }

void add_images(test::TestRecording& recording, const Images& images) {
  for (int i = 0; i < images.frames; ++i) {
    const std::size_t colour_bytes = kWidth * kHeight * 3;
    const auto depth_bytes = static_cast<std::size_t>(images.depth_width * kHeight * 2);
    recording.add(images.colour, "sensor_msgs/Image", time_of(i),
                  test::image_message(Style::ros1, time_of(i), images.frame, kWidth, kHeight, images.encoding,
                                      std::vector<std::uint8_t>(colour_bytes, static_cast<std::uint8_t>(i))));
    const std::int64_t later = time_of(i) + images.depth_later;
    recording.add(
        images.depth, "sensor_msgs/Image", later,
        test::image_message(Style::ros1, later + images.depth_clock, images.depth_frame, images.depth_width,
                            kHeight, images.depth_encoding, std::vector<std::uint8_t>(depth_bytes, 3)));
  }
}

void add_info(test::TestRecording& recording, const std::string& topic = kInfo,
              const std::string& frame = kFrame, const Camera& camera = small_camera()) {
  recording.add(topic, "sensor_msgs/CameraInfo", kStart,
                test::camera_info_message(Style::ros1, frame, camera, "plumb_bob", {0.01, 0, 0, 0, 0}));
}

std::unique_ptr<FrameSource> source_of(const test::TestRecording& recording,
                                       const SourceOptions& options = {}) {
  return make_recording_source(
      [&] {
        auto copy = std::make_unique<test::TestRecording>();
        copy->copy(recording);
        return copy;
      },
      options);
}

std::string refusal(const test::TestRecording& recording, const SourceOptions& options = {}) {
  return message_of([&] {
    const auto source = source_of(recording, options);
    while (source->next()) {
    }
  });
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

int count_frames(FrameSource& source) {
  int count = 0;
  while (source.next()) ++count;
  return count;
}

TEST(RecordingSource, GivesTheFramesOfOtherPeoplesRecordings) {
  for (const char* name : {"raw.bz2.bag", "png.lz4.bag", "raw.zstd.mcap", "png.lz4.mcap", "raw.no-index.mcap",
                           "bgr-float.lz4.mcap", "raw_db3_file", "raw_mcap_split"}) {
    SCOPED_TRACE(name);
    const auto source = open_recording_source(test::pattern_recording(name), {});
    ASSERT_TRUE(source->cameras().has_value());
    const Camera camera = source->cameras()->colour;
    EXPECT_FALSE(source->cameras()->depth.has_value());
    EXPECT_EQ(camera.fy, 61);
    EXPECT_EQ(camera.k3, 0.01);
    EXPECT_EQ(camera.depth_units_per_metre, 1000);
    EXPECT_EQ(camera.frames_per_second, 30);
    const FrameDecoder decoder(*source->cameras());
    for (int run = 0; run < 2; ++run) {
      for (int i = 0; i < test::kPatternFrames; ++i) {
        const auto frame = source->next();
        ASSERT_TRUE(frame.has_value());
        EXPECT_EQ(frame->name,
                  (std::vector<std::string>{"1700000000.000000", "1700000000.033333", "1700000000.066666",
                                            "1700000000.100000"})[static_cast<std::size_t>(i)]);
        EXPECT_NEAR(frame->depth_timestamp - frame->timestamp, 0.003, 1e-6);
        const RgbdImage image = decoder.decode(*frame, ColourMode::as_stored);
        EXPECT_TRUE(test::same_pixels(image.colour, test::pattern_colour(i)));
        if (image.depth.type() == CV_16UC1) {
          EXPECT_TRUE(test::same_pixels(image.depth, test::pattern_depth(i)));
        }
      }
      EXPECT_FALSE(source->next().has_value());
      source->rewind();
    }
    const auto truth = source->ground_truth();
    ASSERT_TRUE(truth.has_value());
    EXPECT_EQ(truth->poses.size(), 4U);
    EXPECT_NEAR(truth->poses[3].world_from_cam.translation.x(), 0.03, 1e-12);
    EXPECT_TRUE(source->faults().empty());
  }
}

TEST(RecordingSource, TimesAreExactlyThoseThatATextWouldGive) {
  test::TestRecording recording;
  add_images(recording, {});
  add_info(recording);
  const auto source = source_of(recording);
  source->next();
  EXPECT_EQ(source->next()->timestamp, 1700000000.033333333);
}

TEST(RecordingSource, TakesWhatCameraInfoHasNoPlaceFor) {
  const auto source_with = [](const std::string& text) {
    test::TestRecording recording;
    add_images(recording, {});
    add_info(recording);
    recording.add(kCameraFileTopic, "std_msgs/String", kStart, test::MessageWriter(Style::ros1).text(text));
    return source_of(recording);
  };
  Camera camera = small_camera();
  camera.readout_time = 0.02;
  camera.rotation = 90;
  const auto same = source_with(format_camera(camera));
  EXPECT_EQ(same->cameras()->colour.readout_time, 0.02);
  EXPECT_EQ(same->cameras()->colour.rotation, 90);
  camera.fx += 1;
  const auto other = source_with(format_camera(camera));
  EXPECT_EQ(other->cameras()->colour.readout_time, 0);
  EXPECT_EQ(other->cameras()->colour.fx, small_camera().fx);
  const auto wrong = source_with("readout_time: soon");
  EXPECT_EQ(wrong->cameras()->colour.readout_time, 0);
  EXPECT_TRUE(has(wrong->notes()[0], "(/stdc_slam/camera): is left out")) << wrong->notes()[0];
}

TEST(RecordingSource, PrefersColourToInfraredAndAlignedToOtherDepth) {
  test::TestRecording recording;
  add_images(recording, {});
  add_images(recording, {.colour = "/camera/infra1/image_rect_raw",
                         .depth = "/camera/depth/image_rect_raw",
                         .frame = "infra1",
                         .depth_frame = "depth",
                         .encoding = "mono8"});
  add_info(recording);
  const auto source = source_of(recording);
  EXPECT_TRUE(
      has(source->notes()[0], "colour from /camera/color/image_raw, depth from /camera/aligned_depth"));
  EXPECT_EQ(count_frames(*source), 4);
  SourceOptions options;
  options.colour_topic = "/camera/infra1/image_rect_raw";
  options.depth_topic = "/camera/depth/image_rect_raw";
  EXPECT_TRUE(has(source_of(recording, options)->notes().back(), "colour from /camera/infra1"));
}

TEST(RecordingSource, NamesTheTopicsIfThereAreSeveralOrNone) {
  test::TestRecording two;
  add_images(two, {.colour = "/left/color/image_raw", .depth = "/left/depth/image_raw"});
  add_images(two, {.colour = "/right/color/image_raw", .depth = "/right/depth/image_raw"});
  const std::string several = refusal(two);
  EXPECT_TRUE(has(several, "test.bag: holds 2 topics with colour images: /left/color/image_raw, /right"))
      << several;
  EXPECT_TRUE(has(several, "; choose one by --color")) << several;
  SourceOptions right;
  right.colour_topic = "/right/color/image_raw";
  EXPECT_TRUE(has(source_of(two, right)->notes().back(), "depth from /right/depth/image_raw"));
  SourceOptions wrong;
  wrong.depth_topic = "/none";
  const std::string absent = refusal(two, wrong);
  EXPECT_TRUE(has(absent, "has no topic /none; give another --depth; there is /left/color")) << absent;

  test::TestRecording unknown;
  add_images(unknown, {.encoding = "bayer_weird"});
  const std::string encoding = refusal(unknown);
  EXPECT_TRUE(has(encoding,
                  "holds no colour images (/camera/color/image_raw has the unknown encoding 'bayer_weird')"))
      << encoding;
}

TEST(RecordingSource, SaysWhatIsMissingOfTheCameras) {
  test::TestRecording recording;
  add_images(recording, {});
  EXPECT_FALSE(source_of(recording)->cameras().has_value());
  EXPECT_TRUE(has(source_of(recording)->camera_hint(), "record camera_info beside /camera/color/image_raw"));

  test::TestRecording larger;
  add_images(larger, {.depth = "/camera/depth/image_rect_raw", .depth_frame = "depth", .depth_width = 80});
  add_info(larger);
  EXPECT_FALSE(source_of(larger)->cameras().has_value());
  EXPECT_TRUE(
      has(source_of(larger)->camera_hint(), "(80 x 64) is not registered to /camera/color/image_raw"));
}

TEST(RecordingSource, UnregisteredDepthHasACameraOfItsOwn) {
  test::TestRecording recording;
  add_images(recording, {.depth = "/camera/depth/image_rect_raw", .depth_frame = "depth", .depth_width = 80});
  add_info(recording);
  Camera camera = small_camera();
  camera.width = 80;
  add_info(recording, "/camera/depth/camera_info", "depth", camera);
  const Pose link_from_colour(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.015, 0, 0));
  recording.add("/tf_static", "tf2_msgs/TFMessage", kStart,
                test::transform_message(Style::ros1, "/link", kFrame, link_from_colour));
  recording.add("/tf_static", "tf2_msgs/TFMessage", kStart,
                test::transform_message(Style::ros1, "link", "/depth", Pose()));
  const auto cameras = source_of(recording)->cameras();
  ASSERT_TRUE(cameras.has_value() && cameras->depth.has_value());
  EXPECT_EQ(cameras->depth->camera.width, 80);
  EXPECT_EQ(cameras->depth->camera.k1, 0);  // image_rect: without the lens
  EXPECT_NEAR(cameras->depth->colour_from_depth.translation.x(), -0.015, 1e-12);
}

TEST(RecordingSource, KnowsRealSensesTopics) {
  const std::string device = "/device_0/sensor_";
  test::TestRecording recording;
  add_images(recording, {.colour = device + "1/Color_0/image/data",
                         .depth = device + "0/Depth_0/image/data",
                         .frame = "0",
                         .depth_frame = "0",
                         .depth_encoding = "mono16",
                         .depth_width = 80});
  Camera camera = small_camera();
  add_info(recording, device + "1/Color_0/info/camera_info", "0", camera);
  camera.width = 80;
  add_info(recording, device + "0/Depth_0/info/camera_info", "0", camera);
  test::MessageWriter unit(Style::ros1), pose(Style::ros1), identity(Style::ros1);
  recording.add(device + "0/option/Depth_Units/value", "std_msgs/Float32", kStart, unit.number(0.00025F));
  pose.pose(Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.015, 0, 0)));
  recording.add(device + "1/Color_0/tf/0", "geometry_msgs/Transform", kStart, pose);
  recording.add(device + "0/Depth_0/tf/0", "geometry_msgs/Transform", kStart, identity.pose(Pose()));
  const auto cameras = source_of(recording)->cameras();
  ASSERT_TRUE(cameras.has_value() && cameras->depth.has_value());
  EXPECT_EQ(cameras->depth->camera.depth_units_per_metre, 4000);
  EXPECT_NEAR(cameras->depth->colour_from_depth.translation.x(), 0.015, 1e-12);
}

TEST(RecordingSource, RefusesColourAndDepthWithoutACommonClock) {
  test::TestRecording recording;
  add_images(recording, {.depth_clock = -40 * kSecond});
  add_info(recording);
  const std::string far = refusal(recording);
  EXPECT_TRUE(
      has(far,
          "test.bag: the stamps of /camera/color/image_raw and /camera/aligned_depth_to_color/image_raw "
          "have no common clock: they are -39.997 s apart"))
      << far;
  test::TestRecording near;
  add_images(near, {.frames = 1, .depth_clock = kSecond});
  add_info(near);
  const std::string missed = refusal(near);
  EXPECT_TRUE(has(missed, "lies within 20 ms of one of /camera/color/image_raw")) << missed;
}

TEST(RecordingSource, LeavesOutImagesWhoseStampsGoBackAndSaysSo) {
  test::TestRecording recording;
  add_images(recording, {});
  add_info(recording);
  recording.add(kColour, "sensor_msgs/Image", time_of(9),
                test::image_message(Style::ros1, time_of(1), kFrame, kWidth, kHeight, "rgb8",
                                    std::vector<std::uint8_t>(kWidth * kHeight * 3)));
  const auto source = source_of(recording);
  EXPECT_EQ(count_frames(*source), 4);
  ASSERT_EQ(source->faults().size(), 1U);
  EXPECT_TRUE(
      has(source->faults()[0], "test.bag: 1 images of /camera/color/image_raw are left out: their stamps"));
}

TEST(RecordingSource, WithoutStampsTheTimesOfRecordingAreTaken) {
  test::TestRecording recording;
  for (int i = 0; i < 3; ++i) {
    recording.add(kColour, "sensor_msgs/Image", time_of(i),
                  test::image_message(Style::ros1, 0, kFrame, kWidth, kHeight, "rgb8",
                                      std::vector<std::uint8_t>(kWidth * kHeight * 3)));
    recording.add(kDepth, "sensor_msgs/Image", time_of(i) + 1'000'000,
                  test::image_message(Style::ros1, 0, kFrame, kWidth, kHeight, "16UC1",
                                      std::vector<std::uint8_t>(kWidth * kHeight * 2)));
  }
  add_info(recording);
  const auto source = source_of(recording);
  EXPECT_TRUE(has(source->notes().back(), "the times of recording are taken"));
  EXPECT_EQ(count_frames(*source), 3);
}

TEST(RecordingSource, NamesTheMessageThatCannotBeDecoded) {
  test::TestRecording recording;
  add_images(recording, {.frames = 1});
  recording.add(
      kColour, "sensor_msgs/Image", time_of(1),
      test::image_message(Style::ros1, time_of(1), kFrame, kWidth, kHeight, "rgb9", {1, 2, 3, 4, 5, 6}));
  recording.add(kDepth, "sensor_msgs/Image", time_of(1),
                test::image_message(Style::ros1, time_of(1), kFrame, kWidth, kHeight, "16UC1",
                                    std::vector<std::uint8_t>(kWidth * kHeight * 2)));
  const auto source = source_of(recording);
  source->next();
  const auto frame = source->next();
  ASSERT_TRUE(frame.has_value());
  const std::string message = message_of([&] { frame->images->colour({}, ColourMode::as_stored); });
  EXPECT_TRUE(has(message, "test.bag (/camera/color/image_raw at 1700000000.033333): its encoding 'rgb9'"))
      << message;
  const std::string size = message_of([&] { frame->images->depth({640, 480}); });
  EXPECT_TRUE(has(size, "is 64 x 64 pixels, but the camera has 640 x 480")) << size;
}

TEST(RecordingSource, GroundTruthIsThatOfTheCamera) {
  const auto shift = [](double x) { return Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, 0, 0)); };
  test::TestRecording recording;
  add_images(recording, {});
  add_info(recording);
  recording.add("/tf_static", "tf2_msgs/TFMessage", kStart,
                test::transform_message(Style::ros1, "body", kFrame, shift(0.5)));
  for (int i = 0; i < 3; ++i) {
    test::MessageWriter odometry(Style::ros1), transform(Style::ros1);
    odometry.header(time_of(i), "world").text("/body").pose(shift(i)).doubles(std::vector<double>(84));
    recording.add("/vicon/body/odom", "nav_msgs/Odometry", time_of(i), odometry);
    transform.number(1U).header(time_of(i), "/world").text("/body").pose(shift(10 + i));
    recording.add("/tf", "tf2_msgs/TFMessage", time_of(i), transform);
  }
  const auto source = source_of(recording);
  for (int run = 0; run < 2; ++run) {  // before the frames are read and after
    const auto truth = source->ground_truth();
    ASSERT_TRUE(truth.has_value() && truth->poses.size() == 3);
    EXPECT_EQ(truth->rows, 3);
    EXPECT_NEAR(truth->poses[2].world_from_cam.translation.x(), 2.5, 1e-12);
    EXPECT_EQ(count_frames(*source), run == 0 ? 4 : 0);
  }
  SourceOptions options;
  options.truth_topic = "/tf";
  const auto truth = source_of(recording, options)->ground_truth();
  ASSERT_TRUE(truth.has_value() && truth->poses.size() == 3);
  EXPECT_NEAR(truth->poses[2].world_from_cam.translation.x(), 12.5, 1e-12);
  options.truth_topic = kColour;
  EXPECT_TRUE(has(refusal(recording, options), "has no topic /camera/color/image_raw with poses"));
}

TEST(RecordingSource, FramesCarryTheInertialReadingsUpToTheirTime) {
  test::TestRecording recording;
  add_images(recording, {.frames = 2});
  add_info(recording);
  for (int i = 0; i < 8; ++i) {
    test::MessageWriter imu(Style::ros1);
    imu.header(kStart + i * kSecond / 200, "imu").doubles({0, 0, 0, 1}).doubles(std::vector<double>(9));
    imu.doubles({0.1 * i, 0, 0})
        .doubles(std::vector<double>(9))
        .doubles({0, 9.81, 0})
        .doubles(std::vector<double>(9));
    recording.add("/imu", "sensor_msgs/Imu", kStart + i * kSecond / 200, imu);
  }
  const auto source = source_of(recording);
  EXPECT_EQ(source->next()->imu.size(), 1U);
  const auto second = source->next();
  ASSERT_EQ(second->imu.size(), 6U);
  EXPECT_NEAR(second->imu[1].gyroscope.x(), 0.2, 1e-12);
  EXPECT_EQ(second->imu[1].acceleration.y(), 9.81);
}

}  // namespace
}  // namespace stdc
