#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace stdc::app {

/// Quantiles of a list of times [ms]; zero if it is empty.
struct Quantiles {
  double median = 0, p95 = 0, p99 = 0;
};
/// The nearest-rank quantiles, so that each is a value that was measured.
Quantiles quantiles(std::vector<double> values);

nlohmann::ordered_json to_json(const Quantiles& quantiles);

}  // namespace stdc::app
