#include "core/files/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "core/error.hpp"

namespace stdc {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string read_file(const std::filesystem::path& path, const std::string& hint, std::size_t max_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw Error(path.string(), "is a folder, not a file", hint);
  }
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(path.string(), fmt::format("cannot be opened ({})", std::strerror(errno)), hint);
  const auto size = std::filesystem::file_size(path, ignored);
  std::string bytes;
  // The size is a hint only: pipes have none, and a file may be growing.
  std::size_t capacity = !ignored && size < max_bytes ? static_cast<std::size_t>(size) + 1 : 1U << 16U;
  while (true) {
    const std::size_t used = bytes.size();
    bytes.resize(used + capacity);
    const std::size_t got = std::fread(bytes.data() + used, 1, capacity, file.get());
    bytes.resize(used + got);
    if (bytes.size() > max_bytes) {
      throw Error(path.string(), fmt::format("is larger than {} bytes", max_bytes),
                  "check that it is the right file");
    }
    if (got < capacity) break;
    capacity = 1U << 16U;
  }
  if (std::ferror(file.get()) != 0) {
    throw Error(path.string(), fmt::format("cannot be read ({})", std::strerror(errno)),
                "check the disk and the file's permissions");
  }
  return bytes;
}

LineReader::LineReader(std::string_view text) : rest_(text) {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
}

bool LineReader::next(std::string_view& line) {
  while (!rest_.empty()) {
    const std::size_t end = rest_.find('\n');
    line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    ++number_;
    if (!line.empty() && line.front() != '#') return true;
  }
  return false;
}

std::vector<std::string_view> split_words(std::string_view line) {
  std::vector<std::string_view> words;
  std::size_t start = line.find_first_not_of(kBlanks);
  while (start != std::string_view::npos) {
    const std::size_t end = line.find_first_of(kBlanks, start);
    words.push_back(line.substr(start, end - start));
    start = line.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::optional<double> parse_number(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

double parse_timestamp(std::string_view word, const std::string& where) {
  constexpr double kMaxSeconds = 1e11;  // the year 5138; milliseconds since 1970 are already above it
  const std::optional<double> time = parse_number(word);
  if (!time || !std::isfinite(*time)) {
    throw Error(where, fmt::format("the timestamp {} is not a finite number", shown(word)),
                "give the time in seconds");
  }
  if (std::abs(*time) > kMaxSeconds) {
    throw Error(where, fmt::format("the timestamp {} is too large", shown(word)),
                "give the time in seconds, not in milli- or nanoseconds");
  }
  return *time;
}

std::string shown(std::string_view word) {
  constexpr std::size_t kMax = 40;
  std::string text = "'";
  for (const char c : word.substr(0, kMax)) {
    text += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  }
  return text + (word.size() > kMax ? "...'" : "'");
}

}  // namespace stdc
