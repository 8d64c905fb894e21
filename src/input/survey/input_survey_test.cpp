#include "input/survey/input_survey.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/random.hpp"
#include "input/survey/depth_warnings.hpp"

namespace stdc {
namespace {

Camera camera_of() {
  Camera camera;
  camera.width = 640, camera.height = 480;
  camera.depth_units_per_metre = 1000;
  return camera;
}

/// Boxes before a wall, in colour and depth; the depth image may lie elsewhere.
class MadeUpImages final : public PackedImages {
 public:
  MadeUpImages(int seed, cv::Matx23d depth_from_colour) : seed_(seed), warp_(depth_from_colour) {}

  cv::Mat colour(cv::Size, ColourMode) const override { return draw(CV_8UC1, 120, 0); }
  cv::Mat depth(cv::Size) const override {
    cv::Mat depth = draw(CV_16UC1, 3000, 1), moved;
    cv::warpAffine(depth, moved, warp_, depth.size(), cv::INTER_NEAREST);
    return moved;
  }

 private:
  cv::Mat draw(int type, int background, int channel) const {
    cv::Mat image(480, 640, type, cv::Scalar(background));
    Random random(static_cast<std::uint64_t>(seed_));
    for (int i = 0; i < 14; ++i) {
      const int x = static_cast<int>(random.below(560)), y = static_cast<int>(random.below(400));
      const int w = 30 + static_cast<int>(random.below(90)), h = 30 + static_cast<int>(random.below(90));
      const int grey = static_cast<int>(random.below(256)), depth = 1000 + 100 * i;
      cv::rectangle(image, {x, y, w, h}, cv::Scalar(channel == 0 ? grey : 3000 - depth / 2), cv::FILLED);
    }
    return image;
  }

  int seed_;
  cv::Matx23d warp_;
};

/// Frames at given times.
class MadeUpSource final : public FrameSource {
 public:
  std::optional<SourceFrame> next() override {
    if (at_ == times.size()) return std::nullopt;
    SourceFrame frame;
    frame.timestamp = times[at_];
    frame.depth_timestamp = times[at_] + depth_offset;
    frame.images = std::make_shared<MadeUpImages>(static_cast<int>(at_) + 1, depth_from_colour);
    ++at_;
    return frame;
  }
  void rewind() override { at_ = 0; }
  std::optional<int> frame_count() const override { return static_cast<int>(times.size()); }
  std::optional<RgbdCameras> cameras() const override { return RgbdCameras{camera, {}}; }
  std::string kind() const override { return "made-up"; }
  std::string where() const override { return "nowhere"; }

  std::vector<double> times;
  double depth_offset = 0.001;
  cv::Matx23d depth_from_colour{1, 0, 0, 0, 1, 0};
  Camera camera = camera_of();

 private:
  std::size_t at_ = 0;
};

std::vector<double> regular(int frames) {
  std::vector<double> times;
  for (int i = 0; i < frames; ++i) times.push_back(10 + i / 30.0);
  return times;
}

std::vector<std::string> warnings_of(MadeUpSource& source) {
  return survey_warnings(survey_input(source, {}, 20, [](int) {}));
}

bool any_with(const std::vector<std::string>& lines, const std::string& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return line.find(part) != std::string::npos; });
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

TEST(InputSurvey, OfASoundRecordingHasNothingToWarnOf) {
  MadeUpSource source;
  source.times = regular(40);
  const InputSurvey survey = survey_input(source, {}, 20, [](int) {});
  EXPECT_EQ(survey.times.frames, 40);
  EXPECT_NEAR(survey.times.rate(), 30, 1e-6);
  EXPECT_NEAR(survey.times.depth_offset, 0.001, 1e-9);
  EXPECT_EQ(survey.images.sampled, 20);
  EXPECT_NEAR(survey.images.valid_share, 1, 1e-9);
  ASSERT_TRUE(survey.images.edges);
  EXPECT_LT(std::abs(survey.images.edges->x), 3);
  const auto warnings = survey_warnings(survey);
  EXPECT_TRUE(any_with(warnings, "the images are grey"));
  EXPECT_EQ(warnings.size(), 1U) << joined(warnings);
}

TEST(InputSurvey, SeesThatDepthIsMoved) {
  MadeUpSource source;
  source.times = regular(20);
  source.depth_from_colour = {1, 0, 11, 0, 1, 0};
  const auto warnings = warnings_of(source);
  EXPECT_TRUE(any_with(warnings, "pixels right of colour edges: not registered?")) << joined(warnings);
  source.rewind();
  source.depth_from_colour = {1, 0, 0, 0, 1, -14};
  EXPECT_TRUE(any_with(warnings_of(source), "14 pixels above colour edges")) << joined(warnings);
}

TEST(InputSurvey, SeesThatDepthHasAnotherFocalLength) {
  MadeUpSource source;
  source.times = regular(20);
  const double scale = 585.0 / 525;
  source.depth_from_colour = {scale, 0, 320 * (1 - scale), 0, scale, 240 * (1 - scale)};
  const auto warnings = warnings_of(source);
  EXPECT_TRUE(any_with(warnings, "has the depth camera another focal length")) << joined(warnings);
}

TEST(InputSurvey, SeesOddTimes) {
  MadeUpSource source;
  source.times = regular(40);
  source.times[20] = source.times[19];
  for (std::size_t i = 30; i < 40; ++i) source.times[i] += 1.5;
  source.depth_offset = 0.033;
  const auto warnings = warnings_of(source);
  EXPECT_TRUE(any_with(warnings, "1 gap, the longest of 1.53 s after 0.967 s")) << joined(warnings);
  EXPECT_TRUE(any_with(warnings, "1 frames are not later")) << joined(warnings);
  EXPECT_TRUE(any_with(warnings, "depth is always 33 ms later than colour")) << joined(warnings);
}

TEST(InputSurvey, TellsWhatIsLeftOfTheOffsetThatTheCameraFileKnows) {
  MadeUpSource source;
  source.times = regular(20);
  source.depth_offset = -0.015;
  RgbdCameras cameras{source.camera, {}};
  cameras.depth_time_offset = 0.013;
  const InputSurvey survey = survey_input(source, cameras, 5, [](int) {});
  EXPECT_NEAR(survey.times.depth_offset, -0.002, 1e-9);
  EXPECT_FALSE(any_with(survey_warnings(survey), "than colour")) << joined(survey_warnings(survey));
}

TEST(InputSurvey, SeesWrongUnitsAndCameras) {
  MadeUpSource source;
  source.times = regular(20);
  source.camera.depth_units_per_metre = 10000;
  source.camera.cx = 160;
  source.camera.frames_per_second = 15;
  const auto warnings = warnings_of(source);
  EXPECT_TRUE(any_with(warnings, "is depth_units_per_metre 10000 where the device writes 1000?"))
      << joined(warnings);
  EXPECT_TRUE(any_with(warnings, "25 % of the image off its middle")) << joined(warnings);
  EXPECT_TRUE(any_with(warnings, "the camera says frames_per_second 15")) << joined(warnings);
}

TEST(InputSurvey, SeesDepthsBeyondTheReachOfCameras) {
  // A room of 1.5 m in fifths of a millimetre, taken for millimetres.
  const auto look = [](double median, double far) { return depth_warnings({median, far, 0.9, 0}, 1000); };
  const auto warnings = look(7300, 19000);
  EXPECT_TRUE(any_with(warnings, "is depth_units_per_metre 1000 where the device writes"))
      << joined(warnings);
  EXPECT_TRUE(look(7300, 12000).empty()) << "a hall";
  EXPECT_TRUE(look(2000, 19000).empty()) << "a door stands open";
}

}  // namespace
}  // namespace stdc
