#include "run/sequence_input.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/error.hpp"
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
    // Of a truth without any pose more is said than that, by what would use it.
    if (const std::string note = truth_file->note(); truth && !note.empty()) {
      fmt::print(stderr, "stdc-slam: {}: {}\n", truth_path().string(), note);
    }
  }
  const auto [first, end] = parse_frame_range(range, static_cast<int>(sequence.frames().size()));
  first_frame = first;
  frames = std::span(sequence.frames())
               .subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
}

std::string SequenceInput::why_no_truth() const {
  if (!truth_file) return "there is no such file";
  const std::string note = truth_file->note();
  return note.empty() ? "holds no pose" : "holds no pose, " + note;
}

const Trajectory& SequenceInput::required_truth() const {
  if (truth) return *truth;
  throw Error(truth_path().string(), why_no_truth(),
              truth_file ? std::string("write each line as: timestamp tx ty tz qx qy qz qw")
                         : "give a sequence whose poses are known");
}

}  // namespace stdc::app
