#include "segmentation/network/network_segmenter.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cfenv>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/error.hpp"
#include "core/files/test_folder.hpp"
#include "core/random.hpp"
#include "segmentation/network/kernels/dnnl_convolution.hpp"
#include "segmentation/network/test_random_weights.hpp"
#include "segmentation/network/thread_state_guard.hpp"
#include "segmentation/network/weights_segmenter.hpp"

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace stdc {
namespace {

using test::message_of;
using test::TestFolder;

const std::filesystem::path kWeights = std::filesystem::path(STDC_TEST_DATA) / "tiny.safetensors";

cv::Mat blots(cv::Size size) {
  Random random(9);
  cv::Mat image(size, CV_8UC3, cv::Scalar(90, 120, 100));
  for (int i = 0; i < 40; ++i) {
    const cv::Point centre(static_cast<int>(random.below(static_cast<std::uint32_t>(size.width))),
                           static_cast<int>(random.below(static_cast<std::uint32_t>(size.height))));
    cv::circle(image, centre, 5 + static_cast<int>(random.below(40)),
               cv::Scalar(random.below(256), random.below(256), random.below(256)), cv::FILLED);
  }
  return image;
}

bool is_mask(const cv::Mat& mask, cv::Size size) {
  return mask.size() == size && mask.type() == CV_8UC1 && cv::countNonZero((mask != 0) & (mask != 255)) == 0;
}

/// Share of pixels that differ.
double difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a != b) / static_cast<double>(a.total());
}

TEST(NetworkSegmenter, MasksHaveTheSizeOfTheImage) {
  for (const auto precision : {NetworkPrecision::fp32, NetworkPrecision::int8}) {
    NetworkSegmenter segmenter(kWeights, {precision, 1, 96, 64});
    for (const cv::Size size : {cv::Size(640, 480), cv::Size(96, 64), cv::Size(33, 21), cv::Size(640, 480)}) {
      const cv::Mat image = blots(size), before = image.clone();
      const cv::Mat mask = segmenter.segment({image, 0, 0});
      EXPECT_TRUE(is_mask(mask, size));
      EXPECT_EQ(cv::norm(image, before, cv::NORM_L1), 0);
      EXPECT_EQ(difference(mask, segmenter.segment({image, 1, 1})), 0);
    }
    cv::Mat grey;
    cv::cvtColor(blots({320, 240}), grey, cv::COLOR_BGR2GRAY);
    EXPECT_TRUE(is_mask(segmenter.segment({grey, 0, 0}), grey.size()));
  }
}

TEST(NetworkSegmenter, Int8AgreesWithFp32) {
  NetworkSegmenter exact(kWeights, {NetworkPrecision::fp32, 1, 320, 224});
  NetworkSegmenter quick(kWeights, {NetworkPrecision::int8, 1, 320, 224});
  const cv::Mat image = blots({640, 480});
  const cv::Mat mask = exact.segment({image, 0, 0});
  EXPECT_GT(cv::countNonZero(mask), 0);
  EXPECT_LT(cv::countNonZero(mask), 640 * 480);
  // The weights are random: wherever one looks, the classes are nearly even.
  EXPECT_LT(difference(mask, quick.segment({image, 0, 0})), 0.12);
}

TEST(NetworkSegmenter, TellsClassesAndProbabilities) {
  test::RandomWeights weights(false, {{4, 8}, {16, 16, 32}, 8, 16, 4, 8, 4});
  NetworkWeights network = weights.read();
  network.choose_dynamic(std::vector<std::string>{"c1", "c3"});
  NetworkSegmenter segmenter(network, {NetworkPrecision::fp32, 1, 96, 64});
  const cv::Mat image = blots({320, 240});
  const SegmentedPixels pixels = segmenter.segment_pixels({image, 0, 0}, {true, true});
  EXPECT_EQ(difference(pixels.mask, segmenter.segment({image, 0, 0})), 0);
  EXPECT_EQ(difference(pixels.mask, (pixels.classes == 1) | (pixels.classes == 3)), 0);
  EXPECT_EQ(pixels.probability.type(), CV_32FC1);
  EXPECT_EQ(pixels.probability.size(), image.size());
  EXPECT_TRUE(cv::checkRange(pixels.probability, true, nullptr, 0, 1.0001));
  EXPECT_EQ(segmenter.classes(), (std::vector<std::string>{"c0", "c1", "c2", "c3"}));
  EXPECT_TRUE(segmenter.segment_pixels({image, 0, 0}, {}).classes.empty());
}

/// How this thread rounds and what it makes of denormal numbers.
unsigned control_of_floats() {
#if defined(__SSE2__)
  return _mm_getcsr() & ~63U;  // the lowest bits tell what has happened
#elif defined(__aarch64__)
  std::uint64_t control = 0;
  __asm__ volatile("mrs %0, fpcr" : "=r"(control));
  return static_cast<unsigned>(control);
#else
  return static_cast<unsigned>(std::fegetround());
#endif
}

TEST(NetworkSegmenter, WorksInAnyThreadAndKeepsItsState) {
  NetworkSegmenter segmenter(kWeights, {NetworkPrecision::fp32, 1, 96, 64});
  const cv::Mat image = blots({320, 240});
  const unsigned control = control_of_floats();
  const cv::Mat mask = segmenter.segment({image, 0, 0});
  EXPECT_EQ(control_of_floats(), control);
  cv::Mat other;
  std::thread([&] { other = segmenter.segment({image, 0, 0}); }).join();
  EXPECT_EQ(difference(mask, other), 0);
}

TEST(NetworkSegmenter, RefusesWhatItCannotTake) {
  EXPECT_NE(message_of([] {
              NetworkSegmenter(kWeights, {NetworkPrecision::fp32, 1, 100, 64});
            }).find("multiples of 32"),
            std::string::npos);
  EXPECT_NE(
      message_of([] { NetworkSegmenter("none.safetensors", {}); }).find("none.safetensors: cannot be opened"),
      std::string::npos);
  NetworkSegmenter segmenter(kWeights, {NetworkPrecision::fp32, 1, 96, 64});
  EXPECT_THROW(segmenter.segment({cv::Mat(), 0, 0}), Error);
  EXPECT_THROW(segmenter.segment({cv::Mat(5, 5, CV_16UC1), 0, 0}), Error);
}

TEST(NetworkSegmenter, TellsWhatComputes) {
  const NetworkSegmenter segmenter(kWeights, {NetworkPrecision::int8, 1, 96, 64});
  EXPECT_EQ(segmenter.description().rfind("STDC1-Seg, int8, 96x64, " + DnnlEngine::description(), 0), 0U)
      << segmenter.description();
  EXPECT_EQ(segmenter.description().find("checksum"), std::string::npos);
  const NetworkSegmenter unchecked(test::RandomWeights(false, {{4, 8}, {16, 16, 32}, 8, 16, 4, 8, 2}).read(),
                                   {NetworkPrecision::fp32, 1, 96, 64});
  EXPECT_NE(unchecked.description().find("weights without a checksum"), std::string::npos);
}

TEST(ThreadStateGuard, FlushesDenormalsWhileItLives) {
  volatile float tiny = 1e-39F;
  {
    const ThreadStateGuard scope(1);
    EXPECT_EQ(tiny * 1.0F, 0);
  }
  EXPECT_NE(tiny * 1.0F, 0);
}

TEST(ThreadStateGuard, SpinningThreadsAreRefused) {
  unsetenv("OMP_WAIT_POLICY");
  unsetenv("GOMP_SPINCOUNT");
  EXPECT_NO_THROW(ThreadStateGuard::check(1));
  EXPECT_NE(message_of([] { ThreadStateGuard::check(2); }).find("OMP_WAIT_POLICY=PASSIVE"),
            std::string::npos);
  setenv("OMP_WAIT_POLICY", "PASSIVE", 1);
  EXPECT_NO_THROW(ThreadStateGuard::check(2));
  NetworkSegmenter one(kWeights, {NetworkPrecision::fp32, 1, 96, 64}),
      two(kWeights, {NetworkPrecision::fp32, 2, 96, 64});
  const cv::Mat image = blots({96, 64});
  EXPECT_LT(difference(one.segment({image, 0, 0}), two.segment({image, 0, 0})), 0.01);
  unsetenv("OMP_WAIT_POLICY");
}

TEST(FindNetworkWeights, LooksInTheNamedFolderFirst) {
  const TestFolder folder;
  folder.write("stdc1-person-slim.safetensors", std::string("x"));
  setenv("STDC_SLAM_MODELS", folder.path().c_str(), 1);
  EXPECT_EQ(find_network_weights(), folder / "stdc1-person-slim.safetensors");
  EXPECT_NE(message_of([] { make_weights_segmenter("", {}); }).find("too short"), std::string::npos);
  EXPECT_NE(message_of([] {
              make_weights_segmenter("tiny", {});
            }).find("stdc1-person-tiny.safetensors: the network's weights were not found"),
            std::string::npos);
  folder.write("stdc1-person-tiny.safetensors", std::string("x"));
  EXPECT_EQ(find_network_weights("tiny"), folder / "stdc1-person-tiny.safetensors");
  EXPECT_NE(message_of([] { make_weights_segmenter("tiny", {}); }).find("too short"), std::string::npos);
  unsetenv("STDC_SLAM_MODELS");
}

TEST(WeightsSegmenter, ChoosesByExtension) {
  NetworkSettings settings;
  settings.input_width = 96, settings.input_height = 64;
  EXPECT_NE(dynamic_cast<NetworkSegmenter*>(make_weights_segmenter(kWeights, settings).get()), nullptr);
  EXPECT_NE(message_of([&] { make_weights_segmenter("none.onnx", settings); }).find("none.onnx: "),
            std::string::npos);
}

}  // namespace
}  // namespace stdc
