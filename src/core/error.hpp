#pragma once

#include <stdexcept>
#include <string>

namespace stdc {

/// The one exception type of the libraries, thrown only at their edges (files, settings, arguments).
/// `what()` is one line: "<where>: <problem>; <hint>".
class Error : public std::runtime_error {
 public:
  /// @param where    the file (and line, as "file:12"), setting or argument at fault
  /// @param problem  what is wrong, without a full stop
  /// @param hint     what the user can do about it, without a full stop
  Error(std::string where, std::string problem, std::string hint)
      : std::runtime_error(where + ": " + problem + "; " + hint),
        where_(std::move(where)),
        problem_(std::move(problem)),
        hint_(std::move(hint)) {}

  const std::string& where() const { return where_; }
  const std::string& problem() const { return problem_; }
  const std::string& hint() const { return hint_; }

 private:
  std::string where_, problem_, hint_;
};

}  // namespace stdc
