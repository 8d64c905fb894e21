#include "tracking/moving_groups.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace stdc {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix36d = Eigen::Matrix<double, 3, 6>;

/// One match: its residual (pixel, inverse depth) and weights, and how both depend on the pose.
struct Term {
  int match = 0;
  Vector3d point;  ///< in the camera [m]
  Eigen::Vector2d pixel;
  Vector3d residual;  ///< measured minus projected [px, px, 1/m]; 0 where no depth was measured
  Vector3d weight;    ///< 1 / sigma^2
};

/// Derivative of the projection by a left perturbation of the pose.
Matrix36d jacobian_at(const Camera& camera, const Vector3d& point) {
  const double z = 1 / point.z();
  Matrix3d by_point;
  by_point << camera.fx * z, 0, -camera.fx * point.x() * z * z,  //
      0, camera.fy * z, -camera.fy * point.y() * z * z,          //
      0, 0, -z * z;
  Matrix36d jacobian;
  jacobian.leftCols<3>() = by_point;
  jacobian.rightCols<3>() = -by_point * skew(point);
  return jacobian;
}

Term make_term(const SensorModel& sensor, const TrackedFrame& frame, const FrameMatch& match, int index) {
  Term term;
  term.match = index;
  term.point = frame.cam_from_world * match.position;
  term.pixel = sensor.camera.project(term.point);
  const Measurement& measurement = frame.measurements[match.keypoint];
  const double pixel_sigma = sensor.noise.pixel_sigma * measurement.scale;
  const double depth_sigma = sensor.noise.inverse_depth_sigma;
  const bool has_depth = measurement.depth > 0;
  term.residual << measurement.pixel.cast<double>() - term.pixel,
      has_depth ? 1 / static_cast<double>(measurement.depth) - 1 / term.point.z() : 0;
  term.weight << 1 / (pixel_sigma * pixel_sigma), 1 / (pixel_sigma * pixel_sigma),
      has_depth ? 1 / (depth_sigma * depth_sigma) : 0;
  return term;
}

/// The middle one of some numbers.
double middle_of(std::vector<double>& values) {
  const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), half, values.end());
  return *half;
}

/// The middle residual of a group in the image, in x and in y: some of its matches are wrong.
Eigen::Vector2d middle_residual(const std::vector<const Term*>& group) {
  std::vector<double> x, y;
  for (const Term* term : group) {
    x.push_back(term->residual.x());
    y.push_back(term->residual.y());
  }
  return {middle_of(x), middle_of(y)};
}

/// How far a group is from where the pose that the others give would put it.
struct DeletedShift {
  Eigen::Vector2d mean, middle;  ///< [px], over its matches
  Eigen::Matrix2d expected;      ///< covariance of `mean` by the noise of the matches [px^2]
};

/// Nothing if it cannot be told.
std::optional<DeletedShift> deleted_shift(const Camera& camera, const Matrix6d& information,
                                          const std::vector<const Term*>& group) {
  constexpr std::size_t kMinSize = 5;
  if (group.size() < kMinSize) return std::nullopt;
  Vector3d centre = Vector3d::Zero(), weight = Vector3d::Zero(), residual = Vector3d::Zero();
  for (const Term* term : group) {
    centre += term->point;
    weight += term->weight;
    residual += term->weight.cwiseProduct(term->residual);
  }
  centre /= static_cast<double>(group.size());
  for (int i = 0; i < 3; ++i) residual[i] = weight[i] > 0 ? residual[i] / weight[i] : 0;
  const Matrix36d jacobian = jacobian_at(camera, centre);
  const Matrix6d others = information - jacobian.transpose() * weight.asDiagonal() * jacobian;
  const Eigen::FullPivLU<Matrix6d> factors(others);
  if (!factors.isInvertible()) return std::nullopt;
  const Matrix6d covariance = factors.inverse();
  // Most of what is known of the pose comes from this group: there is nothing to judge it by.
  if (!(covariance.diagonal().minCoeff() > 0)) return std::nullopt;
  const Matrix3d influence = jacobian * covariance * jacobian.transpose();
  constexpr double kMaxUnsure = 0.5;  // [px^2] where the others say little, neither party is to be believed
  if (influence.topLeftCorner<2, 2>().trace() > kMaxUnsure) return std::nullopt;
  const Vector3d pulled = influence * weight.cwiseProduct(residual);
  DeletedShift shift;
  shift.mean = (residual + pulled).head<2>();
  shift.middle = middle_residual(group) + pulled.head<2>();
  shift.expected = influence.topLeftCorner<2, 2>();
  shift.expected.diagonal() += weight.head<2>().cwiseInverse();
  return shift;
}

/// Whether a group contradicts the pose that the others give. `blur` [px]: errors that the motion of the
/// camera adds to a whole group.
bool contradicts(const DeletedShift& shift, double blur) {
  constexpr double kMinShift = 1.5;   // [px]
  constexpr double kMapError = 0.45;  // [px] the map's own errors do not average out in a group either
  constexpr double kGate = 9.2;       // chi-square, 2 degrees, 99 %
  const double common = kMapError + blur;
  Eigen::Matrix2d expected = shift.expected;
  expected.diagonal() += Eigen::Vector2d::Constant(common * common);
  return shift.mean.norm() > kMinShift + 2 * blur && shift.mean.dot(expected.inverse() * shift.mean) > kGate;
}

std::vector<Term> make_terms(const SensorModel& sensor, const TrackedFrame& frame,
                             const std::vector<FrameMatch>& matches) {
  std::vector<Term> terms;
  for (int i = 0; i < static_cast<int>(matches.size()); ++i) {
    terms.push_back(make_term(sensor, frame, matches[static_cast<std::size_t>(i)], i));
    if (!(terms.back().point.z() > 0.05)) terms.pop_back();
  }
  return terms;
}

/// Errors that the motion of the camera adds to a whole group [px].
double motion_blur(const SensorModel& sensor, const TrackedFrame& frame) {
  const double time_error = 0.001 + 0.15 * sensor.camera.readout_time;  // [s] of a row against the pose
  return sensor.camera.fx * time_error * frame.motion.twist.tail<3>().norm();
}

/// Overlapping squares and ranges of depth, so that most things lie within one.
template <typename Visit>
void for_groups(const Camera& camera, const std::vector<Term>& terms, Visit&& visit) {
  constexpr double kColumns = 4, kDepthStep = 0.3;  // depth by its logarithm
  const double side = static_cast<double>(camera.width) / kColumns;
  for (int variant = 0; variant < 8; ++variant) {
    const double dx = (variant & 1) * 0.5, dy = ((variant >> 1) & 1) * 0.5, dz = (variant >> 2) * 0.5;
    std::map<std::array<int, 3>, std::vector<const Term*>> groups;
    for (const Term& term : terms) {
      groups[{static_cast<int>(std::floor(term.pixel.x() / side + dx)),
              static_cast<int>(std::floor(term.pixel.y() / side + dy)),
              static_cast<int>(std::floor(std::log(term.point.z()) / kDepthStep + dz))}]
          .push_back(&term);
    }
    for (const auto& [key, group] : groups) visit(GroupPlace{variant, key[0], key[1], key[2]}, group);
  }
}

}  // namespace

std::vector<std::uint8_t> find_moving_groups(const SensorModel& sensor, const TrackedFrame& frame,
                                             const std::vector<FrameMatch>& inliers, GroupNoise& noise) {
  constexpr std::size_t kMinToCompare = 10;  // of so many the middle one is good to a fraction of the noise
  std::vector<std::uint8_t> moving(inliers.size(), 0);
  if (!(frame.information.diagonal().minCoeff() > 0)) return moving;
  const std::vector<Term> terms = make_terms(sensor, frame, inliers);
  const double blur = motion_blur(sensor, frame);
  struct Candidate {
    GroupPlace place;
    std::vector<const Term*> group;
    double shift = 0;
  };
  std::vector<Candidate> candidates;
  std::vector<double> shifts;
  const auto mark = [&](const std::vector<const Term*>& group) {
    for (const Term* term : group) moving[static_cast<std::size_t>(term->match)] = 1;
  };
  for_groups(sensor.camera, terms, [&](const GroupPlace& place, const std::vector<const Term*>& group) {
    const std::optional<DeletedShift> shift = deleted_shift(sensor.camera, frame.information, group);
    if (!shift) return;
    if (contradicts(*shift, blur)) mark(group);
    if (group.size() < kMinToCompare) return;
    candidates.push_back({place, group, shift->middle.norm()});
    shifts.push_back(candidates.back().shift);
  });
  if (!shifts.empty()) noise.add(frame.timestamp, middle_of(shifts));
  const double threshold = noise.threshold(frame.timestamp);
  std::vector<std::uint8_t> off(inliers.size(), 0);
  for (const Candidate& candidate : candidates) {
    if (candidate.shift < threshold) continue;
    noise.note_off(candidate.place);
    if (!noise.was_off(candidate.place)) continue;
    for (const Term* term : candidate.group) off[static_cast<std::size_t>(term->match)] = 1;
  }
  // Where many are off by so little, it may be the others that move and have taken the pose along.
  constexpr double kMaxShare = 0.12;
  if (static_cast<double>(std::count(off.begin(), off.end(), 1)) <
      kMaxShare * static_cast<double>(off.size())) {
    for (std::size_t i = 0; i < off.size(); ++i) moving[i] |= off[i];
  }
  const auto count = std::count(moving.begin(), moving.end(), 1);
  if (2 * static_cast<std::size_t>(count) > inliers.size()) std::fill(moving.begin(), moving.end(), 0);
  return moving;
}

std::vector<Contradiction> find_contradicting_groups(const SensorModel& sensor, const TrackedFrame& frame,
                                                     const Matrix6d& covariance,
                                                     const std::vector<FrameMatch>& matches) {
  constexpr std::size_t kMinSize = 5;
  constexpr double kMinShift = 1.2, kMapError = 0.45, kSpread = 0.7;  // [px]
  constexpr double kLikely = 6.0, kSure = 13.8;                       // chi-square, 2 degrees: 95 %, 99.9 %
  std::vector<Contradiction> contradicting(matches.size(), Contradiction::none);
  const std::vector<Term> terms = make_terms(sensor, frame, matches);
  // Wider than above: in a fast turn the pose that older landmarks give is the one that suffers most.
  const double blur = 3 * motion_blur(sensor, frame);
  for_groups(sensor.camera, terms, [&](const GroupPlace&, const std::vector<const Term*>& group) {
    if (group.size() < kMinSize) return;
    Vector3d centre = Vector3d::Zero();
    for (const Term* term : group) centre += term->point / static_cast<double>(group.size());
    const Eigen::Vector2d shift = middle_residual(group);
    const Matrix36d jacobian = jacobian_at(sensor.camera, centre);
    // More: they were put into the map from a pose that was not known exactly either.
    Eigen::Matrix2d expected = 1.3 * (jacobian * covariance * jacobian.transpose()).topLeftCorner<2, 2>();
    const double common = kMapError + blur;
    expected.diagonal().array() += common * common + kSpread * kSpread / static_cast<double>(group.size());
    const double distance = shift.dot(expected.inverse() * shift);
    if (shift.norm() < kMinShift + 2 * blur || distance < kLikely) return;
    const Contradiction degree = distance < kSure ? Contradiction::likely : Contradiction::sure;
    for (const Term* term : group) {
      Contradiction& known = contradicting[static_cast<std::size_t>(term->match)];
      known = std::max(known, degree);
    }
  });
  return contradicting;
}

}  // namespace stdc
