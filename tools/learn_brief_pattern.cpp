// Learns the pattern of the descriptor from synthetic pictures and prints it as C++; fixed seeds, no input.
//
//     build/release/learn_brief_pattern > src/features/brief_pattern.cpp
#include <fmt/format.h>

#include <vector>

#include "dead_leaves.hpp"
#include "pattern_learning.hpp"

namespace {

constexpr std::uint64_t kImages = 14;  // of 1000 keypoints each
constexpr int kTests = 40000;          // to choose from
// Of 2, 4, 6 and 8 px: less makes descriptors of the same point differ more, more makes those of others more
// alike.
constexpr double kNearest = 4;
constexpr std::uint64_t kSeed = 100;

std::vector<cv::Mat> pictures() {
  std::vector<cv::Mat> images;
  images.reserve(kImages);
  for (std::uint64_t i = 0; i < kImages; ++i) {
    images.push_back(stdc::dead_leaves({640, 480}, kSeed + i));
  }
  return images;
}

void print(const stdc::BriefPattern& pattern) {
  fmt::print(R"(// Made by tools/learn_brief_pattern.cpp; do not edit.
#include "features/description/brief.hpp"

namespace stdc {{
namespace {{

// clang-format off
constexpr BriefPattern kPattern{{{{
)");
  constexpr std::size_t kPerLine = 4;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const stdc::BriefTest& t = pattern[i];
    fmt::print("{}{{{:3}, {:3}, {:3}, {:3}}},{}", i % kPerLine == 0 ? "    " : " ", t.x0, t.y0, t.x1, t.y1,
               i % kPerLine == kPerLine - 1 ? "\n" : "");
  }
  fmt::print(R"(}}}};
// clang-format on

}}  // namespace

const BriefPattern& brief_pattern() {{ return kPattern; }}

}}  // namespace stdc
)");
}

}  // namespace

int main() {
  print(stdc::learn_pattern(stdc::evaluate_random_tests(pictures(), kTests, kNearest, kSeed)));
  return 0;
}
