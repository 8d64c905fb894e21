#include "dense/export/mesh_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string>

namespace stdc {
namespace {

/// Gathers bytes and hands them on in large pieces.
class ByteWriter {
 public:
  explicit ByteWriter(std::ostream& stream) : stream_(stream) {}
  ~ByteWriter() { flush(); }
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;

  template <typename T>
  void put(T value) {
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));  // every machine that this is built for is little-endian
    bytes_.append(raw, sizeof(T));
    if (bytes_.size() >= kPiece) flush();
  }
  void put(const Eigen::Vector3f& vector) {
    for (const float value : vector) put(value);
  }

 private:
  static constexpr std::size_t kPiece = 1U << 16U;
  void flush() {
    stream_.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    bytes_.clear();
  }
  std::ostream& stream_;
  std::string bytes_;
};

void write_ply(std::ostream& stream, const TriangleMesh& mesh, bool with_triangles) {
  stream << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment dense map of STDC-SLAM, in metres\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n",
      mesh.positions.size());
  if (with_triangles) {
    stream << fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.size());
  }
  stream << "end_header\n";
  ByteWriter out(stream);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    out.put(mesh.positions[i]);
    out.put(mesh.normals[i]);
    for (const std::uint8_t channel : mesh.colours[i]) out.put(channel);
  }
  if (!with_triangles) return;
  for (const auto& triangle : mesh.triangles) {
    out.put(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) out.put(static_cast<std::int32_t>(vertex));
  }
}

/// sRGB (IEC 61966-2-1), 0..255, to linear light, 0..65535: eight bits would be too few in the dark.
std::array<std::uint16_t, 256> linear_light() {
  std::array<std::uint16_t, 256> table{};
  for (int i = 0; i < 256; ++i) {
    const double s = i / 255.0;
    const double linear = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    table[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::lround(65535 * linear));
  }
  return table;
}

constexpr int kFloat = 5126, kShort = 5123, kUnsigned = 5125;  // component types of glTF

/// Where the parts of a mesh stand in the binary chunk.
struct GlbLayout {
  std::size_t positions = 0, normals = 0, colours = 0, triangles = 0, end = 0;
  explicit GlbLayout(const TriangleMesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    normals = positions + 12 * vertices;
    colours = normals + 12 * vertices;
    triangles = colours + 8 * vertices;
    end = triangles + 12 * mesh.triangles.size();
  }
};

std::string glb_description(const TriangleMesh& mesh, const GlbLayout& layout,
                            const Eigen::Quaternionf& upright) {
  using Json = nlohmann::ordered_json;
  constexpr int kVertices = 34962, kIndices = 34963;  // targets of buffer views
  Eigen::Vector3f low = Eigen::Vector3f::Zero(), high = low;
  if (!mesh.positions.empty()) low = high = mesh.positions.front();
  for (const Eigen::Vector3f& p : mesh.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const std::size_t vertices = mesh.positions.size();
  const auto view = [](std::size_t from, std::size_t to, int target) {
    return Json{{"buffer", 0}, {"byteOffset", from}, {"byteLength", to - from}, {"target", target}};
  };
  Json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "STDC-SLAM"}};
  json["scene"] = 0;
  json["scenes"] = Json::array({{{"nodes", {0}}}});
  json["nodes"] = Json::array({{{"name", "dense map"},
                                {"mesh", 0},
                                {"rotation", {upright.x(), upright.y(), upright.z(), upright.w()}}}});
  json["materials"] =
      Json::array({{{"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
                    {"extensions", {{"KHR_materials_unlit", Json::object()}}},
                    {"doubleSided", true}}});
  json["extensionsUsed"] = Json::array({"KHR_materials_unlit"});
  json["meshes"] = Json::array(
      {{{"primitives", Json::array({{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}}},
                                     {"indices", 3},
                                     {"material", 0}}})}}});
  json["accessors"] =
      Json::array({{{"bufferView", 0},
                    {"componentType", kFloat},
                    {"count", vertices},
                    {"type", "VEC3"},
                    {"min", {low.x(), low.y(), low.z()}},
                    {"max", {high.x(), high.y(), high.z()}}},
                   {{"bufferView", 1}, {"componentType", kFloat}, {"count", vertices}, {"type", "VEC3"}},
                   {{"bufferView", 2},
                    {"componentType", kShort},
                    {"normalized", true},
                    {"count", vertices},
                    {"type", "VEC4"}},
                   {{"bufferView", 3},
                    {"componentType", kUnsigned},
                    {"count", 3 * mesh.triangles.size()},
                    {"type", "SCALAR"}}});
  json["bufferViews"] = Json::array(
      {view(layout.positions, layout.normals, kVertices), view(layout.normals, layout.colours, kVertices),
       view(layout.colours, layout.triangles, kVertices), view(layout.triangles, layout.end, kIndices)});
  json["buffers"] = Json::array({{{"byteLength", layout.end}}});
  std::string text = json.dump();
  text.append((4 - text.size() % 4) % 4, ' ');  // chunks begin at multiples of four bytes
  return text;
}

}  // namespace

void write_mesh_ply(std::ostream& stream, const TriangleMesh& mesh) { write_ply(stream, mesh, true); }
void write_cloud_ply(std::ostream& stream, const TriangleMesh& mesh) { write_ply(stream, mesh, false); }

void write_cloud_pcd(std::ostream& stream, const TriangleMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  stream << fmt::format(
      "# .PCD v0.7 - dense map of STDC-SLAM, in metres\nVERSION 0.7\n"
      "FIELDS x y z normal_x normal_y normal_z rgb\nSIZE 4 4 4 4 4 4 4\nTYPE F F F F F F F\n"
      "COUNT 1 1 1 1 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      count);
  ByteWriter out(stream);
  for (std::size_t i = 0; i < count; ++i) {
    out.put(mesh.positions[i]);
    out.put(mesh.normals[i]);
    const auto& colour = mesh.colours[i];
    out.put(static_cast<std::uint32_t>(colour[0]) << 16U | static_cast<std::uint32_t>(colour[1]) << 8U |
            colour[2]);
  }
}

void write_mesh_glb(std::ostream& stream, const TriangleMesh& mesh, const Eigen::Quaternionf& upright) {
  constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const GlbLayout layout(mesh);
  const std::string text = glb_description(mesh, layout, upright);
  ByteWriter out(stream);
  const std::size_t size = 12 + 8 + text.size() + 8 + layout.end;
  for (const std::size_t value :
       {std::size_t{kMagic}, std::size_t{kVersion}, size, text.size(), std::size_t{kJson}}) {
    out.put(static_cast<std::uint32_t>(value));
  }
  for (const char c : text) out.put(c);
  out.put(static_cast<std::uint32_t>(layout.end));
  out.put(kBinary);
  for (const Eigen::Vector3f& position : mesh.positions) out.put(position);
  for (const Eigen::Vector3f& normal : mesh.normals) out.put(normal);
  const std::array<std::uint16_t, 256> linear = linear_light();
  for (const auto& colour : mesh.colours) {
    for (const std::uint8_t channel : colour) out.put(linear[channel]);
    out.put(std::uint16_t{65535});
  }
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) out.put(vertex);
  }
}

}  // namespace stdc
