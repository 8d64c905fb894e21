#include "report/comparison.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "core/error.hpp"
#include "report/evo/evo_result.hpp"
#include "report/merge_reports.hpp"
#include "report/report_page.hpp"
#include "report/run_report.hpp"

namespace stdc::app {
namespace {

constexpr std::size_t kMaxRuns = 24;  // more cannot be told apart

}  // namespace

nlohmann::ordered_json read_report(const std::string& content, const std::string& name,
                                   const std::string& where) {
  if (!content.starts_with("PK")) return report_document(content, where);
  nlohmann::ordered_json group = {{"title", name}, {"runs", {evo_run(content, where)}}};
  return {{"groups", nlohmann::ordered_json::array({std::move(group)})}};
}

Comparison compare_reports(const std::vector<std::string>& names,
                           std::vector<nlohmann::ordered_json> documents, const std::string& command) {
  try {
    nlohmann::ordered_json groups = merge_reports(names, std::move(documents));
    const std::size_t count = groups[0]["runs"].size();
    if (count > kMaxRuns) {
      throw Error("report", fmt::format("{} runs are too many for a page", count),
                  fmt::format("give at most {}", kMaxRuns));
    }
    if (count == 0)
      throw Error("report", "there are no runs in what was given", "give folders that run wrote");
    const std::string title = groups[0]["title"];
    const std::string subtitle = count == 1 ? "one run" : fmt::format("{} runs side by side", count);
    return {bounded_report_page(report_of(title, subtitle, std::move(groups), {command})),
            static_cast<int>(count)};
  } catch (const nlohmann::ordered_json::exception&) {
    throw Error("report", "one of the pages holds what this program does not write", "write them again");
  }
}

}  // namespace stdc::app
