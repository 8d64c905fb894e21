#include "core/random.hpp"
#include "features/brief.hpp"
#include "features/orientation.hpp"

namespace stdc {
namespace {

// Calonder et al., BRIEF, ECCV 2010, method GII: both pixels normal about the centre.
BriefPattern draw_pattern() {
  constexpr std::uint64_t kSeed = 2023;
  constexpr double kSigma = 0.6 * kBriefRadius;
  Random random(kSeed);
  const auto draw = [&](std::int8_t& x, std::int8_t& y) {
    double u = 0, v = 0;
    do {
      u = std::round(kSigma * random.normal());
      v = std::round(kSigma * random.normal());
    } while (u * u + v * v > kBriefRadius * kBriefRadius);
    x = static_cast<std::int8_t>(u);
    y = static_cast<std::int8_t>(v);
  };
  BriefPattern pattern;
  for (BriefTest& test : pattern) {
    do {
      draw(test.x0, test.y0);
      draw(test.x1, test.y1);
    } while (test.x0 == test.x1 && test.y0 == test.y1);
  }
  return pattern;
}

}  // namespace

const BriefPattern& brief_pattern() {
  static const BriefPattern pattern = draw_pattern();
  return pattern;
}

}  // namespace stdc
