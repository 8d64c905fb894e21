#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"

namespace stdc {

/// All numbers of a text, separated by blanks, commas or line ends; '#' starts a comment. "nan" and "inf" are
/// numbers. Throws Error (name:line) for a word that is none.
std::vector<double> parse_numbers(std::string_view text, const std::string& name);

/// A file of `count` numbers or more. Throws Error if it cannot be read or has fewer.
std::vector<double> read_numbers(const std::filesystem::path& path, std::size_t count);

/// A rigid transform from the 12 or 16 numbers of a matrix, row by row; nothing where a number is not finite,
/// as data sets write it for frames without a pose, or where the rotation is none (not orthonormal to 1e-2).
std::optional<Pose> pose_of_matrix(const double* numbers);

}  // namespace stdc
