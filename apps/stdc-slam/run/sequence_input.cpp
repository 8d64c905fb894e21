#include "run/sequence_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "input/camera_file.hpp"
#include "input/shifted_depth.hpp"

namespace stdc::app {
namespace {

std::string name_of(const std::filesystem::path& folder) {
  std::error_code failed;
  const auto whole = std::filesystem::canonical(folder, failed);
  return (failed ? folder : whole).filename().string();
}

RgbdCameras find_cameras(const FrameSource& source, const std::optional<std::filesystem::path>& file) {
  if (file) return read_cameras(*file);
  if (auto cameras = source.cameras()) return *cameras;
  throw Error(source.where(), "its camera is not known", source.camera_hint());
}

}  // namespace

SequenceInput::SequenceInput(const InputOptions& options)
    : SequenceInput(options, open_source(options.path, options.source)) {}

SequenceInput::SequenceInput(const InputOptions& options, std::unique_ptr<FrameSource> source)
    : SequenceInput(options, std::move(source), std::nullopt) {}

SequenceInput::SequenceInput(const InputOptions& options, std::unique_ptr<FrameSource> source,
                             const std::optional<RgbdCameras>& used)
    : name(name_of(options.path)), source_(std::move(source)) {
  cameras = used ? *used : find_cameras(*source_, options.camera);
  if (cameras.depth_time_offset != 0) source_ = shift_depth(std::move(source_), cameras.depth_time_offset);
  for (const std::string& note : source_->notes()) fmt::print(stderr, "stdc-slam: {}\n", note);
  if (!source_->truth_comes_last()) truth_file();
  range_ = parse_frame_range(options.frames, source_->frame_count());
}

const std::optional<GroundTruth>& SequenceInput::truth_file() const {
  if (truth_is_read_) return truth_file_;
  truth_is_read_ = true;
  truth_file_ = source_->ground_truth();
  if (!truth_file_) return truth_file_;
  if (!truth_file_->poses.empty()) truth_ = truth_file_->poses;
  // Of a truth without any pose more is said than that, by what would use it.
  if (const std::string note = truth_file_->note(); truth_ && !note.empty()) {
    fmt::print(stderr, "stdc-slam: {}: {}\n", truth_path().string(), note);
  }
  return truth_file_;
}

const std::optional<Trajectory>& SequenceInput::truth() const {
  truth_file();
  return truth_;
}

std::string SequenceInput::why_no_truth() const {
  if (!truth_file()) return "there is no such file";
  const std::string note = truth_file()->note();
  return note.empty() ? "holds no pose" : "holds no pose, " + note;
}

const Trajectory& SequenceInput::required_truth() const {
  if (truth()) return *truth();
  throw Error(truth_path().string(), why_no_truth(),
              truth_file() ? std::string("write each line as: timestamp tx ty tz qx qy qz qw")
                           : "give a sequence whose poses are known");
}

FrameSource& SequenceInput::start() const {
  if (used_) {
    if (!source_->can_rewind()) {
      throw Error(source_->where(), "cannot be gone through a second time", "record it first");
    }
    source_->rewind();
  }
  used_ = true;
  return *source_;
}

std::optional<int> SequenceInput::frame_count() const {
  if (!range_.end) return std::nullopt;
  return *range_.end - range_.first;
}

std::optional<int> SequenceInput::expected_frame_count() const {
  const std::optional<int> expected = source_->expected_frame_count();
  if (range_.end || !expected) return frame_count();
  return std::max(1, *expected - range_.first);
}

std::optional<std::vector<double>> SequenceInput::frame_times() const {
  auto times = source_->frame_times();
  if (!times) return std::nullopt;
  const auto count = static_cast<int>(times->size());
  const auto first = times->begin() + std::min(range_.first, count);
  return std::vector<double>(first, times->begin() + std::min(range_.end.value_or(count), count));
}

std::optional<std::vector<MaskedFrame>> SequenceInput::masked_frames() const {
  const auto times = frame_times();
  if (!times) return std::nullopt;
  const std::vector<std::string> names = source_->frame_names();
  std::vector<MaskedFrame> frames;
  for (const double time : *times) {
    const std::size_t number = static_cast<std::size_t>(range_.first) + frames.size();
    frames.push_back({time, number < names.size() ? names[number] : "", static_cast<int>(number)});
  }
  return frames;
}

}  // namespace stdc::app
