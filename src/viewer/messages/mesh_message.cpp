#include "viewer/messages/mesh_message.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "viewer/messages/byte_writer.hpp"

namespace stdc {

std::string encode_mesh(const TriangleMesh& mesh) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& position : mesh.positions) box.extend(position);
  if (mesh.positions.empty()) box = Eigen::AlignedBox3f(Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero());
  const Eigen::Vector3f corner = box.min(), size = box.sizes().cwiseMax(1e-6F);
  ByteWriter bytes;
  constexpr std::size_t kHeader = 32, kVertex = 9, kTriangle = 12;
  bytes.reserve(kHeader + kVertex * mesh.positions.size() + kTriangle * mesh.triangles.size() + 4);
  for (const float value : corner) bytes.put(value);
  for (const float value : size) bytes.put(value);
  bytes.put(static_cast<std::uint32_t>(mesh.positions.size()));
  bytes.put(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Eigen::Vector3f& position : mesh.positions) {
    constexpr float kSteps = 65535;
    const Eigen::Vector3f steps =
        ((position - corner).cwiseQuotient(size) * kSteps).cwiseMax(0).cwiseMin(kSteps);
    for (const float value : steps) bytes.put(static_cast<std::uint16_t>(std::lround(value)));
  }
  constexpr std::array<std::uint8_t, 3> kGrey = {170, 170, 170};
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (const std::uint8_t value : mesh.colours.empty() ? kGrey : mesh.colours[i]) bytes.put(value);
  }
  bytes.align(4);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) bytes.put(vertex);
  }
  return bytes.take();
}

}  // namespace stdc
