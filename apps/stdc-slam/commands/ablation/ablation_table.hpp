#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace stdc::app {

/// The result of one sequence under one column's settings.
struct AblationCell {
  std::optional<double> ate_rmse;  ///< [m]; nothing if the run could not be scored
  double coverage = 0;             ///< share of the frames that have a pose in the map that holds most
  std::optional<double> frame_ms;  ///< median wall milliseconds of the tracking thread
  /// The run for the page, if there is to be one.
  std::shared_ptr<const nlohmann::ordered_json> run = nullptr;
};

struct AblationRow {
  std::string sequence;
  std::vector<AblationCell> cells;  ///< one per column
};

/// Results of several sequences under several settings, as Tables 1 and 4 of the paper show them.
struct AblationTable {
  std::vector<std::string> columns;
  std::vector<AblationRow> rows;
};

/// For the terminal.
std::string format_text(const AblationTable& table);
/// For documents.
std::string format_markdown(const AblationTable& table);
/// {"sequence": {"column": {"ate_rmse_m", "coverage", "frame_ms"}}}
std::string format_json(const AblationTable& table);

/// The document of a page: the two tables, and the columns of each sequence side by side.
nlohmann::ordered_json ablation_document(const AblationTable& table,
                                         const std::vector<std::string>& commands);

}  // namespace stdc::app
