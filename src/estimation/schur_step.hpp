#pragma once

#include <vector>

#include "estimation/kernels/kernels.hpp"
#include "estimation/packed_bundle.hpp"

namespace stdc {

/// Solves the damped normal equations of a bundle adjustment: eliminates the points (Schur complement),
/// solves the reduced camera system, a block matrix, by Cholesky factorisation, and substitutes back (Triggs
/// et al., 'Bundle Adjustment - A Modern Synthesis', 2000, sec. 6).
class SchurStep {
 public:
  /// `packed` must outlive this.
  SchurStep(const kernels::Table& kernels, const PackedBundle& packed);

  /// Solves for the linearisation `terms` at `points`, with the share `damping` of the diagonal added to it
  /// (Levenberg-Marquardt). Writes the new points. False if the system is singular or not finite.
  bool solve(const std::vector<kernels::BundleTerm>& terms, const std::vector<kernels::BundlePoint>& points,
             double damping, std::vector<kernels::BundlePoint>* moved);

  /// After `solve`: what the camera in a row of the reduced system does, (rho, phi) [m, rad] in world axes:
  /// its centre goes by -rho, its rotation (cam_from_world) becomes itself times exp(phi).
  const double* camera_step(std::size_t slot) const { return step_[slot].value; }
  /// After `solve`: how much the linear model says that the cost falls.
  double expected_decrease() const { return expected_; }

 private:
  template <std::size_t count>
  struct alignas(64) Numbers {
    double value[count];
  };
  template <std::size_t count>
  static double* plain(std::vector<Numbers<count>>& list) {
    return reinterpret_cast<double*>(list.data());  // the kernels take arrays of plain doubles
  }
  void complete_camera(std::size_t slot, double damping);

  const kernels::Table& kernels_;
  const PackedBundle& packed_;
  std::vector<kernels::PointFactor> factors_;
  std::vector<kernels::CameraSum> cameras_;
  std::vector<Numbers<kernels::kBlock>> blocks_;
  std::vector<Numbers<kernels::kSegment>> step_, damped_;
  std::vector<Numbers<kernels::kScratch>> scratch_;
  double expected_ = 0;
};

}  // namespace stdc
