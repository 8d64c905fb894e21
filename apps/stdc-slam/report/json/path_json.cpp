#include "report/json/path_json.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/json/series_json.hpp"

namespace stdc::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kPositionDecimals = 4;  // [m]
constexpr double kMinExtent = 0.1;    // [m]
constexpr double kMaxPathGap = 0.25;  // [s]; a line across a longer one would show a way that nobody has seen

/// Up in the axes of the camera: `rotation` degrees clockwise turn its image upright.
Eigen::Vector3d up_in_camera(int rotation) {
  switch (rotation) {
    case 90:
      return {-1, 0, 0};
    case 180:
      return {0, 1, 0};
    case 270:
      return {1, 0, 0};
    default:
      return {0, -1, 0};
  }
}

/// Diagonal of the box around a path [m].
double extent_of(const Trajectory& path) {
  Eigen::AlignedBox3d box;
  for (const StampedPose& pose : path) box.extend(pose.world_from_cam.translation);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

/// The rows of a rotation that takes an axis of the world, `up` with its sign, to z. From above the first
/// axis points right.
Eigen::Matrix3d rotation_of_axes(int up, double sign) {
  const int right = up == 0 ? 1 : 0;
  const int along = 3 - up - right;
  Eigen::Matrix3d rows = Eigen::Matrix3d::Zero();
  rows(0, right) = 1;
  rows(2, up) = sign;
  rows(1, along) = 1;
  if (rows.determinant() < 0) rows(1, along) = -1;
  return rows;
}

/// Points as columns, thinned, with nulls where a line must not go on.
Json path_columns(const Trajectory& path, const std::vector<Eigen::Vector3d>& drawn, double first_time,
                  double max_gap = kMaxPathGap) {
  Json columns = {{"time", Json::array()}, {"x", Json::array()}, {"y", Json::array()}, {"z", Json::array()}};
  const auto push = [&](const Json& time, const std::array<Json, 3>& position) {
    columns["time"].push_back(time);
    for (std::size_t i = 0; i < 3; ++i) columns[std::string(1, "xyz"[i])].push_back(position[i]);
  };
  const auto every = static_cast<std::size_t>(values_per_point(path.size()));
  bool gap = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    gap = gap || (i > 0 && path[i].timestamp - path[i - 1].timestamp > max_gap);
    if (i % every != 0 && i + 1 != path.size()) continue;
    if (gap) push(nullptr, {nullptr, nullptr, nullptr});
    gap = false;
    push(rounded(path[i].timestamp - first_time, kTimeDecimals),
         {rounded(drawn[i].x(), kPositionDecimals), rounded(drawn[i].y(), kPositionDecimals),
          rounded(drawn[i].z(), kPositionDecimals)});
  }
  return columns;
}

/// The error at each point of the columns [mm]; null where it is not known.
Json errors_at(const Json& times, const std::vector<PoseError>& errors, double first_time) {
  Json column = Json::array();
  for (const Json& time : times) {
    if (time.is_null()) {
      column.push_back(nullptr);
      continue;
    }
    const double goal = time.get<double>() + first_time - 1e-4;
    const auto found = std::lower_bound(errors.begin(), errors.end(), goal,
                                        [](const PoseError& e, double t) { return e.timestamp < t; });
    const bool there = found != errors.end() && found->timestamp < goal + 2e-4;
    column.push_back(there ? Json(rounded(1e3 * found->distance, 3)) : nullptr);
  }
  return column;
}

/// The truth while the estimate lasts: recordings of the truth start earlier and end later.
Trajectory common_part(const Trajectory& truth, const Trajectory& estimate) {
  Trajectory part;
  for (const StampedPose& pose : truth) {
    if (estimate.empty() || pose.timestamp < estimate.front().timestamp) continue;
    if (pose.timestamp <= estimate.back().timestamp) part.push_back(pose);
  }
  return part;
}

double length_of(const Trajectory& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path[i].timestamp - path[i - 1].timestamp > kMaxPathGap) continue;
    length += (path[i].world_from_cam.translation - path[i - 1].world_from_cam.translation).norm();
  }
  return length;
}

Json landmark_columns(const std::vector<Eigen::Vector3d>& landmarks, const DrawingFrame& frame) {
  constexpr std::size_t kMaxLandmarks = 3000;
  Json columns = {{"x", Json::array()}, {"y", Json::array()}};
  const std::size_t every = landmarks.size() / kMaxLandmarks + 1;
  for (std::size_t i = 0; i < landmarks.size(); i += every) {
    const Eigen::Vector3d drawn = frame(landmarks[i]);
    columns["x"].push_back(rounded(drawn.x(), 3));
    columns["y"].push_back(rounded(drawn.y(), 3));
  }
  return columns;
}

}  // namespace

DrawingFrame::DrawingFrame(const ReportPaths& paths)
    : of_truth_(paths.truth_from_estimate.has_value()),
      world_from_estimate_(paths.truth_from_estimate.value_or(Pose())) {
  // Positions that hardly differ do not say how the estimate is to be turned; then the truth tells how the
  // camera was held.
  const bool by_truth = of_truth_ && !paths.truth.empty() && extent_of(paths.estimate) < kMinExtent;
  Eigen::Vector3d up = Eigen::Vector3d::Zero();
  for (const StampedPose& pose : by_truth ? paths.truth : paths.estimate) {
    const Eigen::Vector3d up_there = pose.world_from_cam.rotation * up_in_camera(paths.rotation);
    up += by_truth ? up_there : world_from_estimate_.rotation * up_there;
  }
  if (up.isZero()) up = up_in_camera(paths.rotation);
  int axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  drawn_from_world_ = rotation_of_axes(axis, up[axis] < 0 ? -1 : 1);
}

Json DrawingFrame::names() const {
  Json names;
  for (int row = 0; row < 3; ++row) {
    int axis = 0;
    drawn_from_world_.row(row).cwiseAbs().maxCoeff(&axis);
    const char* const sign = drawn_from_world_(row, axis) < 0 ? "-" : "";
    names[std::string(1, "xyz"[row])] = sign + std::string(1, "xyz"[axis]);
  }
  names["world"] = of_truth_ ? "those of the ground truth, to which the estimate is aligned"
                             : "those of the first camera of the map";
  return names;
}

void add_paths(Json& run, const ReportPaths& paths, double first_time) {
  const DrawingFrame frame(paths);
  const auto drawn = [&](const Trajectory& path, bool true_path) {
    std::vector<Eigen::Vector3d> positions;
    for (const StampedPose& pose : path) {
      const Eigen::Vector3d& position = pose.world_from_cam.translation;
      positions.push_back(true_path ? frame.of_truth(position) : frame(position));
    }
    return positions;
  };
  run["length_m"] = rounded(length_of(paths.estimate), 3);
  run["axes"] = frame.names();
  run["trajectory"] = path_columns(paths.estimate, drawn(paths.estimate, false), first_time);
  if (!paths.errors.empty()) {
    run["trajectory"]["error_mm"] = errors_at(run["trajectory"]["time"], paths.errors, first_time);
  }
  if (paths.truth_from_estimate) {
    const Trajectory truth = common_part(paths.truth, paths.estimate);
    run["truth"] = path_columns(truth, drawn(truth, true), first_time);
  }
  if (!paths.keyframes.empty()) {
    run["keyframes"] = path_columns(paths.keyframes, drawn(paths.keyframes, false), first_time,
                                    std::numeric_limits<double>::infinity());
  }
  if (!paths.landmarks.empty()) run["landmarks"] = landmark_columns(paths.landmarks, frame);
}

}  // namespace stdc::app
