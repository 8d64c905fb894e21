#include "estimation/alignment.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace stdc {
namespace {

Eigen::Vector3d mean_of(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<Pose> align_points(std::span<const Eigen::Vector3d> source,
                                 std::span<const Eigen::Vector3d> target) {
  if (source.size() != target.size() || source.size() < 3) return std::nullopt;
  const Eigen::Vector3d source_mean = mean_of(source), target_mean = mean_of(target);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < source.size(); ++i) {
    covariance += (target[i] - target_mean) * (source[i] - source_mean).transpose();
  }
  if (!covariance.allFinite()) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Umeyama, Eq. 43: flip the least certain axis rather than return a reflection.
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0) signs.z() = -1;
  const Eigen::Matrix3d rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  // The rotation first: the translation must be taken with the rotation as it is after normalisation.
  Pose target_from_source(rotation, Eigen::Vector3d::Zero());
  target_from_source.translation = target_mean - target_from_source.rotation * source_mean;
  if (!target_from_source.is_finite()) return std::nullopt;
  return target_from_source;
}

}  // namespace stdc
