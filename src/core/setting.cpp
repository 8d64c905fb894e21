#include "core/setting.hpp"

#include <fmt/format.h>

namespace stdc::setting_detail {

void check_range(std::string_view section, const Setting& setting, double value) {
  if (value >= setting.min && value <= setting.max) return;
  throw Error(fmt::format("{}.{}", section, setting.name),
              fmt::format("{} is outside {}..{}", value, setting.min, setting.max),
              fmt::format("give a value in that range ({})", setting.description));
}

}  // namespace stdc::setting_detail
