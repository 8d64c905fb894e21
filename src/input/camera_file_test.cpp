#include "input/camera_file.hpp"

#include <gtest/gtest.h>

#include "core/files/test_folder.hpp"
#include "input/tum_calibration.hpp"

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

const std::string kMinimal = "width: 640\nheight: 480\nfx: 500\nfy: 501\ncx: 320\ncy: 240\n";

std::string message(const std::string& text) {
  return message_of([&] { parse_camera(text, "c.yaml"); });
}

TEST(CameraFile, HasDefaultsForTheRest) {
  const Camera camera = parse_camera(kMinimal, "c.yaml");
  EXPECT_EQ(camera.fy, 501);
  EXPECT_FALSE(camera.has_distortion());
  EXPECT_EQ(camera.depth_units_per_metre, 5000);
  EXPECT_EQ(camera.frames_per_second, 30);
}

TEST(CameraFile, ReadsWhatItWrites) {
  for (const char* name : {"rgbd_dataset_freiburg1_xyz", "freiburg2_desk", "x_freiburg3_y"}) {
    Camera camera = *tum_calibration(name);
    camera.frames_per_second = 29.97;
    const std::string text = format_camera(camera);
    EXPECT_EQ(format_camera(parse_camera(text, "c.yaml")), text);
    const Camera again = parse_camera(text, "c.yaml");
    EXPECT_EQ(again.k3, camera.k3);
    EXPECT_EQ(again.fx, camera.fx);
    EXPECT_EQ(again.frames_per_second, 29.97);
  }
}

TEST(CameraFile, KnowsTheTumCameras) {
  EXPECT_NEAR(tum_calibration("rgbd_dataset_freiburg1_xyz")->fx, 517.306408, 1e-9);
  EXPECT_NEAR(tum_calibration("rgbd_dataset_freiburg2_desk")->k3, 0.917205, 1e-9);
  EXPECT_FALSE(tum_calibration("rgbd_dataset_freiburg3_walking_xyz")->has_distortion());
  EXPECT_FALSE(tum_calibration("kitchen"));
}

TEST(CameraFile, NamesTheLineAtFault) {
  EXPECT_NE(message(kMinimal + "focal: 3\n").find("c.yaml:7: unknown key 'focal'; give width"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "\n\nk1: abc\n").find("c.yaml:9: k1 is not a finite number"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "k1: .nan\n").find("c.yaml:7: k1"), std::string::npos);
  EXPECT_NE(message(kMinimal + "k1: nan\n").find("c.yaml:7: k1"), std::string::npos);
  EXPECT_NE(message(kMinimal + "k1: [1, 2]\n").find("c.yaml:7: k1"), std::string::npos);
  EXPECT_NE(message(kMinimal + "fx: 3\n").find("c.yaml:7: fx is given twice"), std::string::npos);
  EXPECT_NE(message(kMinimal + "k1: {\n").find("is not YAML"), std::string::npos);
  EXPECT_NE(message("width: 640\n").find("c.yaml: height is missing"), std::string::npos);
  EXPECT_NE(message("width: 640.5\n").find("c.yaml:1: width is not a whole number"), std::string::npos);
  EXPECT_NE(message("width: 1e300\n").find("c.yaml:1: width"), std::string::npos);
  EXPECT_NE(message(kMinimal + "depth_units_per_metre: 0\n").find("c.yaml: depth_units_per_metre"),
            std::string::npos);
  EXPECT_NE(message("").find("c.yaml: holds no"), std::string::npos);
  EXPECT_NE(message("- a\n- b\n").find("c.yaml: holds no"), std::string::npos);
  EXPECT_NE(message(std::string(100000, ' ')).find("too large"), std::string::npos);
}

TEST(CameraFile, KnowsTheLensModels) {
  const std::string five = "k1: 0.1\nk2: -0.2\np1: 0.001\np2: 0.002\nk3: 0.1\n";
  EXPECT_STREQ(parse_camera(kMinimal, "c.yaml").lens_name(), "pinhole");
  EXPECT_STREQ(parse_camera(kMinimal + five, "c.yaml").lens_name(), "radial-tangential");
  const Camera rational = parse_camera(kMinimal + five + "k4: 0.11\nk5: 0.02\nk6: 0.03\n", "c.yaml");
  EXPECT_STREQ(rational.lens_name(), "rational");
  EXPECT_EQ(rational.k5, 0.02);
  const Camera fisheye =
      parse_camera(kMinimal + "lens: equidistant\nk1: 0.1\nk2: 0.01\nk3: 0.001\nk4: 0.002\n", "c.yaml");
  EXPECT_EQ(fisheye.lens, LensModel::equidistant);
  EXPECT_EQ(fisheye.k4, 0.002);
  EXPECT_EQ(parse_camera(kMinimal + "lens: equidistant\n", "c.yaml").lens, LensModel::equidistant);
  EXPECT_EQ(parse_camera(kMinimal + "rotation: 270\n", "c.yaml").rotation, 270);
  for (const Camera& camera : {rational, fisheye}) {
    EXPECT_EQ(parse_camera(format_camera(camera), "c.yaml"), camera) << format_camera(camera);
  }
}

TEST(CameraFile, RefusesWhatDoesNotBelongToTheLens) {
  EXPECT_NE(message(kMinimal + "lens: round\n").find("c.yaml:7: unknown lens 'round'; give pinhole, radial"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "lens: [1]\n").find("c.yaml:7: unknown lens"), std::string::npos);
  EXPECT_NE(message(kMinimal + "lens: pinhole\nlens: rational\n").find("lens is given twice"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "lens: equidistant\np1: 0.1\n")
                .find("c.yaml:8: a lens of the kind equidistant has no p1; leave it out"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "k6: 0.1\nlens: radial-tangential\n").find("c.yaml:7: a lens"),
            std::string::npos);
  EXPECT_EQ(message(kMinimal + "lens: pinhole\nk1: 0\n"), "");
  EXPECT_NE(message(kMinimal + "k1: 0.1\nk4: 0.1\n").find("c.yaml:8: k4 without k5 and k6 may mean two"),
            std::string::npos);
  EXPECT_NE(message(kMinimal + "rotation: 45\n").find("c.yaml: rotation is none of"), std::string::npos);
  EXPECT_NE(message(kMinimal + "k1: -0.8\n").find("c.yaml: the lens distortion folds back at pixel ("),
            std::string::npos);
}

TEST(CameraFile, MayHaveADepthCamera) {
  const std::string depth =
      "depth_camera:\n  width: 848\n  height: 480\n  fx: 424\n  fy: 424\n  cx: 423.5\n  cy: 239.5\n"
      "  translation: [0.015, 0, 0.001]\n  quaternion: [0, 0.01, 0, 1]\n";
  const RgbdCameras cameras = parse_cameras(kMinimal + "depth_units_per_metre: 1000\n" + depth, "c.yaml");
  ASSERT_TRUE(cameras.depth);
  EXPECT_EQ(cameras.depth->camera.width, 848);
  EXPECT_EQ(cameras.depth->camera.depth_units_per_metre, 1000);
  EXPECT_EQ(cameras.depth->colour_from_depth.translation, Eigen::Vector3d(0.015, 0, 0.001));
  EXPECT_NEAR(cameras.depth->colour_from_depth.rotation.norm(), 1, 1e-12);
  const RgbdCameras again = parse_cameras(format_cameras(cameras), "c.yaml");
  EXPECT_EQ(again.colour, cameras.colour);
  EXPECT_EQ(again.depth->camera, cameras.depth->camera);
  EXPECT_FALSE(parse_cameras(kMinimal, "c.yaml").depth);
  EXPECT_NE(message(kMinimal + depth).find("c.yaml:7: depth_camera is of no use here"), std::string::npos);
}

TEST(CameraFile, MayHaveATimeOffsetOfDepth) {
  const RgbdCameras cameras = parse_cameras(kMinimal + "depth_time_offset: -0.0415\n", "c.yaml");
  EXPECT_EQ(cameras.depth_time_offset, -0.0415);
  EXPECT_EQ(parse_cameras(format_cameras(cameras), "c.yaml").depth_time_offset, -0.0415);
  const auto fault = [](const std::string& line) {
    return test::message_of([&] { parse_cameras(kMinimal + line, "c.yaml"); });
  };
  EXPECT_NE(
      fault("depth_time_offset: 40\n").find("c.yaml:7: depth_time_offset is not a number between -1 and 1"),
      std::string::npos);
  EXPECT_NE(fault("depth_time_offset: [0]\n").find("is not a number"), std::string::npos);
  EXPECT_NE(
      message(kMinimal + "depth_time_offset: 0.1\n").find("c.yaml:7: depth_time_offset is of no use here"),
      std::string::npos);
}

TEST(CameraFile, NamesTheLineAtFaultOfADepthCamera) {
  const auto fault = [](const std::string& more) {
    return message_of([&] {
      parse_cameras(
          kMinimal + "depth_camera:\n  width: 848\n  height: 480\n  fx: 424\n  fy: 424\n  cx: 423\n" + more,
          "c.yaml");
    });
  };
  EXPECT_NE(fault("").find("c.yaml (depth_camera): cy is missing"), std::string::npos);
  EXPECT_NE(fault("  cy: 240\n  translation: [15, 0, 0]\n")
                .find("the cameras lie 15 m apart; give the translation in"),
            std::string::npos);
  EXPECT_NE(
      fault("  cy: 240\n  translation: [1, 0]\n").find("(depth_camera):14: translation is not a list of 3"),
      std::string::npos);
  EXPECT_NE(fault("  cy: 240\n  quaternion: [0, 0, 0, 0]\n").find("the quaternion has length 0"),
            std::string::npos);
  EXPECT_NE(fault("  cy: 240\n  rotation: 90\n").find("c.yaml:14: rotation does not belong to depth_camera"),
            std::string::npos);
  EXPECT_NE(fault("  cy: 240\n  shift: 90\n").find("(depth_camera):14: unknown key 'shift'"),
            std::string::npos);
}

TEST(CameraFile, NamesAMissingFile) {
  const TestFolder folder;
  EXPECT_NE(message_of([&] { read_camera(folder / "none.yaml"); }).find("none.yaml: cannot be opened"),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
