#pragma once

#include <string>
#include <vector>

#include "report/run_record.hpp"
#include "report/run_summary.hpp"

namespace stdc::app {

/// What somebody who looks at a run ought to know, a sentence each, the worst first; nothing if all is well.
/// @param about_depth  what depth_warnings() says of its frames
std::vector<std::string> run_warnings(const RunSummary& summary, const RunRecord& record,
                                      const std::vector<std::string>& about_depth);

}  // namespace stdc::app
