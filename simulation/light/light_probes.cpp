#include "simulation/light/light_probes.hpp"

#include <algorithm>
#include <cmath>

namespace stdc::simulation {

using Eigen::Vector3f;
using Eigen::Vector3i;

LightProbes::LightProbes(const World& world, const BakedLight& light) {
  constexpr float kSpacing = 0.6F, kMargin = 0.2F;  // [m]
  low_ = world.low + Vector3f::Constant(kMargin);
  const Vector3f span = world.high - world.low - Vector3f::Constant(2 * kMargin);
  for (int i = 0; i < 3; ++i) {
    size_[i] = static_cast<int>(std::ceil(span[i] / kSpacing)) + 1;
    step_[i] = span[i] / static_cast<float>(size_[i] - 1);
  }
  Vector3i at;
  for (at[2] = 0; at[2] < size_[2]; ++at[2]) {
    for (at[1] = 0; at[1] < size_[1]; ++at[1]) {
      for (at[0] = 0; at[0] < size_[0]; ++at[0]) {
        const Vector3f position = low_ + at.cast<float>().cwiseProduct(step_);
        LightCube cube;
        for (int face = 0; face < 6; ++face) {
          const Vector3f normal = Vector3f::Unit(face / 2) * (face % 2 == 0 ? 1.0F : -1.0F);
          cube.faces[face] =
              light.gather(position, normal, cubes_.size() * 6 + static_cast<std::size_t>(face));
        }
        cubes_.push_back(cube);
      }
    }
  }
}

LightCube LightProbes::at(const Vector3f& position) const {
  Vector3i cell;
  Vector3f f;
  for (int i = 0; i < 3; ++i) {
    const float x = std::clamp((position[i] - low_[i]) / step_[i], 0.0F, static_cast<float>(size_[i] - 1));
    cell[i] = std::min(static_cast<int>(x), size_[i] - 2);
    f[i] = x - static_cast<float>(cell[i]);
  }
  LightCube sum;
  for (Rgb& face : sum.faces) face.setZero();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3i offset(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    float weight = 1;
    for (int i = 0; i < 3; ++i) weight *= offset[i] != 0 ? f[i] : 1 - f[i];
    const Vector3i at = cell + offset;
    const LightCube& cube = cubes_[(static_cast<std::size_t>(at[2]) * size_[1] + at[1]) * size_[0] + at[0]];
    for (int face = 0; face < 6; ++face) sum.faces[face] += weight * cube.faces[face];
  }
  return sum;
}

}  // namespace stdc::simulation
