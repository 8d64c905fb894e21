#include "run/run_page.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report/info_report.hpp"
#include "report/report_page.hpp"
#include "report/run_report.hpp"
#include "run/command_line.hpp"

namespace stdc::app {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts facts_of(const RunOptions& options, const SequenceInput& input, const RunResults& results) {
  const int frames = results.record.counts().total();
  Facts facts{{"input", input.source().where()},
              {"kind", title_of_kind(input.source().kind())},
              {"frames", fmt::format("{} to {}", input.first_frame(), input.first_frame() + frames - 1)},
              {"ground truth", input.truth() ? input.truth_path().string() : "none"},
              {"masks of people", std::string(enum_name(results.settings.segmentation.source))},
              {"motion", std::string(enum_name(results.settings.motion.method))}};
  if (options.load_map) facts.emplace_back("map at the start", options.load_map->string());
  if (options.save_map) facts.emplace_back("map saved as", options.save_map->string());
  if (options.realtime) facts.emplace_back("pace", "that of the camera");
  for (const std::string& note : input.source().notes()) facts.emplace_back("note", note);
  const Facts process = process_facts();
  facts.insert(facts.end(), process.begin(), process.end());
  return facts;
}

std::vector<std::string> commands_of(const RunOptions& options, const SequenceInput& input) {
  std::vector<std::string> words = process_arguments();
  const std::string program = words.empty() ? "stdc-slam" : words.front();
  std::vector<std::string> commands{shell_command(words)};
  if (input.truth() && std::filesystem::is_regular_file(input.truth_path())) {
    commands.push_back(shell_command(
        {program, "evaluate", input.truth_path().string(), (options.output / "trajectory.txt").string()}));
  }
  return commands;
}

}  // namespace

std::string run_page(const RunOptions& options, const SequenceInput& input, const RunResults& results,
                     std::vector<Eigen::Vector3d> landmarks, const SampleFrames& samples) {
  RunReport report{
      results.summary,  results.record, results.settings, {}, &samples, facts_of(options, input, results),
      !options.load_map};
  report.paths = {results.trajectories.frames,
                  results.trajectories.keyframes,
                  std::move(landmarks),
                  apply_convention(input.truth().value_or(Trajectory()), results.summary.score.convention),
                  std::nullopt,
                  {},
                  input.camera.rotation};
  nlohmann::ordered_json group = {{"title", input.name}, {"runs", {run_json(std::move(report))}}};
  return report_page(report_of(input.name, fmt::format("a run of {} frames", results.record.counts().total()),
                               nlohmann::ordered_json::array({std::move(group)}),
                               commands_of(options, input)));
}

}  // namespace stdc::app
