#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stdc::app {

/// Quantiles of a list of values; nothing if it is empty.
struct Quantiles {
  std::optional<double> median, p95, p99;
};
/// The nearest-rank quantiles, so that each is a value that was measured.
Quantiles quantiles(std::vector<double> values);

/// Null where there is nothing.
nlohmann::ordered_json to_json(const Quantiles& quantiles);
nlohmann::ordered_json to_json(const std::optional<double>& value);

/// "-" where there is nothing.
std::string to_text(const std::optional<double>& value, int decimals, double factor = 1);

}  // namespace stdc::app
