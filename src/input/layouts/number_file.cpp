#include "input/layouts/number_file.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {

std::vector<double> parse_numbers(std::string_view text, const std::string& name) {
  std::vector<double> numbers;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line)) {
    std::string blanks(line);
    std::replace(blanks.begin(), blanks.end(), ',', ' ');
    std::replace(blanks.begin(), blanks.end(), ';', ' ');
    for (const std::string_view word : split_words(blanks)) {
      const std::optional<double> number = parse_number(word);
      if (!number) {
        throw Error(fmt::format("{}:{}", name, lines.number()),
                    fmt::format("{} is not a number", shown(word)), "restore the file");
      }
      numbers.push_back(*number);
    }
  }
  return numbers;
}

std::vector<double> read_numbers(const std::filesystem::path& path, std::size_t count) {
  constexpr const char* kNumberHint = "restore the file";
  constexpr std::size_t kMaxFile = 1U << 24U;
  const std::vector<double> numbers = parse_numbers(read_file(path, kNumberHint, kMaxFile), path.string());
  if (numbers.size() < count) {
    throw Error(path.string(), fmt::format("holds {} numbers instead of {}", numbers.size(), count),
                kNumberHint);
  }
  return numbers;
}

std::optional<Pose> pose_of_matrix(const double* numbers) {
  if (!std::all_of(numbers, numbers + 12, [](double x) { return std::isfinite(x); })) return std::nullopt;
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> matrix(numbers);
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  constexpr double kTolerance = 1e-2;
  if (!((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < kTolerance) ||
      rotation.determinant() < 0) {
    return std::nullopt;
  }
  // Files round: the nearest rotation, as the quaternion of a matrix that is nearly one may be far off.
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(rotation, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return Pose(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()), matrix.col(3));
}

}  // namespace stdc
