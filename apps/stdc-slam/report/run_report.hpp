#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/json/path_json.hpp"
#include "report/pictures/sample_frames.hpp"
#include "report/run_record.hpp"
#include "report/run_summary.hpp"

namespace stdc::app {

/// All that the page of a run is made of.
struct RunReport {
  const RunSummary& summary;
  const RunRecord& record;
  const Settings& settings;
  ReportPaths paths;                                       ///< without the errors
  const SampleFrames* samples = nullptr;                   ///< null: there are none
  std::vector<std::pair<std::string, std::string>> facts;  ///< what ran on what: name and value
  bool own_frames = true;                                  ///< keyframes are of this run: no map was loaded
};

/// A run as the page shows it; docs/report.md has the layout.
nlohmann::ordered_json run_json(RunReport report);

/// The facts that the pages of all commands tell: machine, folder.
std::vector<std::pair<std::string, std::string>> process_facts();

/// A page of groups of runs.
/// @param subtitle  under the title: "a run of 300 frames"
/// @param commands  that give it again
nlohmann::ordered_json report_of(const std::string& title, const std::string& subtitle,
                                 nlohmann::ordered_json groups, const std::vector<std::string>& commands);

}  // namespace stdc::app
