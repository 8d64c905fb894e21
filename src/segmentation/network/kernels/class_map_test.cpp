#include "segmentation/network/kernels/class_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/random.hpp"

namespace stdc {
namespace {

/// By definition: every class upsampled as a whole, in double precision. Pixels that are decided by less than
/// `margin` come out as 128.
cv::Mat literal_map(const std::vector<float>& planes, cv::Size logits, cv::Size size,
                    const std::vector<bool>& dynamic, double margin) {
  cv::Mat mask(size, CV_8UC1);
  const auto at = [&](std::size_t k, int y, int x) {
    return static_cast<double>(
        planes[(k * static_cast<std::size_t>(logits.height) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(logits.width) +
               static_cast<std::size_t>(x)]);
  };
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double v = std::clamp((y + 0.5) * logits.height / size.height - 0.5, 0.0, logits.height - 1.0);
      const double u = std::clamp((x + 0.5) * logits.width / size.width - 0.5, 0.0, logits.width - 1.0);
      const int top = static_cast<int>(v), left = static_cast<int>(u);
      const int bottom = std::min(top + 1, logits.height - 1), right = std::min(left + 1, logits.width - 1);
      double best[2] = {-1e9, -1e9};  // of static and of dynamic classes
      for (std::size_t k = 0; k < dynamic.size(); ++k) {
        const double value =
            (1 - (v - top)) * ((1 - (u - left)) * at(k, top, left) + (u - left) * at(k, top, right)) +
            (v - top) * ((1 - (u - left)) * at(k, bottom, left) + (u - left) * at(k, bottom, right));
        best[dynamic[k] ? 1 : 0] = std::max(best[dynamic[k] ? 1 : 0], value);
      }
      const double lead = best[1] - best[0];
      mask.at<std::uint8_t>(y, x) = std::abs(lead) < margin ? 128 : lead > 0 ? 255 : 0;
    }
  }
  return mask;
}

void expect_literal(const std::vector<float>& planes, cv::Size logits, cv::Size size,
                    const std::vector<bool>& dynamic) {
  ClassMap map(logits, size, dynamic);
  const cv::Mat mask = map.draw({planes, static_cast<int>(dynamic.size()), logits.height, logits.width});
  const cv::Mat wanted = literal_map(planes, logits, size, dynamic, 1e-5);
  const cv::Mat wrong = (mask != wanted) & (wanted != 128);
  EXPECT_EQ(cv::countNonZero(wrong), 0) << size << " classes " << dynamic.size();
  EXPECT_EQ(cv::countNonZero((mask != 0) & (mask != 255)), 0);
}

TEST(ClassMap, EqualsItsDefinition) {
  Random random(4);
  for (const auto& dynamic : std::vector<std::vector<bool>>{
           {false, true}, {true, false}, {false, false, true, true, false}, {false, true, true}}) {
    for (const cv::Size logits : {cv::Size(12, 9), cv::Size(1, 1), cv::Size(1, 5), cv::Size(31, 2)}) {
      for (const cv::Size size : {cv::Size(120, 90), cv::Size(97, 41), cv::Size(12, 9), cv::Size(5, 3)}) {
        std::vector<float> planes(dynamic.size() * static_cast<std::size_t>(logits.area()));
        for (float& value : planes) value = static_cast<float>(random.uniform(-3, 3));
        expect_literal(planes, logits, size, dynamic);
      }
    }
  }
}

TEST(ClassMap, TheFirstClassWinsATie) {
  const std::vector<float> ties(2 * 6, 0.25F);
  const cv::Mat first = ClassMap({3, 2}, {30, 20}, {true, false}).draw({ties, 2, 2, 3});
  EXPECT_EQ(cv::countNonZero(first), 600);
  EXPECT_EQ(cv::countNonZero(ClassMap({3, 2}, {30, 20}, {false, true}).draw({ties, 2, 2, 3})), 0);
}

TEST(ClassMap, AllOrNoClassesMayBeDynamic) {
  const std::vector<float> planes{1, 2, 3, 4, 4, 3, 2, 1};
  EXPECT_EQ(cv::countNonZero(ClassMap({2, 2}, {8, 8}, {true, true}).draw({planes, 2, 2, 2})), 64);
  EXPECT_EQ(cv::countNonZero(ClassMap({2, 2}, {8, 8}, {false, false}).draw({planes, 2, 2, 2})), 0);
}

TEST(ClassMap, TellsEveryClass) {
  Random random(5);
  for (const auto& dynamic :
       std::vector<std::vector<bool>>{{false, true}, {true, false}, {false, true, false, true}}) {
    const std::size_t classes = dynamic.size();
    std::vector<float> planes(classes * 12 * 9);
    for (float& value : planes) value = static_cast<float>(random.uniform(-3, 3));
    ClassMap map({12, 9}, {97, 70}, dynamic);
    const Logits logits{planes, static_cast<int>(classes), 9, 12};
    const cv::Mat numbers = map.draw_classes(logits), mask = map.draw(logits);
    cv::Mat expected = cv::Mat::zeros(mask.size(), CV_8UC1);
    for (std::size_t k = 0; k < classes; ++k) {
      // Each class alone: as if it were the only dynamic one.
      std::vector<bool> alone(classes, false);
      alone[k] = true;
      const cv::Mat own = numbers == static_cast<double>(k);
      EXPECT_GT(cv::countNonZero(own), 0);
      EXPECT_LE(cv::countNonZero(own != ClassMap({12, 9}, {97, 70}, alone).draw(logits)), 2);
      if (dynamic[k]) expected |= own;
    }
    EXPECT_EQ(cv::countNonZero(expected != mask), 0);
  }
}

}  // namespace
}  // namespace stdc
