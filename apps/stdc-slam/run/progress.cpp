#include "run/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace stdc::app {
namespace {

constexpr double kBarInterval = 0.1, kLineInterval = 5;  // [s]

}  // namespace

Progress::Progress(std::string label, std::string unit, std::optional<int> total, bool quiet)
    : label_(std::move(label)),
      unit_(std::move(unit)),
      total_(total ? std::optional(std::max(1, *total)) : std::nullopt),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() { finish(); }

double Progress::seconds_since_start(Clock::time_point now) const {
  return std::chrono::duration<double>(now - start_).count();
}

void Progress::update(int done, std::string_view note) {
  if (quiet_) return;
  const Clock::time_point now = Clock::now();
  const double pause = std::chrono::duration<double>(now - last_).count();
  if (pause < (terminal_ ? kBarInterval : kLineInterval)) return;
  last_ = now;
  if (terminal_) {
    draw_bar(done, note, now);
  } else {
    print_line(done, note, now);
  }
}

void Progress::draw_bar(int done, std::string_view note, Clock::time_point now) {
  const double seconds = seconds_since_start(now);
  bar_is_there_ = true;
  if (!total_) {
    fmt::print(stderr, "\r\033[K{} {} {}, {:.1f}/s{}", label_, done, unit_, done / std::max(seconds, 1e-3),
               note);
    std::fflush(stderr);
    return;
  }
  constexpr int kWidth = 30;
  const int filled = std::clamp(kWidth * done / *total_, 0, kWidth);
  const double rest = done > 0 ? seconds / done * (*total_ - done) : 0;
  fmt::print(stderr, "\r\033[K{} [{:#<{}}{:.<{}}] {}/{} {}, {:.1f}/s, {:.0f} s left{}", label_, "", filled,
             "", kWidth - filled, done, *total_, unit_, done / std::max(seconds, 1e-3), rest, note);
  std::fflush(stderr);
}

void Progress::print_line(int done, std::string_view note, Clock::time_point now) {
  const double rate = done / std::max(seconds_since_start(now), 1e-3);
  if (!total_) {
    fmt::print(stderr, "{}: {} {}, {:.1f} a second{}\n", label_, done, unit_, rate, note);
    return;
  }
  fmt::print(stderr, "{}: {} of {} {} ({} %), {:.1f} a second{}\n", label_, done, *total_, unit_,
             100 * static_cast<long>(done) / *total_, rate, note);
}

void Progress::message(std::string_view line) {
  finish();
  fmt::print(stderr, "{}\n", line);
}

void Progress::finish() {
  if (bar_is_there_) fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
  bar_is_there_ = false;
}

}  // namespace stdc::app
