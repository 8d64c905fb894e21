#include "input/survey/depth_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc {
namespace {

/// The unit that would make the depths plausible; nothing if they are.
std::optional<double> likelier_units(const DepthLook& look, double units) {
  constexpr double kNear = 0.35, kFar = 9, kUsual = 2;  // [m] of the median in rooms
  // [m] Half of what is seen far away and a good part of it beyond the reach of depth cameras.
  constexpr double kFarish = 4, kReach = 15;
  const double metres = look.median / units;
  const bool beyond_reach = metres > kFarish && look.far / units > kReach;
  if (metres > kNear && metres < kFar && !beyond_reach) return std::nullopt;
  constexpr std::array kUnits{1000.0, 5000.0, 4000.0, 10000.0, 256.0, 100.0};
  return *std::min_element(kUnits.begin(), kUnits.end(), [&](double a, double b) {
    const auto distance = [&](double u) { return std::abs(std::log(look.median / u / kUsual)); };
    return distance(a) < distance(b);
  });
}

}  // namespace

std::vector<std::string> depth_warnings(const DepthLook& look, std::optional<double> units_per_metre) {
  if (look.median <= 0) return {"the depth images are empty"};
  std::vector<std::string> lines;
  if (look.valid_share < 0.3) {
    lines.push_back(fmt::format("only {:.0f} % of the pixels have depth", 100 * look.valid_share));
  }
  if (look.saturated_share > 0.01) {
    lines.push_back(fmt::format("{:.0f} % of the depth pixels are 65535: does that mean 'no depth'?",
                                100 * look.saturated_share));
  }
  if (!units_per_metre) return lines;
  const double units = *units_per_metre;
  if (const auto likelier = likelier_units(look, units)) {
    lines.push_back(
        *likelier == units
            ? fmt::format("median depth is {:.2f} m: is depth_units_per_metre right?", look.median / units)
            : fmt::format(
                  "median depth is {:.2f} m: is depth_units_per_metre {:g} where the device writes {:g}?",
                  look.median / units, units, *likelier));
  }
  return lines;
}

}  // namespace stdc
