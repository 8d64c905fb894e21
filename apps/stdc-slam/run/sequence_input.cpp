#include "run/sequence_input.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "input/camera_file.hpp"
#include "run/frame_range.hpp"

namespace stdc::app {
namespace {

std::string name_of(const std::filesystem::path& folder) {
  std::error_code failed;
  const auto whole = std::filesystem::canonical(folder, failed);
  return (failed ? folder : whole).filename().string();
}

}  // namespace

SequenceInput::SequenceInput(const std::filesystem::path& folder,
                             const std::optional<std::filesystem::path>& camera_file,
                             const std::string& range, std::optional<double> rate)
    : sequence(folder, rate), name(name_of(folder)), camera(find_camera(sequence, camera_file)) {
  if (sequence.has_ground_truth()) {
    truth_file = sequence.ground_truth();
    if (!truth_file->poses.empty()) truth = truth_file->poses;
    if (const std::string note = truth_file->note(); !note.empty()) {
      fmt::print(stderr, "stdc-slam: {}: {}\n", (folder / "groundtruth.txt").string(), note);
    }
  }
  const auto [first, end] = parse_frame_range(range, static_cast<int>(sequence.frames().size()));
  first_frame = first;
  frames = std::span(sequence.frames())
               .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
}

}  // namespace stdc::app
