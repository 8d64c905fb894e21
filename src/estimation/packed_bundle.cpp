#include "estimation/packed_bundle.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stdc {
namespace {

using kernels::kLanes;

// Larger coordinates [m or px] are taken for garbage; squares of them would overflow further down.
constexpr double kMaxValue = 1e8;

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
  return point.allFinite() && point.cwiseAbs().maxCoeff() < kMaxValue && o.pixel.allFinite() &&
         o.pixel.cwiseAbs().maxCoeff() < kMaxValue && o.scale > 0 && std::isfinite(o.scale);
}

std::vector<std::uint32_t> sane_observations(const BundleProblem& problem) {
  std::vector<std::uint32_t> sane;
  sane.reserve(problem.observations.size());
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    if (is_sane(problem, problem.observations[i])) sane.push_back(static_cast<std::uint32_t>(i));
  }
  return sane;
}

/// Sorts observations by a key in 0..keys-1, keeping their order where it is equal; `start` gets the first of
/// each key, and the end.
template <typename Key>
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& list, std::size_t keys, Key key,
                                     std::vector<std::uint32_t>* start) {
  start->assign(keys + 1, 0);
  for (const std::uint32_t i : list) ++(*start)[static_cast<std::size_t>(key(i)) + 1];
  std::partial_sum(start->begin(), start->end(), start->begin());
  std::vector<std::uint32_t> next = *start, result(list.size());
  for (const std::uint32_t i : list) result[next[static_cast<std::size_t>(key(i))]++] = i;
  return result;
}

/// Of each pose: its number among those that move and are seen by an observation, or -1.
std::vector<std::int32_t> number_moving(const BundleProblem& problem,
                                        const std::vector<std::uint32_t>& sane) {
  std::vector<std::uint8_t> moving(problem.pose_fixed.size(), 0);
  for (const std::uint32_t i : sane) moving[static_cast<std::size_t>(problem.observations[i].pose)] = 1;
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

/// Which moving cameras see a point in common; `order`: observations by moving cameras, grouped by point.
BlockPattern common_points(const BundleProblem& problem, const std::vector<std::uint32_t>& order,
                           const std::vector<std::uint32_t>& start, const std::vector<std::int32_t>& number) {
  BlockPattern pattern(static_cast<std::size_t>(*std::max_element(number.begin(), number.end()) + 1));
  std::vector<std::size_t> seen_by;
  for (std::size_t p = 0; p + 1 < start.size(); ++p) {
    seen_by.clear();
    for (std::uint32_t k = start[p]; k < start[p + 1]; ++k) {
      const auto pose = static_cast<std::size_t>(problem.observations[order[k]].pose);
      seen_by.push_back(static_cast<std::size_t>(number[pose]));
      for (std::size_t other = 0; other + 1 < seen_by.size(); ++other) {
        pattern.connect(seen_by.back(), seen_by[other]);
      }
    }
  }
  return pattern;
}

/// Of each pose: its row in the reduced system, or -1.
std::vector<std::int32_t> choose_slots(const BundleProblem& problem, const std::vector<std::uint32_t>& sane,
                                       const std::vector<std::int32_t>& number, PackedBundle* packed) {
  const auto number_of = [&](std::uint32_t i) {
    return number[static_cast<std::size_t>(problem.observations[i].pose)];
  };
  std::vector<std::uint32_t> moving, start;
  for (const std::uint32_t i : sane) {
    if (number_of(i) >= 0) moving.push_back(i);
  }
  const auto point_of = [&](std::uint32_t i) { return problem.observations[i].point; };
  moving = sorted_by(moving, problem.points.size(), point_of, &start);
  const BlockPattern pattern = common_points(problem, moving, start, number);
  const std::vector<std::int32_t> order = pattern.elimination_order();
  packed->pattern = pattern.permuted(order);
  packed->pattern.eliminate();
  std::vector<std::int32_t> slot_of_number(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    slot_of_number[static_cast<std::size_t>(order[k])] = static_cast<std::int32_t>(k);
  }
  std::vector<std::int32_t> pose_slot(problem.pose_fixed.size(), -1);
  packed->slot_pose.resize(order.size());
  for (std::size_t k = 0; k < number.size(); ++k) {
    if (number[k] < 0) continue;
    const std::int32_t slot = slot_of_number[static_cast<std::size_t>(number[k])];
    pose_slot[k] = slot;
    packed->slot_pose[static_cast<std::size_t>(slot)] = static_cast<std::int32_t>(k);
  }
  return pose_slot;
}

/// Lists the block of each pair of observations of a point by moving cameras.
void list_pairs(PackedBundle* packed) {
  for (std::size_t p = 0; p + 1 < packed->moving_start.size(); ++p) {
    const std::uint32_t begin = packed->moving_start[p], end = packed->moving_start[p + 1];
    for (std::uint32_t a = begin; a < end; ++a) {
      for (std::uint32_t b = begin; b < a; ++b) {
        packed->pair_block.push_back(packed->pattern.block(static_cast<std::size_t>(packed->slot[a]),
                                                           static_cast<std::size_t>(packed->slot[b])));
      }
    }
    packed->max_moving = std::max<std::size_t>(packed->max_moving, end - begin);
  }
}

/// Sorts the observations into the kernels' order.
void order_observations(const BundleProblem& problem, const std::vector<std::uint32_t>& sane,
                        const std::vector<std::int32_t>& pose_slot, PackedBundle* packed) {
  const auto slot_of = [&](std::uint32_t i) {
    return pose_slot[static_cast<std::size_t>(problem.observations[i].pose)];
  };
  const auto point_of = [&](std::uint32_t i) { return problem.observations[i].point; };
  std::vector<std::uint32_t> fixed, moving, start;
  for (const std::uint32_t i : sane) (slot_of(i) < 0 ? fixed : moving).push_back(i);
  moving = sorted_by(moving, packed->slot_pose.size(), slot_of, &start);
  moving = sorted_by(moving, problem.points.size(), point_of, &packed->moving_start);
  fixed = sorted_by(fixed, problem.points.size(), point_of, &packed->fixed_start);

  packed->origin = moving;
  packed->origin.resize((moving.size() + kLanes - 1) / kLanes * kLanes, PackedBundle::kNone);
  packed->slot.reserve(packed->origin.size());
  for (const std::uint32_t i : moving) packed->slot.push_back(slot_of(i));
  packed->slot.resize(packed->origin.size(), 0);
  const auto offset = static_cast<std::uint32_t>(packed->origin.size());
  for (std::uint32_t& first : packed->fixed_start) first += offset;
  packed->origin.insert(packed->origin.end(), fixed.begin(), fixed.end());
  packed->origin.resize((packed->origin.size() + kLanes - 1) / kLanes * kLanes, PackedBundle::kNone);
}

void fill_lanes(const BundleProblem& problem, const NoiseSettings& noise, PackedBundle* packed) {
  packed->packets.resize(packed->origin.size() / kLanes);  // zeroed: padding weighs nothing
  for (std::size_t k = 0; k < packed->origin.size(); ++k) {
    if (packed->origin[k] == PackedBundle::kNone) continue;
    const BundleObservation& o = problem.observations[packed->origin[k]];
    kernels::BundlePacket& packet = packed->packets[k / kLanes];
    const std::size_t lane = k % kLanes;
    const bool has_depth = o.depth > 0 && std::isfinite(o.depth);
    packet.u[lane] = o.pixel.x();
    packet.v[lane] = o.pixel.y();
    packet.inverse_depth[lane] = has_depth ? 1.0F / o.depth : 0.0F;
    packet.inverse_sigma[lane] = static_cast<float>(1.0 / (noise.pixel_sigma * o.scale));
    packet.depth_weight[lane] = has_depth ? static_cast<float>(1.0 / noise.inverse_depth_sigma) : 0.0F;
    packet.used_inverse_sigma[lane] = packet.inverse_sigma[lane];
    packet.used_depth_weight[lane] = packet.depth_weight[lane];
    packet.pose[lane] = o.pose;
    packet.point[lane] = o.point;
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
  const std::vector<std::uint32_t> sane = sane_observations(problem);
  if (sane.empty()) return std::nullopt;
  const std::vector<std::int32_t> number = number_moving(problem, sane);
  const std::vector<std::int32_t> pose_slot = choose_slots(problem, sane, number, &packed);
  order_observations(problem, sane, pose_slot, &packed);
  list_pairs(&packed);
  fill_lanes(problem, noise, &packed);
  return packed;
}

}  // namespace stdc
