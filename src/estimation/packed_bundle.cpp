#include "estimation/packed_bundle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stdc {
namespace {

using kernels::kLanes;

// Larger coordinates [m or px] are taken for garbage; squares of them would overflow further down.
constexpr double kLargest = 1e8;

bool fits_together(const BundleProblem& problem) {
  const auto poses = static_cast<std::int64_t>(problem.cam_from_world.size());
  const auto points = static_cast<std::int64_t>(problem.points.size());
  if (problem.pose_fixed.size() != problem.cam_from_world.size()) return false;
  return std::all_of(problem.observations.begin(), problem.observations.end(), [&](const auto& o) {
    return o.pose >= 0 && o.pose < poses && o.point >= 0 && o.point < points;
  });
}

bool is_sane(const BundleProblem& problem, const BundleObservation& o) {
  const Eigen::Vector3d& point = problem.points[static_cast<std::size_t>(o.point)];
  return point.allFinite() && point.cwiseAbs().maxCoeff() < kLargest && o.pixel.allFinite() &&
         o.pixel.cwiseAbs().maxCoeff() < kLargest && o.scale > 0 && std::isfinite(o.scale);
}

/// Indices of the sane observations, grouped by point; `point_start` gets the groups' limits.
std::vector<std::uint32_t> group_by_point(const BundleProblem& problem,
                                          std::vector<std::uint32_t>* point_start) {
  std::vector<std::uint8_t> sane(problem.observations.size());
  point_start->assign(problem.points.size() + 1, 0);
  for (std::size_t i = 0; i < sane.size(); ++i) {
    const BundleObservation& o = problem.observations[i];
    sane[i] = is_sane(problem, o) ? 1 : 0;
    (*point_start)[static_cast<std::size_t>(o.point) + 1] += sane[i];
  }
  std::partial_sum(point_start->begin(), point_start->end(), point_start->begin());
  std::vector<std::uint32_t> next = *point_start, order(point_start->back());
  for (std::size_t i = 0; i < sane.size(); ++i) {
    if (sane[i] == 0) continue;
    order[next[static_cast<std::size_t>(problem.observations[i].point)]++] = static_cast<std::uint32_t>(i);
  }
  return order;
}

/// Of each pose: its number among those that move and are seen by an observation, or -1.
std::vector<std::int32_t> number_moving(const BundleProblem& problem,
                                        const std::vector<std::uint32_t>& order) {
  std::vector<std::uint8_t> moving(problem.pose_fixed.size(), 0);
  for (const std::uint32_t i : order) moving[static_cast<std::size_t>(problem.observations[i].pose)] = 1;
  bool any_fixed = false;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    any_fixed = any_fixed || problem.pose_fixed[k] != 0;
    if (problem.pose_fixed[k] != 0) moving[k] = 0;
  }
  if (!any_fixed && !moving.empty()) moving[0] = 0;
  std::vector<std::int32_t> number(moving.size(), -1);
  std::int32_t count = 0;
  for (std::size_t k = 0; k < moving.size(); ++k) {
    if (moving[k] != 0) number[k] = count++;
  }
  return number;
}

/// Which moving cameras see a point in common.
BlockPattern common_points(const BundleProblem& problem, const std::vector<std::uint32_t>& order,
                           const std::vector<std::uint32_t>& point_start,
                           const std::vector<std::int32_t>& number) {
  BlockPattern pattern(static_cast<std::size_t>(*std::max_element(number.begin(), number.end()) + 1));
  const auto number_of = [&](std::uint32_t place) {
    return number[static_cast<std::size_t>(problem.observations[order[place]].pose)];
  };
  for (std::size_t p = 0; p + 1 < point_start.size(); ++p) {
    for (std::uint32_t a = point_start[p]; a < point_start[p + 1]; ++a) {
      if (number_of(a) < 0) continue;
      for (std::uint32_t b = point_start[p]; b < a; ++b) {
        if (number_of(b) < 0) continue;
        pattern.connect(static_cast<std::size_t>(number_of(a)), static_cast<std::size_t>(number_of(b)));
      }
    }
  }
  return pattern;
}

void choose_slots(const BundleProblem& problem, const std::vector<std::int32_t>& number, BlockPattern pattern,
                  std::vector<std::int32_t>* pose_slot, PackedBundle* packed) {
  const std::vector<std::int32_t> order = pattern.elimination_order();
  packed->pattern = pattern.permuted(order);
  packed->pattern.eliminate();
  std::vector<std::int32_t> slot_of_number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    slot_of_number[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  pose_slot->assign(problem.pose_fixed.size(), -1);
  packed->slot_pose.resize(order.size());
  for (std::size_t k = 0; k < number.size(); ++k) {
    if (number[k] < 0) continue;
    const std::int32_t slot = slot_of_number[static_cast<std::size_t>(number[k])];
    (*pose_slot)[k] = slot;
    packed->slot_pose[static_cast<std::size_t>(slot)] = static_cast<std::int32_t>(k);
  }
}

/// Orders the observations of each point by slot, and lists the block of each pair of them.
void order_observations(const BundleProblem& problem, const std::vector<std::int32_t>& pose_slot,
                        PackedBundle* packed) {
  const auto slot_of = [&](std::uint32_t i) {
    return pose_slot[static_cast<std::size_t>(problem.observations[i].pose)];
  };
  packed->slot.resize(packed->origin.size());
  for (std::size_t p = 0; p + 1 < packed->point_start.size(); ++p) {
    const std::uint32_t begin = packed->point_start[p], end = packed->point_start[p + 1];
    std::sort(packed->origin.begin() + begin, packed->origin.begin() + end,
              [&](std::uint32_t a, std::uint32_t b) {
                return std::pair(slot_of(a), a) < std::pair(slot_of(b), b);
              });
    std::uint32_t first = begin;
    for (std::uint32_t o = begin; o < end; ++o) {
      packed->slot[o] = slot_of(packed->origin[o]);
      if (packed->slot[o] < 0) first = o + 1;
      for (std::uint32_t other = first; other < o; ++other) {
        packed->pair_block.push_back(packed->pattern.block(static_cast<std::size_t>(packed->slot[o]),
                                                           static_cast<std::size_t>(packed->slot[other])));
      }
    }
    packed->most_moving = std::max<std::size_t>(packed->most_moving, end - first);
  }
  packed->diagonal_block.assign(packed->pattern.starts().begin(), packed->pattern.starts().end() - 1);
}

void fill_lanes(const BundleProblem& problem, const NoiseSettings& noise, PackedBundle* packed) {
  packed->fours.resize((packed->origin.size() + kLanes - 1) / kLanes);  // zeroed: empty lanes weigh nothing
  for (std::size_t k = 0; k < packed->origin.size(); ++k) {
    const BundleObservation& o = problem.observations[packed->origin[k]];
    kernels::BundleFour& four = packed->fours[k / kLanes];
    const std::size_t lane = k % kLanes;
    const bool has_depth = o.depth > 0 && std::isfinite(o.depth);
    four.u[lane] = o.pixel.x();
    four.v[lane] = o.pixel.y();
    four.inverse_depth[lane] = has_depth ? 1.0F / o.depth : 0.0F;
    four.inverse_sigma[lane] = static_cast<float>(1.0 / (noise.pixel_sigma * o.scale));
    four.depth_weight[lane] = has_depth ? static_cast<float>(1.0 / noise.inverse_depth_sigma) : 0.0F;
    four.used_inverse_sigma[lane] = four.inverse_sigma[lane];
    four.used_depth_weight[lane] = four.depth_weight[lane];
    four.pose[lane] = o.pose;
    four.point[lane] = o.point;
  }
}

}  // namespace

std::optional<PackedBundle> pack_bundle(const BundleProblem& problem, const NoiseSettings& noise) {
  if (!fits_together(problem)) return std::nullopt;
  if (!std::all_of(problem.cam_from_world.begin(), problem.cam_from_world.end(),
                   [](const Pose& pose) { return pose.is_finite(); })) {
    return std::nullopt;
  }
  PackedBundle packed;
  packed.origin = group_by_point(problem, &packed.point_start);
  if (packed.origin.empty()) return std::nullopt;
  const std::vector<std::int32_t> number = number_moving(problem, packed.origin);
  std::vector<std::int32_t> pose_slot;
  choose_slots(problem, number, common_points(problem, packed.origin, packed.point_start, number), &pose_slot,
               &packed);
  order_observations(problem, pose_slot, &packed);
  fill_lanes(problem, noise, &packed);
  return packed;
}

}  // namespace stdc
