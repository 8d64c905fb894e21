#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "input/frame_decoder.hpp"
#include "input/open_source.hpp"
#include "input/test_layouts.hpp"

namespace stdc {
namespace {

using test::layout_camera;
using test::layout_colour;
using test::layout_depth;
using test::message_of;
using test::TestFolder;

constexpr const char* kIdentity = "1 0 0 0.5\n0 1 0 -0.25\n0 0 1 2\n0 0 0 1\n";

/// All frames of a source, decoded.
std::vector<RgbdImage> read_all(FrameSource& source) {
  const FrameDecoder decoder(source.cameras().value());
  std::vector<RgbdImage> images;
  while (const auto frame = source.next()) images.push_back(decoder.decode(*frame, ColourMode::as_stored));
  return images;
}

bool any_with(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

void write_images(const TestFolder& folder, const std::string& colour, const std::string& depth, int i,
                  int units) {
  folder.write(colour, encode_png(layout_colour(i)));
  folder.write(depth, encode_png(layout_depth(units)));
}

TEST(Layouts, BonnsCameraIsKnownByTheNameOfTheFolder) {
  const TestFolder folder;
  test::write_tum_folder(folder, "rgbd_bonn_crowd", 1);
  std::filesystem::remove(folder / "rgbd_bonn_crowd/camera.yaml");
  const auto source = open_source(folder / "rgbd_bonn_crowd");
  EXPECT_EQ(source->kind(), "tum");
  EXPECT_NEAR(source->cameras()->colour.fx, 542.822841, 1e-9);
  EXPECT_EQ(source->cameras()->colour.depth_units_per_metre, 5000);
}

TEST(Layouts, Eth3dHasItsCameraInCalibrationTxt) {
  const TestFolder folder;
  test::write_tum_folder(folder, "cables_1", 2);
  std::filesystem::remove(folder / "cables_1/camera.yaml");
  folder.write("cables_1/calibration.txt", std::string("726.28741455078 726.28741455078 39.5 31.25\n"));
  const auto source = open_source(folder / "cables_1");
  EXPECT_NEAR(source->cameras()->colour.fx, 726.28741455078, 1e-9);
  EXPECT_EQ(source->cameras()->colour.width, 80);
  EXPECT_EQ(read_all(*source).size(), 2U);
}

TEST(Layouts, IclNuim) {
  const TestFolder folder;
  for (int i = 0; i < 3; ++i) {
    write_images(folder, fmt::format("rgb/{}.png", i), fmt::format("depth/{}.png", i), i, 5000);
  }
  folder.write("associations.txt", std::string("0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n"
                                               "2 depth/2.png 2 rgb/2.png\n"));
  // A quarter turn about x and one about z: turned over to y down they go the other way.
  folder.write("office.gt.freiburg", std::string("1 1 2 3 0.70710678 0 0 0.70710678\n2 1 2 3 0 0 0.6 0.8\n"));
  EXPECT_EQ(open_source(folder.path())->cameras()->colour.fy, 480);
  folder.write("camera.yaml", format_camera(layout_camera()));
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "icl-nuim");
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 3U);
  EXPECT_NEAR(images[2].timestamp, 2 / 30.0, 1e-12);
  EXPECT_EQ(images[2].colour.at<cv::Vec3b>(0, 0), cv::Vec3b(2, 4, 50));
  const GroundTruth truth = source->ground_truth().value();
  ASSERT_EQ(truth.poses.size(), 2U);
  EXPECT_NEAR(truth.poses[0].timestamp, 1 / 30.0, 1e-12);
  EXPECT_EQ(truth.poses[0].world_from_cam.translation, Eigen::Vector3d(1, -2, 3));
  // A point on the camera's axis, mirrored, is where the mirrored pose puts it.
  const Pose given(Eigen::Quaterniond(0.8, 0, 0, 0.6), Eigen::Vector3d(1, 2, 3));
  Eigen::Vector3d there = given * Eigen::Vector3d(0.3, 0.2, 1);
  there.y() = -there.y();
  EXPECT_LT((truth.poses[1].world_from_cam * Eigen::Vector3d(0.3, -0.2, 1) - there).norm(), 1e-9);
  EXPECT_TRUE(any_with(source->notes(), "left-handed"));
}

TEST(Layouts, IclNuimNamesTheLineAtFault) {
  const TestFolder folder;
  folder.write("associations.txt", std::string("0 depth/0.png 0 rgb/0.png\n0 depth/1.png\n"));
  EXPECT_NE(
      message_of([&] { open_source(folder.path()); }).find("associations.txt:2: has 2 values instead of 4"),
      std::string::npos);
  folder.write("associations.txt", std::string("1 depth/0.png 1 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n"));
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("associations.txt:2: is not later"),
            std::string::npos);
}

TEST(Layouts, OpenLorisHasItsPosesOnTheBase) {
  const TestFolder folder;
  for (int i = 0; i < 2; ++i) {
    write_images(folder, fmt::format("color/{}.png", i), fmt::format("aligned_depth/{}.png", i), i, 1000);
  }
  folder.write("color.txt", std::string("10.0 color/0.png\n10.033 color/1.png\n"));
  folder.write("aligned_depth.txt", std::string("10.001 aligned_depth/0.png\n10.034 aligned_depth/1.png\n"));
  folder.write("sensors.yaml",
               std::string("%YAML:1.0\nd400_color_optical_frame:\n   fps: 30\n   width: 80\n"
                           "   height: 64\n   intrinsics: !!opencv-matrix\n      rows: 1\n"
                           "      cols: 4\n      dt: d\n      data: [ 61.1, 40.5, 61.2, 31.5 ]\n"));
  folder.write(
      "trans_matrix.yaml",
      std::string("%YAML:1.0\ntrans_matrix:\n   -\n      parent_frame: base_link\n"
                  "      child_frame: d400_color_optical_frame\n      matrix: !!opencv-matrix\n"
                  "         rows: 4\n         cols: 4\n         dt: d\n         data: [ 0, 0, 1, 0.2,\n"
                  "             -1, 0, 0, 0.1, 0, -1, 0, 0.9, 0, 0, 0, 1 ]\n"));
  folder.write("groundtruth.txt", std::string("#Time px py pz qx qy qz qw\n10 1 2 0 0 0 0 1\n"));
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "openloris");
  const Camera camera = source->cameras()->colour;
  EXPECT_EQ(camera.fx, 61.1);
  EXPECT_EQ(camera.fy, 61.2);
  EXPECT_EQ(camera.cx, 40.5);
  EXPECT_EQ(camera.depth_units_per_metre, 1000);
  EXPECT_EQ(read_all(*source).size(), 2U);
  const GroundTruth truth = source->ground_truth().value();
  EXPECT_LT((truth.poses.at(0).world_from_cam.translation - Eigen::Vector3d(1.2, 2.1, 0.9)).norm(), 1e-9);
  EXPECT_LT((truth.poses.at(0).world_from_cam.rotation * Eigen::Vector3d(0, 0, 1) - Eigen::Vector3d(1, 0, 0))
                .norm(),
            1e-6)
      << "the camera looks ahead";
  folder.write("sensors.yaml", std::string("%YAML:1.0\nfisheye:\n   width: 80\n"));
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("sensors.yaml: has no section d400_color"),
            std::string::npos);
}

TEST(Layouts, SevenScenes) {
  const TestFolder folder;
  cv::Mat colour(480, 640, CV_8UC3, cv::Scalar(1, 2, 3)), depth(480, 640, CV_16UC1, cv::Scalar(2000));
  depth(cv::Rect(0, 0, 320, 480)).setTo(65535);
  for (int i = 0; i < 2; ++i) {
    const std::string name = fmt::format("frame-{:06d}", i);
    folder.write(name + ".color.png", encode_png(colour));
    folder.write(name + ".depth.png", encode_png(depth));
  }
  folder.write("frame-000000.pose.txt", std::string(kIdentity));
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "7-scenes");
  ASSERT_TRUE(source->cameras()->depth);
  EXPECT_EQ(source->cameras()->depth->camera.fx, 585);
  EXPECT_EQ(source->cameras()->colour.fx, 525);
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_EQ(images[0].depth.at<std::uint16_t>(240, 330), 2000);
  EXPECT_EQ(images[0].depth.at<std::uint16_t>(240, 310), 0) << "65535 is missing depth";
  // 525 / 585 of the view of the colour camera has depth.
  EXPECT_EQ(images[0].depth.at<std::uint16_t>(240, 630), 0);
  EXPECT_EQ(images[0].depth.at<std::uint16_t>(240, 600), 2000);
  const GroundTruth truth = source->ground_truth().value();
  EXPECT_EQ(truth.rows, 2);
  EXPECT_EQ(truth.without_pose, 1);
  EXPECT_EQ(truth.poses.at(0).world_from_cam.translation, Eigen::Vector3d(0.5, -0.25, 2));
}

void write_scannet(const TestFolder& folder) {
  for (int i = 0; i < 2; ++i) {
    folder.write(fmt::format("color/{}.jpg", i),
                 encode_jpeg(cv::Mat(128, 160, CV_8UC3, cv::Scalar(10, 20, 30))));
    folder.write(fmt::format("depth/{}.png", i), encode_png(layout_depth(1500)));
  }
  folder.write("pose/0.txt", std::string(kIdentity));
  folder.write("pose/1.txt", std::string("-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
                                         "-inf -inf -inf -inf\n"));
  folder.write("intrinsic/intrinsic_color.txt",
               std::string("140 0 79.5 0\n0 140 63.5 0\n0 0 1 0\n0 0 0 1\n"));
  folder.write("intrinsic/intrinsic_depth.txt", std::string("70 0 39.5 0\n0 70 31.5 0\n0 0 1 0\n0 0 0 1\n"));
}

TEST(Layouts, ScanNetsFolderRegistersItsSmallDepth) {
  const TestFolder folder;
  write_scannet(folder);
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "scannet");
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 2U);
  ASSERT_EQ(images[0].depth.size(), cv::Size(160, 128));
  EXPECT_EQ(cv::countNonZero(images[0].depth(cv::Rect(2, 2, 156, 124)) != 1500), 0);
  const GroundTruth truth = source->ground_truth().value();
  EXPECT_EQ(truth.poses.size(), 1U);
  EXPECT_EQ(truth.without_pose, 1);
}

TEST(Layouts, Open3dAndRedwood) {
  const TestFolder folder;
  for (int i = 0; i < 3; ++i) {
    write_images(folder, fmt::format("s/rgb/{:07d}-{:012d}.png", i + 1, i * 33369),
                 fmt::format("s/depth/{:07d}-{:012d}.png", i + 1, i * 33369 + 900), i, 1000);
  }
  folder.write("s/intrinsic.json", std::string(R"({"width": 80, "height": 64,
      "intrinsic_matrix": [70, 0, 0, 0, 71, 0, 39.5, 31.5, 1]})"));
  folder.write("s/trajectory.log", "0 0 1\n" + std::string(kIdentity) + "1 1 2\n" + kIdentity);
  const auto source = open_source(folder / "s");
  EXPECT_EQ(source->kind(), "open3d");
  EXPECT_EQ(source->cameras()->colour.fy, 71);
  EXPECT_EQ(source->cameras()->colour.cx, 39.5);
  EXPECT_EQ(source->cameras()->colour.depth_units_per_metre, 1000);
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 3U);
  EXPECT_NEAR(images[2].timestamp, 0.066738, 1e-9);
  const GroundTruth truth = source->ground_truth().value();
  ASSERT_EQ(truth.poses.size(), 2U);
  EXPECT_NEAR(truth.poses[1].timestamp, 0.033369, 1e-9);
  EXPECT_TRUE(any_with(source->notes(), "read as microseconds"));
  folder.write("s/intrinsic.json", std::string(R"({"width": 80})"));
  EXPECT_NE(
      message_of([&] { open_source(folder / "s"); }).find("intrinsic.json: is no pinhole camera of Open3D"),
      std::string::npos);
}

TEST(Layouts, TwoFoldersOfNumberedImagesWillDo) {
  const TestFolder folder;
  for (int i = 8; i < 12; ++i) {
    write_images(folder, fmt::format("s/image/{}.png", i), fmt::format("s/depth/{}.png", i), i, 1000);
  }
  std::filesystem::remove(folder / "s/depth/9.png");
  SourceOptions options;
  EXPECT_FALSE(open_source(folder / "s")->cameras());
  folder.write("s/camera.yaml", format_camera(layout_camera()));
  options.rate = 10;
  const auto source = open_source(folder / "s", options);
  EXPECT_EQ(source->colour_without_depth(), 1);
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 3U);
  EXPECT_NEAR(images[0].timestamp, 0.8, 1e-12) << "8 comes before 10";
  EXPECT_NEAR(images[2].timestamp, 1.1, 1e-12);
  EXPECT_TRUE(any_with(source->notes(), "frame n is taken to be at n / 10 s"));
  for (int i : {8, 10, 11}) std::filesystem::remove(folder / fmt::format("s/depth/{}.png", i));
  EXPECT_NE(message_of([&] { open_source(folder / "s"); }).find("holds no depth images"), std::string::npos);
}

TEST(Layouts, StrayScannerWithUnpackedVideo) {
  const TestFolder folder;
  cv::Mat confidence(64, 80, CV_8UC1, cv::Scalar(2));
  confidence(cv::Rect(0, 0, 40, 64)).setTo(0);
  for (int i = 0; i < 2; ++i) {
    folder.write(fmt::format("depth/{:06d}.png", i), encode_png(layout_depth(1500)));
    folder.write(fmt::format("confidence/{:06d}.png", i), encode_png(confidence));
  }
  folder.write("camera_matrix.csv", std::string("280.0, 0.0, 159.5\n0.0, 280.0, 127.5\n0.0, 0.0, 1.0\n"));
  folder.write("odometry.csv", std::string("timestamp, frame, x, y, z, qx, qy, qz, qw\n"
                                           "5000.0, 000000, 0, 0, 0, 0, 0, 0, 1\n"
                                           "5000.0167, 000001, 0.1, 0, 0, 0, 0, 0, 1\n"));
  EXPECT_NE(message_of([&] { open_source(folder.path()); }).find("rgb.mp4: there is no such file"),
            std::string::npos);
  for (int i = 0; i < 2; ++i) {
    folder.write(fmt::format("rgb/{:06d}.jpg", i),
                 encode_jpeg(cv::Mat(256, 320, CV_8UC3, cv::Scalar(9, 9, 9))));
  }
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "stray-scanner");
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_NEAR(images[1].timestamp, 5000.0167, 1e-9);
  ASSERT_EQ(images[1].depth.size(), cv::Size(320, 256));
  EXPECT_EQ(cv::countNonZero(images[1].depth(cv::Rect(164, 4, 150, 248)) != 1500), 0);
  EXPECT_EQ(cv::countNonZero(images[1].depth(cv::Rect(0, 0, 156, 256))), 0) << "without confidence";
  EXPECT_NEAR(source->ground_truth()->poses.at(1).world_from_cam.translation.x(), 0.1, 1e-12);
}

TEST(Layouts, EurocStamps) {
  const TestFolder folder;
  const std::string t0 = "1403636579763555584", t1 = "1403636579813555456";
  write_images(folder, "mav0/cam0/data/" + t0 + ".png", "mav0/depth0/data/" + t0 + ".png", 0, 1000);
  write_images(folder, "mav0/cam0/data/" + t1 + ".png", "mav0/depth0/data/" + t1 + ".png", 1, 1000);
  folder.write("mav0/cam0/data.csv",
               "#timestamp [ns],filename\n" + t0 + "," + t0 + ".png\r\n" + t1 + "," + t1 + ".png\r\n");
  folder.write(
      "mav0/cam0/sensor.yaml",
      std::string(
          "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\n  data: [1, 0, 0, 0.1,\n   0, 1, 0, 0,\n"
          "   0, 0, 1, 0,\n   0, 0, 0, 1]\nrate_hz: 20\nresolution: [80, 64]\n"
          "camera_model: pinhole\nintrinsics: [70, 71, 40, 32]\n"
          "distortion_model: radial-tangential\ndistortion_coefficients: [-0.02, 0.01, 0.0001, 0]\n"));
  folder.write("mav0/state_groundtruth_estimate0/data.csv",
               "#timestamp, p_RS_R_x [m], ...\n" + t0 + ",1,2,3,1,0,0,0,0,0,0\n");
  const auto source = open_source(folder.path());
  EXPECT_EQ(source->kind(), "euroc");
  EXPECT_EQ(source->cameras()->colour.k1, -0.02);
  EXPECT_EQ(source->cameras()->colour.frames_per_second, 20);
  const auto images = read_all(*source);
  ASSERT_EQ(images.size(), 2U);
  EXPECT_NEAR(images[1].timestamp - images[0].timestamp, 0.05, 1e-6);
  EXPECT_NEAR(source->ground_truth()->poses.at(0).world_from_cam.translation.x(), 1.1, 1e-9);
}

}  // namespace
}  // namespace stdc
