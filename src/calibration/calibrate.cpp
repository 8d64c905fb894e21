#include "calibration/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/quadratic_fit.hpp"

namespace stdc {
namespace {

using Parameters = std::vector<CalibrationParameter>;

/// How a parameter is gone about; by CalibrationParameter.
struct Search {
  double step;       ///< between the samples of the first round
  double min_step;   ///< less would show how depth pixels scatter, and not how
                     ///< the cost changes
  double max_sigma;  ///< beyond which it counts as not seen
};
constexpr std::array<Search, kCalibrationParameters> kSearch{{
    {0.015, 0.004, 0.008},  // depth_time_offset [s]
    {0.008, 0.003, 0.006},  // readout_time [s]
    {0.01, 0.004, 0.006},   // focal_length, a factor
    {4, 1.5, 3},            // cx [px]
    {4, 1.5, 3},            // cy [px]
}};

const Search& search_of(CalibrationParameter parameter) {
  return kSearch[static_cast<std::size_t>(parameter)];
}

CalibrationValues moved(CalibrationValues values, const Parameters& wanted, const Eigen::VectorXd& by) {
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    double& value = value_of(values, wanted[i]);
    value += by[static_cast<Eigen::Index>(i)];
    if (wanted[i] == CalibrationParameter::readout_time) value = std::max(value, 0.0);
  }
  return values;
}

/// By quadratic_samples().
std::vector<CalibrationValues> sample_values(const CalibrationValues& values, const Parameters& wanted,
                                             const Eigen::VectorXd& steps) {
  std::vector<CalibrationValues> samples;
  for (const Eigen::VectorXd& place : quadratic_samples(steps.size()))
    samples.push_back(moved(values, wanted, place.cwiseProduct(steps)));
  return samples;
}

/// Depth may be late by several frames: the lowest of samples over a quarter of
/// a second is where to start.
double scan_time_offset(CalibrationProblem& problem, const CalibrationValues& values) {
  using enum CalibrationParameter;
  constexpr int kSide = 6;
  constexpr double kStep = 0.02;  // [s]
  std::vector<CalibrationValues> samples;
  for (int k = -kSide; k <= kSide; ++k) {
    samples.push_back(values);
    value_of(samples.back(), depth_time_offset) += k * kStep;
  }
  problem.choose_common_depths(samples);
  double best = value_of(values, depth_time_offset);
  std::optional<double> lowest;
  for (const CalibrationValues& sample : samples) {
    const auto cost = problem.cost(sample);
    if (cost && (!lowest || *cost < *lowest)) lowest = cost, best = value_of(sample, depth_time_offset);
  }
  return best;
}

class Calibrator {
 public:
  Calibrator(const CalibrationScene& scene, const CalibrationValues& given, Parameters wanted,
             std::function<void(int)> on_fit)
      : problem_(scene, given),
        values_(given),
        wanted_(std::move(wanted)),
        steps_(static_cast<Eigen::Index>(wanted_.size())),
        on_fit_(std::move(on_fit)) {
    for (std::size_t i = 0; i < wanted_.size(); ++i)
      steps_[static_cast<Eigen::Index>(i)] = search_of(wanted_[i]).step;
  }

  void search() {
    constexpr int kMaxRounds = 10;
    if (std::find(wanted_.begin(), wanted_.end(), CalibrationParameter::depth_time_offset) != wanted_.end()) {
      value_of(values_, CalibrationParameter::depth_time_offset) = scan_time_offset(problem_, values_);
    }
    for (int round = 0; round < kMaxRounds; ++round) {
      settle();
      const auto found = fit();
      if (!found) return;
      const Eigen::VectorXd step = step_to_minimum(*found);
      values_ = moved(values_, wanted_, step.cwiseProduct(steps_));
      if (adapt_steps(*found) && step.cwiseAbs().maxCoeff() < 0.1) return;
    }
  }

  /// By parameter; infinite where nothing is seen.
  Eigen::VectorXd sigmas() {
    const auto n = static_cast<Eigen::Index>(wanted_.size());
    settle();
    const auto found = fit();
    Eigen::VectorXd sigma = Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
    if (!found || !found->is_convex) return sigma;
    sigma = deviations(*found).cwiseProduct(steps_);
    return sigma.cwiseMax(jackknife(false)).cwiseMax(jackknife(true));
  }

  const CalibrationValues& values() const { return values_; }
  const CalibrationProblem& problem() const { return problem_; }

 private:
  /// Takes samples around the values; only depths that all of them have may count, since their costs are
  /// compared.
  void settle() {
    samples_ = sample_values(values_, wanted_, steps_);
    problem_.choose_common_depths(samples_);
    problem_.settle(values_);
  }

  std::optional<Quadratic> fit() {
    if (on_fit_) on_fit_(++fits_);
    std::vector<double> costs;
    for (const CalibrationValues& values : samples_) {
      const auto cost = problem_.cost(values);
      if (!cost) return std::nullopt;
      costs.push_back(*cost);
    }
    return fit_quadratic(costs, steps_.size());
  }

  /// Makes steps of about three standard deviations: there the cost differs
  /// clearly, and is still quadratic. Whether they were so already.
  bool adapt_steps(const Quadratic& fit) {
    constexpr double kSigmas = 3, kAlike = 1.5;
    if (!fit.is_convex) return false;
    const Eigen::VectorXd sigmas = deviations(fit).cwiseProduct(steps_);
    bool settled = true;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const Search& search = search_of(wanted_[i]);
      double& step = steps_[static_cast<Eigen::Index>(i)];
      const double next =
          std::clamp(kSigmas * sigmas[static_cast<Eigen::Index>(i)], search.min_step, search.step);
      settled = settled && next < kAlike * step && step < kAlike * next;
      step = next;
    }
    return settled;
  }

  /// How much the result depends on which part of the data there is.
  Eigen::VectorXd jackknife(bool of_views) {
    constexpr int kGroups = 5;
    const auto n = static_cast<Eigen::Index>(wanted_.size());
    std::vector<Eigen::VectorXd> results;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
    for (int group = 0; group < kGroups; ++group) {
      problem_.leave_out({group, kGroups, of_views});
      const auto found = fit();
      if (!found || !found->is_convex) continue;
      results.push_back(step_to_minimum(*found).cwiseProduct(steps_));
      mean += results.back();
    }
    problem_.leave_out({});
    if (results.size() < 3) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity());
    const auto count = static_cast<double>(results.size());
    mean /= count;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (const Eigen::VectorXd& result : results) sum += (result - mean).cwiseAbs2();
    return ((count - 1) / count * sum).cwiseSqrt();
  }

  CalibrationProblem problem_;
  CalibrationValues values_;
  Parameters wanted_;
  Eigen::VectorXd steps_;
  std::vector<CalibrationValues> samples_;
  std::function<void(int)> on_fit_;
  int fits_ = 0;
};

Calibration estimate(const CalibrationScene& scene, const CalibrationValues& given, const Parameters& wanted,
                     const std::function<void(int)>& on_fit) {
  Calibrator calibrator(scene, given, wanted, on_fit);
  Calibration result;
  result.values = given;
  result.keyframes = static_cast<int>(scene.views.size());
  result.points = static_cast<int>(scene.problem.points.size());
  result.observations = calibrator.problem().observations();
  calibrator.search();
  const Eigen::VectorXd sigmas = calibrator.sigmas();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    CalibratedValue value{wanted[i], value_of(given, wanted[i]), value_of(calibrator.values(), wanted[i]),
                          sigmas[static_cast<Eigen::Index>(i)]};
    value.seen = value.sigma <= search_of(wanted[i]).max_sigma;
    if (value.seen) {
      value_of(result.values, wanted[i]) = value.value;
    } else {
      value.value = value.given;
    }
    result.estimates.push_back(value);
  }
  return result;
}

bool is_intrinsic(CalibrationParameter parameter) { return parameter >= CalibrationParameter::focal_length; }

}  // namespace

Calibration calibrate(const CalibrationScene& scene, const CalibrationValues& given, const Parameters& wanted,
                      const std::function<void(int)>& on_fit) {
  Calibration all = estimate(scene, given, wanted, on_fit);
  const bool any =
      std::any_of(all.estimates.begin(), all.estimates.end(), [](const auto& value) { return value.seen; });
  Parameters times = wanted;
  std::erase_if(times, is_intrinsic);
  if (any || times.empty() || times.size() == wanted.size()) return all;
  // Together they do not show; times may by themselves.
  Calibration result = estimate(scene, given, times, on_fit);
  for (const CalibratedValue& value : all.estimates) {
    if (is_intrinsic(value.parameter)) result.estimates.push_back(value);
  }
  return result;
}

}  // namespace stdc
