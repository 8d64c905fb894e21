// stdc-slam report: runs side by side.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "core/error.hpp"
#include "core/text_file.hpp"
#include "core/whole_file.hpp"
#include "report/evo_result.hpp"
#include "report/merge_reports.hpp"
#include "report/report_page.hpp"
#include "report/run_report.hpp"
#include "run/command_line.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

struct Options {
  std::vector<std::string> runs;
  fs::path output = "comparison.html";
};

constexpr std::size_t kMaxRuns = 24;  // more cannot be told apart

/// What the runs of a folder or file are called: the folder, or the file if its name says more than ours
/// does.
std::string name_of(const fs::path& given) {
  std::error_code failed;
  const fs::path whole = fs::canonical(given, failed);
  const fs::path path = failed ? given : whole;
  const bool is_ours = path.filename() == "report.html";
  return (is_ours ? path.parent_path() : path).stem().string();
}

nlohmann::ordered_json read_report(const std::string& given) {
  std::error_code failed;
  const fs::path path = fs::is_directory(given, failed) ? fs::path(given) / "report.html" : fs::path(given);
  constexpr std::size_t kMaxBytes = 64 << 20U;
  const std::string page =
      read_file(path, "run it again without --no-report, or give a folder that run wrote", kMaxBytes);
  if (page.starts_with("PK")) {
    nlohmann::ordered_json group = {{"title", name_of(given)}, {"runs", {evo_run(page, path.string())}}};
    return {{"groups", nlohmann::ordered_json::array({std::move(group)})}};
  }
  return report_document(page, path.string());
}

nlohmann::ordered_json merged(const std::vector<std::string>& names,
                              std::vector<nlohmann::ordered_json> documents) {
  try {
    return merge_reports(names, std::move(documents));
  } catch (const nlohmann::ordered_json::exception&) {
    throw Error("report", "one of the pages holds what this program does not write", "write them again");
  }
}

void compare(const Options& options) {
  std::vector<std::string> names;
  std::vector<nlohmann::ordered_json> documents;
  for (const std::string& given : options.runs) {
    names.push_back(name_of(given));
    documents.push_back(read_report(given));
  }
  nlohmann::ordered_json groups = merged(names, std::move(documents));
  const std::size_t count = groups[0]["runs"].size();
  if (count > kMaxRuns) {
    throw Error("report", fmt::format("{} runs are too many for a page", count),
                fmt::format("give at most {}", kMaxRuns));
  }
  if (count == 0) throw Error("report", "there are no runs in what was given", "give folders that run wrote");
  const std::string title = groups[0]["title"];
  const std::string subtitle = count == 1 ? "one run" : fmt::format("{} runs side by side", count);
  WholeFile file(options.output);
  file.stream() << bounded_report_page(
      report_of(title, subtitle, std::move(groups), {shell_command(process_arguments())}));
  file.commit();
  fmt::print("report: {}\n", options.output.string());
}

}  // namespace

void add_report_command(Command program) {
  auto options = std::make_shared<Options>();
  Command command = program.add_subcommand("report", "Put runs side by side on a page");
  command
      .add_option("RUNS", options->runs,
                  "Output folders of run, pages that this program wrote, or results of evo_ape (ZIP)")
      .required();
  command.add_option("--output,-o", options->output, "The page").type_name("FILE").capture_default_str();
  command.footer(R"(
Takes what it shows from the report.html of each run: scores in a table with the best of each row marked, errors,
times and keypoints over each other, the settings in which the runs differ, the same frames with their masks. Runs of
the same recording are drawn over the same time, and over each other in plan if there is a ground truth. Pages of
evaluate and ablation can be given, too, and what evo_ape --save_results has written.

Examples:
  stdc-slam report results-before results-after
  stdc-slam report results-* --output all.html)");
  command.callback([options] { compare(*options); });
}

}  // namespace stdc::app
