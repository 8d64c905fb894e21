#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "estimation/bundle_adjustment.hpp"
#include "estimation/huber.hpp"
#include "estimation/pose_optimisation.hpp"

/// The same cost functions as the optimisers of this folder, given to Ceres, with derivatives by hand: the
/// reference of tests and benchmarks.
namespace stdc::test::ceres_reference {

/// A pose as Ceres sees it: quaternion (x, y, z, w) and translation of cam_from_world; a left perturbation
/// (translation, rotation). The cost functions give derivatives by the perturbation in the first 6 of the 7
/// columns, so the manifold's own derivative is [I; 0].
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* sum) const override {
    const Pose pose(Eigen::Quaterniond(x[3], x[0], x[1], x[2]), Eigen::Vector3d(x[4], x[5], x[6]));
    const Pose moved = Pose::exp(Eigen::Map<const Vector6d>(delta)) * pose;
    Eigen::Map<Eigen::Vector4d>(sum) << moved.rotation.vec(), moved.rotation.w();
    Eigen::Map<Eigen::Vector3d>(sum + 4) = moved.translation;
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool Minus(const double*, const double*, double*) const override { return false; }
  bool MinusJacobian(const double*, double*) const override { return false; }
};

/// The pixel (2 rows) or the inverse depth (1 row) of a point in a camera, in units of their sigmas.
template <int rows>
class Residual final : public ceres::SizedCostFunction<rows, 7, 3> {
 public:
  using Rows = Eigen::Matrix<double, rows, 1>;
  Residual(const Camera& camera, const Rows& measured, double inverse_sigma)
      : camera_(camera), measured_(measured), inverse_sigma_(inverse_sigma) {}

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    const Eigen::Quaterniond q(x[0][3], x[0][0], x[0][1], x[0][2]);
    const Eigen::Vector3d p = q * Eigen::Map<const Eigen::Vector3d>(x[1]) + Eigen::Vector3d(x[0] + 4);
    const double iz = 1.0 / p.z();
    Eigen::Matrix<double, rows, 3> by_point;
    Rows predicted;
    if constexpr (rows == 2) {
      predicted = camera_.project(p);
      by_point << camera_.fx * iz, 0, -camera_.fx * p.x() * iz * iz, 0, camera_.fy * iz,
          -camera_.fy * p.y() * iz * iz;
    } else {
      predicted[0] = iz;
      by_point << 0, 0, -iz * iz;
    }
    Eigen::Map<Rows>{residuals} = inverse_sigma_ * (predicted - measured_);
    if (jacobians == nullptr) return true;
    by_point *= inverse_sigma_;
    if (jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, rows, 7, Eigen::RowMajor>> j(jacobians[0]);
      j.template leftCols<3>() = by_point;
      j.template middleCols<3>(3) = -by_point * skew(p);
      j.template rightCols<1>().setZero();
    }
    if (jacobians[1] != nullptr) {
      using Block = Eigen::Matrix<double, rows, 3, Eigen::RowMajor>;
      Eigen::Map<Block>{jacobians[1]} = by_point * q.toRotationMatrix();
    }
    return true;
  }

 private:
  Camera camera_;
  Rows measured_;
  double inverse_sigma_;
};

/// Parameters and cost of a problem in Ceres' form.
struct Model {
  std::vector<std::array<double, 7>> poses;
  std::vector<Eigen::Vector3d> points;
  ceres::Problem problem;

  void add_pose(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    const Eigen::Vector3d& t = pose.translation;
    poses.push_back({q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()});
  }
  Pose pose(std::size_t k) const {
    const auto& x = poses[k];
    return Pose(Eigen::Quaterniond(x[3], x[0], x[1], x[2]), Eigen::Vector3d(x[4], x[5], x[6]));
  }
  void add(const Camera& camera, const NoiseSettings& noise, std::size_t pose, std::size_t point,
           const Eigen::Vector2d& pixel, double depth, double scale) {
    problem.AddResidualBlock(new Residual<2>(camera, pixel, 1.0 / (noise.pixel_sigma * scale)),
                             new ceres::HuberLoss(std::sqrt(kChiSquare95Pixel)), poses[pose].data(),
                             points[point].data());
    if (!(depth > 0)) return;
    problem.AddResidualBlock(
        new Residual<1>(camera, Eigen::Matrix<double, 1, 1>(1.0 / depth), 1.0 / noise.inverse_depth_sigma),
        new ceres::HuberLoss(std::sqrt(kChiSquare95Depth)), poses[pose].data(), points[point].data());
  }
  double cost() {
    double value = 0;
    problem.Evaluate({}, &value, nullptr, nullptr, nullptr);
    return value;
  }
};

inline std::unique_ptr<Model> make_bundle(const Camera& camera, const BundleProblem& bundle,
                                          const NoiseSettings& noise) {
  auto model = std::make_unique<Model>();
  for (const Pose& pose : bundle.cam_from_world) model->add_pose(pose);
  model->points = bundle.points;
  for (const BundleObservation& o : bundle.observations) {
    model->add(camera, noise, static_cast<std::size_t>(o.pose), static_cast<std::size_t>(o.point),
               o.pixel.cast<double>(), o.depth, o.scale);
  }
  for (std::size_t k = 0; k < model->poses.size(); ++k) {
    double* pose = model->poses[k].data();
    if (!model->problem.HasParameterBlock(pose)) continue;
    model->problem.SetManifold(pose, new PoseManifold);
    if (bundle.pose_fixed[k] != 0) model->problem.SetParameterBlockConstant(pose);
  }
  return model;
}

inline std::unique_ptr<Model> make_pose(const Camera& camera, std::span<const PoseObservation> observations,
                                        const Pose& initial, const NoiseSettings& noise) {
  auto model = std::make_unique<Model>();
  model->add_pose(initial);
  for (const PoseObservation& o : observations) model->points.push_back(o.point_in_world);
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const PoseObservation& o = observations[i];
    model->add(camera, noise, 0, i, o.pixel, o.depth, o.scale);
    model->problem.SetParameterBlockConstant(model->points[i].data());
  }
  model->problem.SetManifold(model->poses[0].data(), new PoseManifold);
  return model;
}

/// Single-threaded Levenberg-Marquardt; 0 as tolerance: until nothing changes.
inline ceres::Solver::Options options(ceres::LinearSolverType solver, int iterations, double tolerance) {
  ceres::Solver::Options result;
  result.linear_solver_type = solver;
  result.max_num_iterations = iterations;
  result.function_tolerance = tolerance;
  result.gradient_tolerance = 0;
  result.parameter_tolerance = 0;
  result.num_threads = 1;
  result.logging_type = ceres::SILENT;
  return result;
}

}  // namespace stdc::test::ceres_reference
