#include "tracking/tracked_frame.hpp"

#include <Eigen/LU>

namespace stdc {

/// Nothing is known of a pose that the matches do not determine: a variance of a kilometre squared says so.
Matrix6d TrackedFrame::covariance(const Matrix6d& information, const TrackingSettings& settings) {
  constexpr double kUnknown = 1e6;
  Matrix6d result = Matrix6d::Identity() * kUnknown;
  if (!(information.diagonal().minCoeff() > 0)) return result;
  const Matrix6d inverse = information.inverse();
  if (!inverse.allFinite() || !(inverse.diagonal().minCoeff() > 0)) return result;
  result = settings.covariance_scale * settings.covariance_scale * inverse;
  result.diagonal().head<3>().array() += settings.map_position_sigma * settings.map_position_sigma;
  result.diagonal().tail<3>().array() += settings.map_rotation_sigma * settings.map_rotation_sigma;
  return result;
}

}  // namespace stdc
