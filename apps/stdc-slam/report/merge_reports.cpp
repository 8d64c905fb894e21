#include "report/merge_reports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "report/json/series_json.hpp"
#include "report/report_page.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

/// Calls `visit` for each run of a document that is an object.
template <typename Visit>
void for_each_run(Json& document, const Visit& visit) {
  for (Json& group : document["groups"]) {
    if (!group.is_object() || !group.contains("runs")) continue;
    for (Json& run : group["runs"]) {
      if (run.is_object()) visit(run);
    }
  }
}

int frame_of(const Json& image) { return image.is_object() ? image.value("frame", -1) : -1; }

/// Drops the pictures of frames that only one run has: there is nothing beside them.
void keep_common_images(Json& runs) {
  std::map<int, int> count;
  for (const Json& run : runs) {
    if (!run.contains("images")) continue;
    for (const Json& image : run["images"]) ++count[frame_of(image)];
  }
  for (Json& run : runs) {
    if (!run.contains("images")) continue;
    Json kept = Json::array();
    for (Json& image : run["images"]) {
      if (count[frame_of(image)] > 1) kept.push_back(std::move(image));
    }
    run["images"] = std::move(kept);
  }
}

/// Every second picture by frame numbers, so that runs keep the same ones.
bool halve_images(Json& document) {
  std::set<int> numbers;
  for_each_run(document, [&](Json& run) {
    if (!run.contains("images")) return;
    for (const Json& image : run["images"]) numbers.insert(frame_of(image));
  });
  if (numbers.empty()) return false;
  std::set<int> kept;
  bool keep = numbers.size() > 1;
  for (const int number : numbers) {
    if (keep) kept.insert(number);
    keep = !keep;
  }
  for_each_run(document, [&](Json& run) {
    if (!run.contains("images")) return;
    Json rest = Json::array();
    for (Json& image : run["images"]) {
      if (kept.contains(frame_of(image))) rest.push_back(std::move(image));
    }
    run["images"] = std::move(rest);
  });
  return true;
}

void halve_column(Json& list, Pick pick) {
  std::vector<std::optional<double>> values;
  for (const Json& value : list) {
    values.push_back(value.is_number() ? std::optional(value.get<double>()) : std::nullopt);
  }
  constexpr int kDecimals = 4;
  list = column(values, 2, pick, kDecimals);
}

void halve_columns(Json& run, const char* part, bool series) {
  if (!run.contains(part) || !run[part].is_object()) return;
  for (auto& [name, list] : run[part].items()) {
    if (!list.is_array()) continue;
    const bool smallest = name == "inliers";
    halve_column(list, !series || name == "time" ? Pick::first : smallest ? Pick::smallest : Pick::largest);
  }
}

void halve_points(Json& run) {
  halve_columns(run, "frames", true);
  for (const char* const part : {"trajectory", "truth", "landmarks"}) halve_columns(run, part, false);
  if (run.contains("every") && run["every"].is_number_integer()) run["every"] = 2 * run["every"].get<int>();
}

}  // namespace

Json merge_reports(const std::vector<std::string>& names, std::vector<Json> documents) {
  std::map<std::string, int> uses;
  Json runs = Json::array();
  for (std::size_t i = 0; i < documents.size(); ++i) {
    Json& document = documents[i];
    for_each_run(document, [&](Json& run) {
      const bool alone = document["groups"].size() == 1 && document["groups"][0]["runs"].size() == 1;
      std::string label = alone ? names.at(i) : names.at(i) + ": " + run.value("label", "");
      if (const int number = ++uses[label]; number > 1) label += fmt::format(" ({})", number);
      run["label"] = std::move(label);
      const Json commands = document.value("commands", Json::array());
      if (alone && commands.is_array() && !commands.empty()) run["command"] = commands.front();
      run.erase("landmarks");
      runs.push_back(std::move(run));
    });
  }
  if (runs.size() > 1) keep_common_images(runs);
  std::set<std::string> sequences;
  for (const Json& run : runs) sequences.insert(run.value("name", ""));
  const std::string title =
      sequences.size() == 1 ? *sequences.begin() : fmt::format("{} sequences", sequences.size());
  return Json::array({{{"title", title}, {"runs", std::move(runs)}}});
}

std::string bounded_report_page(Json document, std::size_t max_bytes) {
  std::string page = report_page(document);
  while (page.size() > max_bytes) {
    if (!halve_images(document)) {
      bool any = false;
      for_each_run(document, [&](Json& run) {
        const bool has_points =
            run.contains("frames") && run["frames"].contains("time") && run["frames"]["time"].size() > 50;
        if (has_points) halve_points(run);
        any = any || has_points;
      });
      if (!any) break;
    }
    page = report_page(document);
  }
  return page;
}

}  // namespace stdc::app
