#include "report/evo/evo_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/error.hpp"
#include "report/evo/zip_archive.hpp"
#include "report/json/frames_json.hpp"
#include "report/report_page.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "arrays are written as they lie in memory");

/// A NumPy file, version 1.0 of its format: magic, length and text of a header that ends at a multiple of 64,
/// numbers.
std::string npy(const std::vector<double>& numbers, const std::string& shape) {
  std::string header = fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape);
  constexpr std::size_t kBefore = 10, kMultiple = 64;
  header.append(kMultiple - 1 - (kBefore + header.size()) % kMultiple, ' ').push_back('\n');
  std::string file("\x93NUMPY\x01\x00", 8);
  file.push_back(static_cast<char>(header.size() & 0xffU));
  file.push_back(static_cast<char>(header.size() >> 8U));
  file += header;
  return file.append(reinterpret_cast<const char*>(numbers.data()), sizeof(double) * numbers.size());
}

std::string npy(const std::vector<double>& numbers) {
  return npy(numbers, fmt::format("{},", numbers.size()));
}

[[noreturn]] void refuse_result(const std::string& where, const std::string& problem) {
  throw Error(where, problem, "give results of evo_ape with --save_results");
}

/// The numbers of a NumPy file of one dimension.
std::vector<double> numbers_of(const std::string& file, const std::string& where) {
  const std::size_t header = file.find('\n');
  if (!file.starts_with("\x93NUMPY") || header == std::string::npos || file.find("'<f8'") > header) {
    refuse_result(where, "has an array that is not of 64-bit floating-point numbers");
  }
  std::vector<double> numbers((file.size() - header - 1) / sizeof(double));
  std::memcpy(numbers.data(), file.data() + header + 1, sizeof(double) * numbers.size());
  return numbers;
}

/// The array of that name, whatever evo called its file: .npy now, .npz earlier.
std::optional<std::vector<double>> array(const std::map<std::string, std::string>& files,
                                         const std::string& name, const std::string& where) {
  for (const char* const ending : {".npy", ".npz"}) {
    const auto found = files.find(name + ending);
    if (found != files.end()) return numbers_of(found->second, where);
  }
  return std::nullopt;
}

Json parse(const std::map<std::string, std::string>& files, const std::string& name,
           const std::string& where) {
  const auto found = files.find(name);
  Json json = found == files.end() ? Json() : Json::parse(found->second, nullptr, false);
  if (!json.is_object()) refuse_result(where, "has no " + name + " as evo writes it");
  return json;
}

}  // namespace

std::string evo_result(const TrajectoryScores& scores, const std::vector<PoseError>& errors,
                       const std::string& truth_name, const std::string& estimate_name) {
  std::vector<double> distances, times, seconds;
  double squares = 0;
  for (const PoseError& error : errors) {
    distances.push_back(error.distance);
    times.push_back(error.timestamp);
    seconds.push_back(error.timestamp - errors.front().timestamp);
    squares += error.distance * error.distance;
  }
  const double variance = squares / static_cast<double>(errors.size()) - scores.ate.mean * scores.ate.mean;
  const Json stats = {{"rmse", scores.ate.rmse},
                      {"mean", scores.ate.mean},
                      {"median", scores.ate.median},
                      {"std", std::sqrt(std::max(0.0, variance))},
                      {"min", *std::min_element(distances.begin(), distances.end())},
                      {"max", scores.ate.maximum},
                      {"sse", squares}};
  const Json info = {{"title", "APE w.r.t. translation part (m)\n(with SE(3) Umeyama alignment)"},
                     {"ref_name", truth_name},
                     {"est_name", estimate_name},
                     {"label", "APE (m)"}};
  std::vector<double> matrix;
  const Eigen::Matrix3d rotation = scores.truth_from_estimate.rotation_matrix();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix.push_back(rotation(row, column));
    matrix.push_back(scores.truth_from_estimate.translation[row]);
  }
  matrix.insert(matrix.end(), {0, 0, 0, 1});
  return make_zip({{"info.json", json_text(info)},
                   {"stats.json", json_text(stats)},
                   {"error_array.npy", npy(distances)},
                   {"timestamps.npy", npy(times)},
                   {"seconds_from_start.npy", npy(seconds)},
                   {"alignment_transformation_sim3.npy", npy(matrix, "4, 4")}});
}

Json evo_run(std::string_view archive, const std::string& where) {
  const std::map<std::string, std::string> files = read_zip(archive, where);
  const Json info = parse(files, "info.json", where), stats = parse(files, "stats.json", where);
  const auto distances = array(files, "error_array", where);
  if (!distances || distances->empty()) refuse_result(where, "has no errors");
  if (info.value("label", "") != "APE (m)") refuse_result(where, "does not hold absolute errors in metres");
  const std::vector<double> times = array(files, "timestamps", where).value_or(std::vector<double>());
  std::vector<PoseError> errors;
  int far_off = 0;
  for (std::size_t i = 0; i < distances->size(); ++i) {
    const bool timed = times.size() == distances->size();
    errors.push_back({timed ? times[i] : static_cast<double>(i), (*distances)[i]});
    far_off += (*distances)[i] > 0.05 ? 1 : 0;
  }
  Json ate;
  for (const char* const name : {"rmse", "mean", "median", "max"}) {
    ate[name] = stats.contains(name) && stats[name].is_number() ? stats[name] : Json();
  }
  const std::string name = info.value("est_name", "estimate");
  Json run = {
      {"name", info.value("ref_name", "")},
      {"label", name},
      {"summary", {{"scores", {{"pairs", errors.size()}, {"off_by_5_cm", far_off}, {"ate_m", ate}}}}}};
  add_errors(run, errors);
  return run;
}

}  // namespace stdc::app
