#pragma once

#include <stdexcept>
#include <string>

namespace stdc {

/// The one exception type of the libraries, thrown only at their edges (files, settings, arguments).
/// `what()` is one line: "<where>: <problem>; <mend>".
class Error : public std::runtime_error {
 public:
  /// @param where    the file (and line, as "file:12"), setting or argument at fault
  /// @param problem  what is wrong, without a full stop
  /// @param mend     what the user can do about it, without a full stop
  Error(std::string where, std::string problem, std::string mend)
      : std::runtime_error(where + ": " + problem + "; " + mend),
        where_(std::move(where)),
        problem_(std::move(problem)),
        mend_(std::move(mend)) {}

  const std::string& where() const { return where_; }
  const std::string& problem() const { return problem_; }
  const std::string& mend() const { return mend_; }

 private:
  std::string where_, problem_, mend_;
};

}  // namespace stdc
