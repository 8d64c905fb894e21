#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stdc {

/// A row of a table: its cells, without the blanks around them.
struct CsvRow {
  int line = 0;  ///< from 1
  std::vector<std::string> cells;
};

/// The rows of a table with commas; lines that start with '#' are left out. Throws Error if it cannot be
/// read.
std::vector<CsvRow> read_csv(const std::filesystem::path& path);
std::vector<CsvRow> parse_csv(std::string_view text);

/// Whether a row begins with a number: what comes first in many files is a line of names.
bool begins_with_number(const CsvRow& row);
/// The number in a cell. Throws Error naming `path` and line if there is none.
double number_in(const CsvRow& row, std::size_t cell, const std::filesystem::path& path);

}  // namespace stdc
