#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <vector>

namespace stdc::app {

/// Which of several values stands for them where a series is too long for a page.
enum class Pick { first, largest, smallest };

/// So many points of a series are shown at most.
constexpr int kMaxPoints = 2000;

/// Of times in seconds.
constexpr int kTimeDecimals = 4;

/// How many values each of at most kMaxPoints points has to stand for.
int values_per_point(std::size_t count);

/// A number that is short in JSON.
double rounded(double value, int decimals);

/// A list of numbers, null where there is none; null if there is none at all.
/// @param every  so many values become one
nlohmann::ordered_json column(std::span<const std::optional<double>> values, int every, Pick pick,
                              int decimals);

/// How often which value came: {"start", "step", "counts", "more"}; "more": the last one counts all above,
/// too. Null without values. Steps are 1, 2 or 5 times a power of ten; what lies far above nearly all the
/// others is put into the last one.
nlohmann::ordered_json histogram(std::vector<double> values);

/// The quantiles 0, 1, .. 100 %, each a value that came; null without values.
nlohmann::ordered_json percentiles(std::vector<double> values, int decimals);

}  // namespace stdc::app
