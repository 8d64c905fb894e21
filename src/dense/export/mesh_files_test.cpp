#include "dense/export/mesh_files.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stdc {
namespace {

TriangleMesh triangle() {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 1}, {1, 0, 1}, {0, 2, 1}};
  mesh.normals.assign(3, -Eigen::Vector3f::UnitZ());
  mesh.colours = {{255, 0, 0}, {0, 255, 0}, {0, 0, 128}};
  mesh.triangles = {{0, 2, 1}};
  return mesh;
}

template <typename Write>
std::string bytes_of(const Write& write) {
  std::ostringstream stream;
  write(stream);
  return stream.str();
}

template <typename T>
T value_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, &bytes.at(at + sizeof(T) - 1) - sizeof(T) + 1, sizeof(T));
  return value;
}

std::string after(const std::string& bytes, const std::string& head) {
  const std::size_t at = bytes.find(head);
  return at == std::string::npos ? "" : bytes.substr(at + head.size());
}

TEST(MeshFiles, Ply) {
  const std::string ply = bytes_of([](std::ostream& out) { write_mesh_ply(out, triangle()); });
  EXPECT_NE(ply.find("element vertex 3\n"), std::string::npos);
  EXPECT_NE(ply.find("element face 1\n"), std::string::npos);
  const std::string body = after(ply, "end_header\n");
  ASSERT_EQ(body.size(), 3U * 27 + 13);
  EXPECT_EQ(value_at<float>(body, 2 * 27 + 4), 2);
  EXPECT_EQ(value_at<std::uint8_t>(body, 27 + 25), 255) << "green of the second";
  EXPECT_EQ(value_at<std::int32_t>(body, 3 * 27 + 5), 2);
  const std::string cloud = bytes_of([](std::ostream& out) { write_cloud_ply(out, triangle()); });
  EXPECT_EQ(after(cloud, "end_header\n"), body.substr(0, 3 * 27));
}

TEST(MeshFiles, Pcd) {
  const std::string pcd = bytes_of([](std::ostream& out) { write_cloud_pcd(out, triangle()); });
  EXPECT_NE(pcd.find("POINTS 3\n"), std::string::npos);
  const std::string body = after(pcd, "DATA binary\n");
  ASSERT_EQ(body.size(), 3U * 28);
  EXPECT_EQ(value_at<std::uint32_t>(body, 24), 0xFF0000U);
}

TEST(MeshFiles, GlbHoldsWhatItsDescriptionSays) {
  const std::string glb =
      bytes_of([](std::ostream& out) { write_mesh_glb(out, triangle(), Eigen::Quaternionf(0, 1, 0, 0)); });
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(value_at<std::uint32_t>(glb, 8), glb.size());
  const std::size_t text = value_at<std::uint32_t>(glb, 12);
  EXPECT_EQ(text % 4, 0U);
  const auto json = nlohmann::json::parse(glb.substr(20, text));
  const std::size_t binary = 20 + text + 8;
  EXPECT_EQ(value_at<std::uint32_t>(glb, 20 + text), glb.size() - binary);
  EXPECT_EQ(json["buffers"][0]["byteLength"], glb.size() - binary);
  EXPECT_EQ(json["accessors"][0]["max"], (std::vector<float>{1, 2, 1}));
  EXPECT_EQ(json["nodes"][0]["rotation"], (std::vector<float>{1, 0, 0, 0}));
  const std::size_t colours = json["bufferViews"][2]["byteOffset"],
                    indices = json["bufferViews"][3]["byteOffset"];
  EXPECT_EQ(value_at<std::uint16_t>(glb, binary + colours), 65535);
  EXPECT_NEAR(value_at<std::uint16_t>(glb, binary + colours + 16 + 4), 0.2159 * 65535, 10) << "linear light";
  EXPECT_EQ(value_at<std::uint32_t>(glb, binary + indices + 4), 2U);
}

}  // namespace
}  // namespace stdc
