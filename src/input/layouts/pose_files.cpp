#include "input/layouts/pose_files.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/layouts/image_folder.hpp"
#include "input/layouts/number_file.hpp"

namespace stdc {
namespace {

constexpr std::size_t kMatrix = 16;

}  // namespace

void add_row(GroundTruth& truth, double timestamp, const std::optional<Pose>& pose) {
  ++truth.rows;
  if (!pose) {
    ++truth.without_pose;
  } else if (!truth.poses.empty() && !(timestamp > truth.poses.back().timestamp)) {
    ++truth.repeated;
  } else {
    truth.poses.push_back({timestamp, *pose});
  }
}

GroundTruth read_pose_files(const std::vector<PoseFile>& files) {
  GroundTruth truth;
  for (const PoseFile& file : files) {
    if (!is_file(file.path)) {
      add_row(truth, file.timestamp, std::nullopt);
      continue;
    }
    try {
      const std::vector<double> numbers = read_numbers(file.path, kMatrix);
      if (numbers.size() == kMatrix) {
        add_row(truth, file.timestamp, pose_of_matrix(numbers.data()));
        continue;
      }
    } catch (const Error&) {  // one damaged file of thousands: counted like a damaged row
    }
    ++truth.rows;
    ++truth.malformed;
  }
  return truth;
}

GroundTruth parse_trajectory_log(std::string_view text, const std::vector<double>& times) {
  GroundTruth truth;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    std::vector<double> matrix;
    for (int row = 0; row < 4 && lines.next(line); ++row) {
      for (const std::string_view word : split_words(line)) {
        matrix.push_back(parse_number(word).value_or(std::nan("")));
      }
    }
    const auto frame = static_cast<std::size_t>(truth.rows);
    if (matrix.size() != kMatrix) {
      ++truth.rows;
      ++truth.malformed;
    } else if (frame < times.size()) {
      add_row(truth, times[frame], pose_of_matrix(matrix.data()));
    } else {
      add_row(truth, 0, std::nullopt);
    }
  }
  return truth;
}

}  // namespace stdc
