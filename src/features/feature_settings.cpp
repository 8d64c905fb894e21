#include "features/feature_settings.hpp"

#include <fmt/format.h>

namespace stdc {

void FeatureSettings::validate() const {
  check_ranges("features", *this);
  if (threshold_low > threshold_high) {
    throw Error("features.threshold_low",
                fmt::format("{} is above threshold_high = {}", threshold_low, threshold_high),
                "give a low threshold that is not above the high one");
  }
}

}  // namespace stdc
