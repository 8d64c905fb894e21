#include "input/layouts/csv_file.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {
namespace {

std::string trimmed(std::string_view cell) {
  const auto words = split_words(cell);
  if (words.empty()) return "";
  return {words.front().data(), words.back().data() + words.back().size()};
}

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text) {
  std::vector<CsvRow> rows;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    CsvRow row{lines.number(), {}};
    for (std::size_t start = 0; start <= line.size();) {
      const std::size_t comma = std::min(line.find(',', start), line.size());
      row.cells.push_back(trimmed(line.substr(start, comma - start)));
      start = comma + 1;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<CsvRow> read_csv(const std::filesystem::path& path) {
  return parse_csv(read_file(path, "restore the file"));
}

bool begins_with_number(const CsvRow& row) { return parse_number(row.cells.front()).has_value(); }

double number_in(const CsvRow& row, std::size_t cell, const std::filesystem::path& path) {
  const auto number = cell < row.cells.size() ? parse_number(row.cells[cell]) : std::nullopt;
  if (number) return *number;
  throw Error(fmt::format("{}:{}", path.string(), row.line),
              fmt::format("has no number in column {}", cell + 1), "restore the file");
}

}  // namespace stdc
