#include "commands/ablation/ablation_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>

#include "report/quantiles.hpp"
#include "report/report_page.hpp"
#include "report/run_report.hpp"

namespace stdc::app {
namespace {

using CellText = std::function<std::string(const AblationCell&)>;

std::string accuracy(const AblationCell& cell) {
  const std::string coverage = fmt::format("({:.1f} %)", 100 * cell.coverage);
  return cell.ate_rmse ? fmt::format("{:.4f} {}", *cell.ate_rmse, coverage) : "- " + coverage;
}

std::string time(const AblationCell& cell) { return to_text(cell.frame_ms, 2); }

/// Cells as text, the head line first.
std::vector<std::vector<std::string>> cells(const AblationTable& table, const CellText& text) {
  std::vector<std::vector<std::string>> lines(1, {"Sequence"});
  lines[0].insert(lines[0].end(), table.columns.begin(), table.columns.end());
  for (const AblationRow& row : table.rows) {
    auto& line = lines.emplace_back(std::vector{row.sequence});
    for (const AblationCell& cell : row.cells) line.push_back(text(cell));
  }
  return lines;
}

std::string aligned(const std::vector<std::vector<std::string>>& lines) {
  std::vector<std::size_t> widths(lines[0].size());
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("{:<{}}", line[0], widths[0]);
    for (std::size_t i = 1; i < line.size(); ++i) text += fmt::format("  {:>{}}", line[i], widths[i]);
    text += "\n";
  }
  return text;
}

std::string markdown(const std::vector<std::vector<std::string>>& lines) {
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    text += "|";
    for (const std::string& cell : lines[i]) text += fmt::format(" {} |", cell);
    text += "\n";
    if (i > 0) continue;
    text += "|---|";
    for (std::size_t column = 1; column < lines[0].size(); ++column) text += "---:|";
    text += "\n";
  }
  return text;
}

constexpr const char* kAccuracyTitle = "Table 1. RMSE [m] of the ATE (frames that have a pose)";
constexpr const char* kTimeTitle = "Table 4. Time of the tracking thread per frame [ms], median";

}  // namespace

std::string format_text(const AblationTable& table) {
  return fmt::format("{}\n{}\n{}\n{}", kAccuracyTitle, aligned(cells(table, accuracy)), kTimeTitle,
                     aligned(cells(table, time)));
}

std::string format_markdown(const AblationTable& table) {
  return fmt::format("{}\n\n{}\n{}\n\n{}", kAccuracyTitle, markdown(cells(table, accuracy)), kTimeTitle,
                     markdown(cells(table, time)));
}

nlohmann::ordered_json ablation_document(const AblationTable& table,
                                         const std::vector<std::string>& commands) {
  using Json = nlohmann::ordered_json;
  const auto table_json = [](const char* id, const char* title, std::vector<std::vector<std::string>> lines) {
    const std::vector<std::string> head = lines.front();
    lines.erase(lines.begin());
    return Json{{"id", id}, {"title", title}, {"head", head}, {"rows", lines}};
  };
  Json groups = Json::array();
  for (const AblationRow& row : table.rows) {
    Json runs = Json::array();
    for (const AblationCell& cell : row.cells) {
      if (cell.run) runs.push_back(*cell.run);
    }
    groups.push_back({{"title", row.sequence}, {"runs", std::move(runs)}});
  }
  Json document = report_of("Ablation",
                            fmt::format("{} sequence{}, {} columns", table.rows.size(),
                                        table.rows.size() == 1 ? "" : "s", table.columns.size()),
                            std::move(groups), commands);
  document["tables"] = Json::array({table_json("accuracy", kAccuracyTitle, cells(table, accuracy)),
                                    table_json("time", kTimeTitle, cells(table, time))});
  return document;
}

std::string format_json(const AblationTable& table) {
  nlohmann::ordered_json json;
  for (const AblationRow& row : table.rows) {
    auto& entry = json[row.sequence];
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const AblationCell& cell = row.cells[i];
      entry[table.columns[i]] = {
          {"ate_rmse_m", cell.ate_rmse ? nlohmann::ordered_json(*cell.ate_rmse) : nullptr},
          {"coverage", cell.coverage},
          {"frame_ms", to_json(cell.frame_ms)}};
    }
  }
  return json_text(json);
}

}  // namespace stdc::app
