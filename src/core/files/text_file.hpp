#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stdc {

/// The bytes of a file. Throws Error naming it if it is missing, a folder, unreadable or larger than
/// `max_bytes`; `hint` says what the user can do about a missing one.
std::string read_file(const std::filesystem::path& path, const std::string& hint,
                      std::size_t max_bytes = std::size_t{1} << 30U);

/// Goes through the lines of a text that say something: blank ones and those that start with '#' are left
/// out, white space at both ends and a byte order mark are dropped.
class LineReader {
 public:
  explicit LineReader(std::string_view text);
  /// False at the end of the text.
  bool next(std::string_view& line);
  /// Number of the line that next() gave, from 1.
  int number() const { return number_; }

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// The words of a line, split at blanks and tabs.
std::vector<std::string_view> split_words(std::string_view line);
/// A whole word as a number in C notation, whatever the locale; nothing if any of it is something else.
/// "nan" and "inf" are numbers here.
std::optional<double> parse_number(std::string_view word);

/// A time in seconds. Throws Error with `where` (file:line) for what is not a finite number or too large to
/// be seconds: milli- and nanoseconds are a common slip.
double parse_timestamp(std::string_view word, const std::string& where);

/// A word fit for a message: shortened, with what does not print replaced.
std::string shown(std::string_view word);

}  // namespace stdc
