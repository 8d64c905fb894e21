#include "input/layouts/tum_sequence.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "core/files/test_folder.hpp"
#include "input/camera_file.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

Camera small_camera() {
  Camera camera;
  camera.width = 80, camera.height = 64, camera.cx = 40, camera.cy = 32;
  return camera;
}

/// A sequence of `frames` images at 30 Hz, depth 5 ms later.
void write_sequence(const TestFolder& folder, int frames) {
  const Camera camera = small_camera();
  std::string rgb = "# colour\n", depth = "# depth\n";
  for (int i = 0; i < frames; ++i) {
    const std::string number = std::to_string(i);
    const cv::Mat colour(camera.height, camera.width, CV_8UC3, cv::Scalar(i, 2 * i, 50));
    const cv::Mat range(camera.height, camera.width, CV_16UC1, cv::Scalar(5000 + i));
    folder.write("rgb/" + number + ".png", encode_png(colour));
    folder.write("depth/" + number + ".png", encode_png(range));
    rgb += std::to_string(100 + i / 30.0) + " rgb/" + number + ".png\n";
    depth += std::to_string(100.005 + i / 30.0) + " depth/" + number + ".png\n";
  }
  folder.write("rgb.txt", rgb);
  folder.write("depth.txt", depth);
}

std::string open_message(const TestFolder& folder) {
  return message_of([&] { const TumSequence sequence(folder.path()); });
}

std::string load_message(const TestFolder& folder, std::size_t frame) {
  return message_of([&] { load_frame(TumSequence(folder.path()).frames().at(frame), small_camera()); });
}

TEST(TumSequence, PairsAndLoadsFrames) {
  const TestFolder folder;
  write_sequence(folder, 4);
  const TumSequence sequence(folder.path());
  ASSERT_EQ(sequence.frames().size(), 4U);
  EXPECT_EQ(sequence.colour_without_depth(), 0);
  EXPECT_FALSE(sequence.has_ground_truth());
  const RgbdImage image = load_frame(sequence.frames()[2], small_camera());
  EXPECT_NEAR(image.timestamp, 100 + 2 / 30.0, 1e-6);
  EXPECT_EQ(image.colour.at<cv::Vec3b>(3, 3), cv::Vec3b(2, 4, 50));
  EXPECT_EQ(image.depth.at<std::uint16_t>(3, 3), 5002);
  EXPECT_EQ(load_frame(sequence.frames()[2], small_camera(), ColourMode::grey).colour.type(), CV_8UC1);
}

TEST(TumSequence, CountsColourWithoutDepth) {
  const TestFolder folder;
  write_sequence(folder, 3);
  folder.write("depth.txt", std::string("100.001 depth/0.png\n100.04 depth/1.png\n"));
  const TumSequence sequence(folder.path());
  EXPECT_EQ(sequence.frames().size(), 2U);
  EXPECT_EQ(sequence.colour_without_depth(), 1);
}

TEST(TumSequence, NamesWhatIsWrongWithTheLists) {
  const TestFolder folder;
  EXPECT_NE(open_message(folder).find("rgb.txt: cannot be opened"), std::string::npos);
  write_sequence(folder, 2);
  folder.write("depth.txt", std::string("# none\n"));
  EXPECT_NE(open_message(folder).find("depth.txt: lists no images"), std::string::npos);
  folder.write("depth.txt", std::string("100 depth/0.png\n99 depth/1.png\n"));
  EXPECT_NE(open_message(folder).find("depth.txt:2: the timestamp 99.000000 is not later"),
            std::string::npos);
  folder.write("depth.txt", std::string("100 depth/0.png\nnan depth/1.png\n"));
  EXPECT_NE(open_message(folder).find("depth.txt:2: the timestamp 'nan'"), std::string::npos);
  folder.write("depth.txt", std::string("100\n"));
  EXPECT_NE(open_message(folder).find("depth.txt:1: has no file name"), std::string::npos);
  folder.write("depth.txt", std::string("200 depth/0.png\n"));
  EXPECT_NE(open_message(folder).find("no depth image lies within 20 ms"), std::string::npos);
  EXPECT_NE(open_message(folder).find("99.967 s away"), std::string::npos);
  EXPECT_NE(message_of([] { TumSequence("/no/such/folder"); }).find("there is no such folder"),
            std::string::npos);
  EXPECT_NE(message_of([&] { TumSequence(folder / "rgb.txt"); }).find("is not a folder"), std::string::npos);
}

TEST(TumSequence, FileNamesMayHoldBlanks) {
  const TestFolder folder;
  write_sequence(folder, 1);
  folder.write("rgb.txt", std::string("100   rgb/a b.png  \n"));
  EXPECT_EQ(TumSequence(folder.path()).frames()[0].colour, folder.path() / "rgb/a b.png");
}

TEST(LoadFrame, NamesTheImageAtFault) {
  const TestFolder folder;
  write_sequence(folder, 5);
  std::filesystem::remove(folder / "rgb/0.png");
  EXPECT_NE(load_message(folder, 0).find("rgb/0.png (rgb.txt:2): cannot be opened"), std::string::npos);
  std::filesystem::resize_file(folder / "depth/1.png", 100);
  EXPECT_NE(load_message(folder, 1).find("depth/1.png (depth.txt:3): the PNG ends too early"),
            std::string::npos);
  folder.write("depth/2.png", encode_png(cv::Mat(64, 80, CV_8UC1, cv::Scalar(1))));
  EXPECT_NE(load_message(folder, 2).find("one of 16 (grey) is needed"), std::string::npos);
  folder.write("rgb/3.png", encode_jpeg(cv::Mat(48, 64, CV_8UC3, cv::Scalar(1))));
  EXPECT_NE(load_message(folder, 3).find("is 64 x 48 pixels, but the camera has 80 x 64"), std::string::npos);
  folder.write("rgb/4.png", std::string());
  EXPECT_NE(load_message(folder, 4).find("the file is empty"), std::string::npos);
}

TEST(FindCamera, PrefersTheFileThenTheFolderThenTheName) {
  const TestFolder folder;
  const std::string name = "rgbd_dataset_freiburg2_x/";
  for (const char* list : {"rgb.txt", "depth.txt"}) folder.write(name + list, std::string("1 a.png\n"));
  const TumSequence sequence(folder / name);
  EXPECT_NEAR(find_camera(sequence, {}).fx, 520.908620, 1e-9);
  Camera camera = small_camera();
  camera.fx = 333;
  const auto file = folder.write("other.yaml", format_camera(camera));
  EXPECT_EQ(find_camera(sequence, file).fx, 333);
  camera.fx = 444;
  folder.write(name + "camera.yaml", format_camera(camera));
  EXPECT_EQ(find_camera(sequence, {}).fx, 444);
  EXPECT_EQ(find_camera(sequence, file).fx, 333);
  EXPECT_NE(message_of([&] { find_camera(sequence, folder / "none.yaml"); }).find("none.yaml: cannot be"),
            std::string::npos);
}

TEST(FindCamera, TheNameOfALinkCountsAsWellAsThatOfItsTarget) {
  const TestFolder folder;
  for (const char* list :
       {"plain/rgb.txt", "plain/depth.txt", "freiburg1_a/rgb.txt", "freiburg1_a/depth.txt"})
    folder.write(list, std::string("1 a.png\n"));
  std::filesystem::create_directory_symlink("plain", folder / "x_freiburg2");
  std::filesystem::create_directory_symlink("freiburg1_a", folder / "other");
  for (const char* name : {"x_freiburg2", "x_freiburg2/", "x_freiburg2/.", "plain/../x_freiburg2"})
    EXPECT_NEAR(find_camera(TumSequence(folder / name), {}).fx, 520.908620, 1e-9) << name;
  EXPECT_NEAR(find_camera(TumSequence(folder / "other"), {}).fx, 517.306408, 1e-9);
}

TEST(FindCamera, SaysHowToGiveOne) {
  const TestFolder folder;
  write_sequence(folder, 1);
  const TumSequence sequence(folder.path());
  EXPECT_NE(message_of([&] { find_camera(sequence, {}); }).find("--camera"), std::string::npos);
  EXPECT_NE(message_of([&] { find_camera(sequence, folder / "none.yaml"); }).find("none.yaml: cannot be"),
            std::string::npos);
}

TEST(TumSequence, ARateTakesTheOrderOfTheLinesForTheTime) {
  const TestFolder folder;
  folder.write("rgb.txt", std::string("0.033 b.png\n0.033 a.png\n0.033 c.png\n"));
  folder.write("depth.txt", std::string("0 d0.png\n0 d1.png\n0 d2.png\n"));
  const std::string message = message_of([&] { const TumSequence stamps(folder.path()); });
  EXPECT_NE(message.find("rgb.txt:2: the timestamp 0.033000 is not later"), std::string::npos) << message;
  EXPECT_NE(message.find("--rate HZ"), std::string::npos) << message;
  const TumSequence sequence(folder.path(), 20);
  ASSERT_EQ(sequence.frames().size(), 3U);
  EXPECT_EQ(sequence.frames()[1].colour.filename(), "a.png");
  EXPECT_EQ(sequence.frames()[1].depth.filename(), "d1.png");
  EXPECT_DOUBLE_EQ(sequence.frames()[2].timestamp, 0.1);
  folder.write("depth.txt", std::string("0 d0.png\n0 d1.png\n"));
  EXPECT_NE(message_of([&] {
              const TumSequence uneven(folder.path(), 20);
            }).find("depth.txt: lists 2 images and rgb.txt 3: with --rate line i of both is frame i"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
