#include "run/command_line.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/utf8.hpp"

namespace stdc::app {
namespace {

bool is_plain(unsigned char c) {
  constexpr std::string_view kMarks = "_@%+=:,./-";
  return std::isalnum(c) != 0 ? c < 0x80 : kMarks.find(static_cast<char>(c)) != std::string_view::npos;
}

/// Text that can stand between single quotes: no control characters, and UTF-8.
bool is_text(std::string_view word) {
  for (std::size_t i = 0; i < word.size();) {
    const auto c = static_cast<unsigned char>(word[i]);
    const std::size_t length = utf8_length(word, i);
    if (length == 0 || c < 0x20 || c == 0x7f) return false;
    i += length;
  }
  return true;
}

/// Between single quotes, in which only they themselves mean anything.
void append_quoted_text(const std::string& word, std::string& command) {
  command.push_back('\'');
  for (const char c : word) {
    if (c == '\'') {
      command.append("'\\''");
    } else {
      command.push_back(c);
    }
  }
  command.push_back('\'');
}

/// Between $' and ', where any byte can be written.
void append_quoted_bytes(const std::string& word, std::string& command) {
  command.append("$'");
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) {
      command.append(fmt::format("\\x{:02x}", byte));
    } else {
      if (c == '\'' || c == '\\') command.push_back('\\');
      command.push_back(c);
    }
  }
  command.push_back('\'');
}

}  // namespace

std::vector<std::string> process_arguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<std::string> words;
  for (std::size_t start = 0; start < all.size();) {
    const std::size_t end = std::min(all.find('\0', start), all.size());
    words.push_back(all.substr(start, end - start));
    start = end + 1;
  }
  return words;
}

std::string shell_command(const std::vector<std::string>& words) {
  std::string command;
  for (const std::string& word : words) {
    if (!command.empty()) command.push_back(' ');
    if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) {
      command.append(word);
    } else if (is_text(word)) {
      append_quoted_text(word, command);
    } else {
      append_quoted_bytes(word, command);
    }
  }
  return command;
}

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line, name = "unknown processor";
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    name = line.substr(colon + 2);
    break;
  }
  cpu_set_t set;
  const int cores = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
  return cores > 0 ? fmt::format("{}, {} core{}", name, cores, cores == 1 ? "" : "s") : name;
}

}  // namespace stdc::app
