#include "input/survey/depth_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stdc {
namespace {

/// The unit that would make the median depth plausible; nothing if it is.
std::optional<double> likelier_units(double median_units, double units) {
  constexpr double kNear = 0.35, kFar = 9, kUsual = 2;  // [m] in rooms
  const double metres = median_units / units;
  if (metres > kNear && metres < kFar) return std::nullopt;
  constexpr std::array kUnits{1000.0, 5000.0, 4000.0, 10000.0, 256.0, 100.0};
  return *std::min_element(kUnits.begin(), kUnits.end(), [&](double a, double b) {
    const auto distance = [&](double u) { return std::abs(std::log(median_units / u / kUsual)); };
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
  if (const auto likelier = likelier_units(look.median, units)) {
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
