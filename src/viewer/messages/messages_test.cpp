// What the page reads: sizes and places of the numbers in each kind of message.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <stdexcept>

#include "core/images/image_codec.hpp"
#include "viewer/aligned_truth.hpp"
#include "viewer/keyframe_images.hpp"
#include "viewer/messages/image_message.hpp"
#include "viewer/messages/map_message.hpp"
#include "viewer/messages/mesh_message.hpp"
#include "viewer/messages/test_message.hpp"
#include "viewer/server/view_request.hpp"
#include "viewer/view_state.hpp"

namespace stdc {
namespace {

using test::number_at;

std::vector<std::uint8_t> part(const std::string& bytes, std::size_t at, std::size_t size) {
  const std::string text = bytes.substr(at, size);
  return {text.begin(), text.end()};
}

TEST(FrameRecord, SaysWhatTheResultSays) {
  TrackingResult result;
  result.frame = 7;
  result.timestamp = 12.5;
  result.status = TrackingStatus::uncertain;
  result.cam_from_world = Pose(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1, 2, 3));
  result.map = MapId{2};
  result.inliers = 100000;
  result.is_keyframe = true;
  result.milliseconds.total = 33;
  const std::string bytes = encode_frames(4, {make_frame_record(result)});
  ASSERT_EQ(bytes.size(), 8 + kFrameRecordSize);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 0), 4U);
  EXPECT_EQ(number_at<double>(bytes, 8), 12.5);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 16), 7U);
  EXPECT_EQ(number_at<float>(bytes, 20), 33.0F);
  EXPECT_EQ(number_at<std::uint16_t>(bytes, 32), 65535U);  // the most that there is room for
  EXPECT_EQ(bytes[40], 2);                                 // uncertain
  EXPECT_EQ(bytes[41], FrameRecord::kPose | FrameRecord::kKeyframe);
  EXPECT_EQ(number_at<std::uint16_t>(bytes, 42), 2U);
  EXPECT_EQ(number_at<float>(bytes, 44), -1.0F);  // world_from_cam
  EXPECT_EQ(number_at<float>(bytes, 68), 1.0F);   // w
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 72), 1U);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 76), 0U);
}

TEST(ImageMessage, HoldsWhatIsWanted) {
  ViewImage image;
  image.frame = 3;
  image.colour.seen = cv::Mat(960, 1280, CV_8UC3, cv::Scalar(10, 200, 30));
  image.depth = cv::Mat(960, 1280, CV_16UC1, cv::Scalar(10000));  // 2 m
  image.depth.at<std::uint16_t>(0, 0) = 0;
  image.found.segmented = cv::Mat(960, 1280, CV_8UC1, cv::Scalar(255));
  image.found.moving = cv::Mat(960, 1280, CV_8UC1, cv::Scalar(0));
  image.found.keypoints = {{100.5F, 20.25F, 0, 0, 0, KeypointQuality::high}};
  image.found.states = {KeypointState::outlier};
  const std::string all = encode_image(image, kWantImage | kWantDepth | kWantMasks);
  EXPECT_EQ(number_at<std::uint32_t>(all, 0), 3U);
  EXPECT_EQ(number_at<std::uint16_t>(all, 4), 1280U);
  const auto colour = number_at<std::uint32_t>(all, 16), depth = number_at<std::uint32_t>(all, 20),
             masks = number_at<std::uint32_t>(all, 24);
  ASSERT_EQ(number_at<std::uint32_t>(all, 28), 1U);
  EXPECT_EQ(number_at<std::uint16_t>(all, 32), 804U);
  EXPECT_EQ(all[36], 2);  // outlier
  EXPECT_EQ(all[37], 1);  // high
  ASSERT_EQ(all.size(), 38 + colour + depth + masks);
  EXPECT_EQ(decode_jpeg(part(all, 38, colour), {640, 480}, ColourMode::as_stored).problem, "");
  const DecodedImage grey =
      decode_png_colour(part(all, 38 + colour, depth), {320, 240}, ColourMode::as_stored);
  ASSERT_EQ(grey.problem, "");
  EXPECT_EQ(grey.image.at<std::uint8_t>(0, 0), 0);    // missing
  EXPECT_EQ(grey.image.at<std::uint8_t>(9, 9), 255);  // the farthest
  EXPECT_EQ(number_at<float>(all, 12), 2.0F);
  const DecodedImage causes =
      decode_png_colour(part(all, 38 + colour + depth, masks), {320, 240}, ColourMode::as_stored);
  EXPECT_EQ(causes.image.at<std::uint8_t>(9, 9), 1);  // the network's
  const std::string little = encode_image(image, kWantImage);
  EXPECT_EQ(number_at<std::uint32_t>(little, 20), 0U);
  EXPECT_EQ(number_at<std::uint32_t>(little, 24), 0U);
}

TEST(ImageMessage, TakesDepthInMetresAndWhatIsNoNumber) {
  ViewImage image;
  image.colour.seen = cv::Mat(48, 64, CV_8UC1, cv::Scalar(9));
  image.depth = cv::Mat(48, 64, CV_32FC1, cv::Scalar(std::nanf("")));
  const std::string bytes = encode_image(image, kWantImage | kWantDepth | kWantMasks);
  const auto colour = number_at<std::uint32_t>(bytes, 16), depth = number_at<std::uint32_t>(bytes, 20);
  const DecodedImage grey =
      decode_png_colour(part(bytes, 32 + colour, depth), {64, 48}, ColourMode::as_stored);
  EXPECT_EQ(cv::countNonZero(grey.image), 0);
}

TEST(ViewColour, IsInColourWhereThatCanBeHad) {
  const cv::Mat grey(48, 64, CV_8UC1, cv::Scalar(9)), coloured(48, 64, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(ViewColour{grey}.image().channels(), 1);
  EXPECT_EQ((ViewColour{grey, [&] { return coloured; }}.image().channels()), 3);
  EXPECT_EQ((ViewColour{grey, [&] { return cv::Mat(24, 32, CV_8UC3); }}.image().size()), grey.size());
  EXPECT_EQ((ViewColour{grey, []() -> cv::Mat { throw std::runtime_error("gone"); }}.image().channels()), 1);
}

TEST(MeshMessage, PlacesAreWithinATenthOfAMillimetre) {
  TriangleMesh mesh;
  mesh.positions = {{-1, -2, -3}, {4, 5, 6}, {0.123F, 1.234F, 2.345F}};
  mesh.colours = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  mesh.triangles = {{0, 1, 2}};
  const std::string bytes = encode_mesh(mesh);
  ASSERT_EQ(bytes.size(), 32U + 18 + 9 + 1 + 12);
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    const float corner = number_at<float>(bytes, 4 * at), size = number_at<float>(bytes, 12 + 4 * at);
    const float place =
        corner + size * static_cast<float>(number_at<std::uint16_t>(bytes, 32 + 12 + 2 * at)) / 65535;
    EXPECT_NEAR(place, mesh.positions[2][axis], 1e-4F);
  }
  EXPECT_EQ(bytes[50 + 8], 9);
  EXPECT_EQ(number_at<std::uint32_t>(bytes, 60 + 8), 2U);
  EXPECT_EQ(encode_mesh({}).size(), 32U);
}

TEST(MapMessage, OfAnEmptyMapIsEmpty) {
  const std::string bytes = encode_map({MapId{0}, {}, {}, {}});
  EXPECT_EQ(bytes.size(), 28U);
}

TEST(MapMessage, OfADayIsBounded) {
  constexpr int kDay = 2'000'000;
  constexpr std::size_t kHeader = 28, kPose = 16, kTruth = 12;
  ViewMap map{MapId{0}, {}, {}, {}};
  for (int i = 0; i < kDay; ++i) {
    FramePose pose;
    pose.frame = i;
    pose.map = MapId{0};
    map.trajectory.push_back(pose);
    map.truth.emplace_back(i == 1001 ? NAN : i, 0, 0);
  }
  const std::string bytes = encode_map(map);
  const auto number_at = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  const std::uint32_t poses = number_at(4), truth = number_at(24);
  EXPECT_GT(poses, ViewMap::kMaxPoints / 3);
  EXPECT_LE(poses, ViewMap::kMaxPoints + 1);
  EXPECT_EQ(truth, poses + 1) << "and the gap";
  EXPECT_EQ(bytes.size(), kHeader + kPose * poses + kTruth * truth);
  const auto frame = [&](std::size_t i) { return number_at(kHeader + kPose * i + 12); };
  EXPECT_EQ(frame(0), 0U);
  EXPECT_EQ(frame(poses - 1), kDay - 1U);
  EXPECT_EQ(frame(poses - 5000), kDay - 5000U) << "the newest are all there";
  for (std::size_t i = 1; i < poses; ++i) ASSERT_GT(frame(i), frame(i - 1));
}

TEST(ViewState, IsJsonWhateverTheNameIs) {
  ViewSubject subject;
  subject.name = "caf\xe9 \"x\"";  // not UTF-8
  ViewState state;
  state.events.push_back({5, "lost"});
  const auto json = nlohmann::json::parse(encode_state(subject, state));
  EXPECT_EQ(json["events"][0]["frame"], 5);
  EXPECT_TRUE(json["ate"].is_null());
}

TEST(ViewEvents, TellLossesAndLoopsInWords) {
  ViewEvents events;
  const auto add = [&events](int frame, TrackingStatus status, MapId map) {
    TrackingResult result;
    result.frame = frame;
    result.status = status;
    result.map = map;
    events.add(result);
  };
  add(0, TrackingStatus::ok, MapId{0});
  add(1, TrackingStatus::ok, MapId{0});
  add(2, TrackingStatus::lost, {});
  add(3, TrackingStatus::lost, {});
  add(9, TrackingStatus::ok, MapId{0});
  LoopReport loop;
  loop.drift = 0.031;
  loop.keyframes = 12;
  events.add(loop);
  ASSERT_EQ(events.latest().size(), 4U);
  EXPECT_EQ(events.latest()[1].text, "tracking lost: looking for a known place");
  EXPECT_EQ(events.latest()[2].text, "found again after 7 frames");
  EXPECT_EQ(events.latest()[3].text, "loop closed with frame 0: 3.1 cm of drift over 12 keyframes");
  for (int i = 0; i < 1000; ++i)
    add(10 + i, i % 2 == 0 ? TrackingStatus::lost : TrackingStatus::ok, MapId{0});
  EXPECT_EQ(events.latest().size(), 100U);
}

TEST(KeyframeImages, TheOldestGoWhenThereAreTooMany) {
  KeyframeImages images(5000);
  const cv::Mat colour(480, 640, CV_8UC3, cv::Scalar(1, 2, 3));
  for (int i = 0; i < 20; ++i) images.add(i, colour);
  EXPECT_EQ(images.message(0)->size(), 4U);  // the frame alone
  EXPECT_GT(images.message(19)->size(), 100U);
  EXPECT_EQ(images.message(77)->size(), 4U);
}

TEST(AlignedTruth, LiesWhereTheTrajectoryIs) {
  Trajectory truth, estimate;
  const Pose world_from_truth(Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY())),
                              Eigen::Vector3d(3, 4, 5));
  for (int i = 0; i < 100; ++i) {
    const Pose pose(Eigen::Quaterniond::Identity(),
                    Eigen::Vector3d(std::sin(0.1 * i), std::cos(0.13 * i), 0.02 * i));
    truth.push_back({0.1 * i, pose});
    if (i < 60) estimate.push_back({0.1 * i, world_from_truth * pose});
  }
  AlignedTruth aligned(truth);
  EXPECT_TRUE(aligned.fit({}).positions.empty());
  const AlignedTruth::Fit fit = aligned.fit(estimate);
  ASSERT_EQ(fit.positions.size(), 60U);  // nothing of what is to come
  EXPECT_LT((fit.positions[30] - estimate[30].world_from_cam.translation).norm(), 1e-6);
  EXPECT_LT(fit.ate.value_or(1), 1e-6);
}

}  // namespace
}  // namespace stdc
