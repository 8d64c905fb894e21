#include "dense/fusion/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "dense/fusion/integration_kernel.hpp"

namespace stdc {
namespace {

BlockKey block_of(const Eigen::Vector3f& in_blocks) {
  return {static_cast<std::int32_t>(std::floor(in_blocks.x())),
          static_cast<std::int32_t>(std::floor(in_blocks.y())),
          static_cast<std::int32_t>(std::floor(in_blocks.z()))};
}

/// Whether a view may tell something of a ball: it is before the camera, within the image, and not far behind
/// all that is seen there.
bool may_tell(const ViewSamples& view, const Eigen::Vector3f& centre, float radius, float behind) {
  constexpr float kNearest = 0.1F;
  if (centre.z() + radius < kNearest) return false;
  const float z = std::max(centre.z() - radius, kNearest);
  // Larger than the ball's image everywhere within 60 degrees off the axis.
  const float reach_x = 2 * view.pinhole.fx * radius / z, reach_y = 2 * view.pinhole.fy * radius / z;
  const float u = view.pinhole.fx * centre.x() / std::max(centre.z(), kNearest) + view.pinhole.cx;
  const float v = view.pinhole.fy * centre.y() / std::max(centre.z(), kNearest) + view.pinhole.cy;
  const auto width = static_cast<float>(view.pinhole.width), height = static_cast<float>(view.pinhole.height);
  if (u + reach_x < 0 || v + reach_y < 0 || u - reach_x > width || v - reach_y > height) return false;
  const auto pixel = [](float value, float limit) { return static_cast<int>(std::clamp(value, 0.F, limit)); };
  const float farthest = view.max_depth(pixel(u - reach_x, width), pixel(v - reach_y, height),
                                        pixel(u + reach_x, width), pixel(v + reach_y, height));
  return farthest > 0 && centre.z() - radius <= farthest + behind;
}

/// Where a camera has the blocks of a field.
struct BlockPlaces {
  BlockPlaces(const DistanceField& field, const Pose& cam_from_world)
      : rotation(cam_from_world.rotation_matrix().cast<float>()),
        shift(cam_from_world.translation.cast<float>()),
        to_centre(rotation * Eigen::Vector3f::Constant(0.5F * (DistanceField::kSide - 1) * field.voxel())),
        radius(0.87F * DistanceField::kSide * field.voxel()),
        behind(3 * field.truncation()) {}

  Eigen::Matrix3f rotation;
  Eigen::Vector3f shift;
  Eigen::Vector3f to_centre;  ///< of a block from its first voxel's
  float radius, behind;       ///< of a ball around a block; what of it may be behind a surface [m]
};

}  // namespace

void DistanceField::mark(const ViewSamples& view, const Pose& world_from_cam) {
  constexpr int kStride = 3;  ///< [px]; at 5 m these are 3 cm apart, and other views fall between
  const float per_block = 1 / (static_cast<float>(kSide) * voxel_);
  const Eigen::Matrix3f rotation = world_from_cam.rotation_matrix().cast<float>() * per_block;
  // A block reaches from half a voxel before its first voxel's centre.
  const Eigen::Vector3f shift = world_from_cam.translation.cast<float>() * per_block +
                                Eigen::Vector3f::Constant(0.5F / static_cast<float>(kSide));
  const int steps = static_cast<int>(std::ceil(4 * truncation_ * per_block));  // half a block, or less
  BlockKey last{std::numeric_limits<std::int32_t>::max(), 0, 0};
  for (int y = kStride / 2; y < view.pinhole.height; y += kStride) {
    for (int x = kStride / 2; x < view.pinhole.width; x += kStride) {
      const float z = view.depths[static_cast<std::size_t>(y * view.pinhole.width + x)];
      if (!(z > 0)) continue;
      const Eigen::Vector3f ray = view.pinhole.point(x, y, 1);
      const Eigen::Vector3f middle = rotation * (z * ray) + shift;
      const Eigen::Vector3f reach = rotation * ray * (truncation_ / ray.norm());
      for (int i = 0; i <= steps; ++i) {
        const BlockKey key =
            block_of(middle + reach * (2 * static_cast<float>(i) / static_cast<float>(steps) - 1));
        if (key == last) continue;
        blocks_.add(key);
        last = key;
      }
    }
  }
}

void DistanceField::reserve(std::size_t blocks) {
  sums_.reserve(blocks * kVoxels);
  weights_.reserve(blocks * kVoxels);
}

void DistanceField::hold(BlockRange blocks) {
  const std::size_t kept = blocks.first < held_.last ? held_.last - blocks.first : 0;
  const auto move = [&](auto& voxels) {
    if (kept > 0)
      std::copy(voxels.end() - static_cast<std::ptrdiff_t>(kept * kVoxels), voxels.end(), voxels.begin());
    voxels.resize(kept * kVoxels);
    voxels.resize(blocks.size() * kVoxels, 0);
  };
  move(sums_);
  move(weights_);
  held_ = blocks;
}

bool DistanceField::concerns(const ViewSamples& view, const Pose& cam_from_world, BlockRange blocks) const {
  const BlockPlaces places(*this, cam_from_world);
  for (std::size_t block = blocks.first; block < blocks.last; ++block) {
    const Eigen::Vector3f start = places.rotation * origin(blocks_.keys()[block]) + places.shift;
    if (may_tell(view, start + places.to_centre, places.radius, places.behind)) return true;
  }
  return false;
}

void DistanceField::integrate(const ViewSamples& view, const Pose& cam_from_world, BlockRange blocks) {
  const BlockPlaces places(*this, cam_from_world);
  BlockTask task{};
  task.truncation = truncation_;
  for (int k = 0; k < 3; ++k) {
    task.step_x[k] = places.rotation(k, 0) * voxel_;
    task.step_y[k] = places.rotation(k, 1) * voxel_;
    task.step_z[k] = places.rotation(k, 2) * voxel_;
  }
  for (std::size_t block = blocks.first; block < blocks.last; ++block) {
    const Eigen::Vector3f start = places.rotation * origin(blocks_.keys()[block]) + places.shift;
    if (!may_tell(view, start + places.to_centre, places.radius, places.behind)) continue;
    for (int k = 0; k < 3; ++k) task.start[k] = start[k];
    task.sums = sums_.data() + (block - held_.first) * kVoxels;
    task.weights = weights_.data() + (block - held_.first) * kVoxels;
    integrate_block(view, task);
  }
}

}  // namespace stdc
