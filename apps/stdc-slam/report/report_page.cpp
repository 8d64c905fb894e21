#include "report/report_page.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace stdc::app {

// Files of report/page/, which cmake/embed.cmake makes part of the program.
std::string_view report_template();
std::string_view report_style();
std::string_view report_plotly();
std::string_view report_text_script();
std::string_view report_figures_script();
std::string_view report_run_figures_script();
std::string_view report_time_figure_script();
std::string_view report_sections_script();
std::string_view report_comparison_figures_script();
std::string_view report_comparison_script();
std::string_view report_page_script();

namespace {

constexpr std::string_view kDataStart = R"(<script type="application/json" id="report-data">)";
constexpr std::string_view kDataEnd = "</script>";
constexpr int kFormat = 1;

std::string compact(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// JSON that cannot end the script element it stands in: '<' occurs in strings alone.
std::string data_for_html(const nlohmann::ordered_json& document) {
  const std::string json = compact(document);
  std::string text;
  text.reserve(json.size());
  for (const char c : json) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

std::string text_for_html(const std::string& text) {
  std::string escaped;
  for (const char c : nlohmann::ordered_json::parse(compact(text)).get<std::string>()) {
    switch (c) {
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '&':
        escaped += "&amp;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string scripts() {
  std::string all;
  for (const std::string_view part :
       {report_text_script(), report_figures_script(), report_run_figures_script(),
        report_time_figure_script(), report_sections_script(), report_comparison_figures_script(),
        report_comparison_script(), report_page_script()}) {
    all.append(part).append("\n");
  }
  return all;
}

std::string content_of(std::string_view place, const nlohmann::ordered_json& document) {
  if (place == "version") return STDC_VERSION;
  if (place == "title") return text_for_html(document.value("title", ""));
  if (place == "style") return std::string(report_style());
  if (place == "plotly") return std::string(report_plotly());
  if (place == "scripts") return scripts();
  nlohmann::ordered_json data = {{"format", kFormat}, {"version", STDC_VERSION}};
  data.update(document);
  return data_for_html(data);
}

[[noreturn]] void refuse(const std::string& where, const std::string& problem) {
  throw Error(where, problem, "give the results of run or evaluate, written with a report");
}

}  // namespace

std::string report_page(const nlohmann::ordered_json& document) {
  std::string page;
  std::string_view rest = report_template();
  // What is filled in is not looked through again: data may hold braces.
  for (std::size_t open = rest.find("{{"); open != std::string_view::npos; open = rest.find("{{")) {
    const std::size_t close = rest.find("}}", open);
    page.append(rest.substr(0, open)).append(content_of(rest.substr(open + 2, close - open - 2), document));
    rest.remove_prefix(close + 2);
  }
  return page.append(rest);
}

nlohmann::ordered_json report_document(std::string_view page, const std::string& where) {
  const std::size_t start = page.find(kDataStart);
  if (start == std::string_view::npos) refuse(where, "is no report of this program");
  const std::string_view rest = page.substr(start + kDataStart.size());
  constexpr int kMaxDepth = 32;  // ours have 8; writing it out again recurses
  const auto no_deeper = [&where](int depth, auto /*event*/, const auto& /*value*/) {
    if (depth > kMaxDepth) refuse(where, "is a damaged report");
    return true;
  };
  const auto document = nlohmann::ordered_json::parse(rest.substr(0, rest.find(kDataEnd)), no_deeper, false);
  if (!document.is_object() || !document.contains("groups") || !document["groups"].is_array()) {
    refuse(where, "is a damaged report");
  }
  if (document.value("format", nlohmann::ordered_json()) != kFormat) {
    refuse(where, "is a report of another version of this program");
  }
  return document;
}

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace stdc::app
