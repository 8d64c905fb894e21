// What layouts of folders keep in text: numbers, tables with commas, trajectory.log.
#include "input/layouts/number_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "input/layouts/csv_file.hpp"
#include "input/layouts/pose_files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const std::vector<double> numbers = stdc::parse_numbers(text, "input");
    if (numbers.size() >= 12) {
      const auto pose = stdc::pose_of_matrix(numbers.data());
      if (pose && !pose->is_finite()) std::abort();
    }
  } catch (const stdc::Error&) {
  }
  for (const stdc::CsvRow& row : stdc::parse_csv(text)) {
    if (row.cells.empty()) std::abort();
    try {
      if (stdc::begins_with_number(row)) stdc::number_in(row, 1, "input");
    } catch (const stdc::Error&) {
    }
  }
  const stdc::GroundTruth truth = stdc::parse_trajectory_log(text, {0.1, 0.2, 0.3});
  if (static_cast<int>(truth.poses.size()) + truth.left_out() != truth.rows) std::abort();
  return 0;
}
