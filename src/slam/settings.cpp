#include "slam/settings.hpp"

#include "core/error.hpp"

namespace stdc {

void Settings::validate() const {
  for_each_section(*this, [](const char* section, const auto& settings) { check_ranges(section, settings); });
  features.validate();
  refinement.validate();
}

}  // namespace stdc
