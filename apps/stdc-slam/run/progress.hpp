#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace stdc::app {

/// Tells on stderr how far a long job is: a bar on a terminal (only the count where the end is not known),
/// else a line every 5 s, or nothing.
class Progress {
 public:
  /// @param label  what is being done, e.g. "tracking"
  /// @param unit   what is counted, in the plural, e.g. "frames"
  /// @param total  how many there are; nothing: not known
  Progress(std::string label, std::string unit, std::optional<int> total, bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Reports that `done` of the total are done; `note` is appended.
  void update(int done, std::string_view note = {});
  /// Prints a line of its own, also when quiet: it is for what has gone wrong.
  void message(std::string_view line);
  /// Wipes the bar. Called by the destructor too.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  double seconds_since_start(Clock::time_point now) const;
  void draw_bar(int done, std::string_view note, Clock::time_point now);
  void print_line(int done, std::string_view note, Clock::time_point now);

  std::string label_, unit_;
  std::optional<int> total_;
  bool quiet_, terminal_;
  bool bar_is_there_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

}  // namespace stdc::app
