// stdc-slam report: runs side by side.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "core/files/text_file.hpp"
#include "core/files/whole_file.hpp"
#include "report/comparison.hpp"
#include "run/command_line.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

struct ReportOptions {
  std::vector<std::string> runs;
  fs::path output = "comparison.html";
};

/// What the runs of a folder or file are called: the folder, or the file if its name says more than ours
/// does.
std::string name_of(const fs::path& given) {
  std::error_code failed;
  const fs::path whole = fs::canonical(given, failed);
  const fs::path path = failed ? given : whole;
  const bool is_ours = path.filename() == "report.html";
  return (is_ours ? path.parent_path() : path).stem().string();
}

nlohmann::ordered_json read_run(const std::string& given) {
  std::error_code failed;
  const fs::path path = fs::is_directory(given, failed) ? fs::path(given) / "report.html" : fs::path(given);
  constexpr std::size_t kMaxBytes = 64 << 20U;
  const std::string content =
      read_file(path, "run it again without --no-report, or give a folder that run wrote", kMaxBytes);
  return read_report(content, name_of(given), path.string());
}

void compare(const ReportOptions& options) {
  std::vector<std::string> names;
  std::vector<nlohmann::ordered_json> documents;
  for (const std::string& given : options.runs) {
    names.push_back(name_of(given));
    documents.push_back(read_run(given));
  }
  const Comparison comparison =
      compare_reports(names, std::move(documents), shell_command(process_arguments()));
  WholeFile file(options.output);
  file.stream() << comparison.page;
  file.commit();
  fmt::print("report: {}\n", options.output.string());
}

}  // namespace

void add_report_command(Command program) {
  auto options = std::make_shared<ReportOptions>();
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
