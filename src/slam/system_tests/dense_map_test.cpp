// The dense map of a run: it follows the map, changes nothing else, and is the same on every run.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "atlas/storage/map_file.hpp"
#include "core/files/test_folder.hpp"
#include "slam/system_tests/test_load.hpp"
#include "slam/system_tests/test_walk.hpp"

namespace stdc {
namespace {

using test::Load;
using test::same_bytes;
using test::TestFolder;
using test::TestSequence;
using test::Walk;

constexpr double kVoxel = 0.04;  // [m]; coarse, so that the tests are fast

Settings dense_settings() {
  Settings settings;
  settings.dense.active = true;
  settings.dense.voxel = kVoxel;
  return settings;
}

bool same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions == b.positions && a.normals == b.normals && a.colours == b.colours &&
         a.triangles == b.triangles;
}

std::string mesh_bytes(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(DenseMap, IsTheSameBytesUnderLoadAndAskingChangesNothing) {
  Walk quiet(dense_settings());
  quiet.go(0, 40);
  quiet.slam.finish();
  const TriangleMesh mesh = quiet.slam.mesh();
  EXPECT_GT(mesh.triangles.size(), 2000U);
  EXPECT_EQ(mesh.colours.size(), mesh.positions.size());

  const Load load;
  Walk busy(dense_settings());
  for (int place = 0; place <= 40; ++place) {
    busy.see(place);
    if (place % 20 != 10) continue;
    EXPECT_FALSE(busy.slam.mesh({0}, 0.1).empty());
  }
  busy.slam.finish();
  EXPECT_TRUE(same_mesh(mesh, busy.slam.mesh()));
  EXPECT_TRUE(same_bytes(quiet.slam.trajectory(), busy.slam.trajectory()));
  Walk without;
  without.go(0, 40);
  without.slam.finish();
  EXPECT_TRUE(same_bytes(quiet.slam.trajectory(), without.slam.trajectory()))
      << "tracking does not know of it";
  EXPECT_TRUE(without.slam.mesh().empty());
}

TEST(DenseMap, LiesOnTheSurfacesThatTheCameraSaw) {
  Walk walk(dense_settings());
  walk.go(0, 40);
  walk.slam.finish();
  const TriangleMesh mesh = walk.slam.mesh();
  // Seen from the first camera, most of it is where the depth image has it, or hidden.
  const auto& truth = TestSequence::of_a_room();
  const cv::Mat& depth = truth.frames[0].image.depth;
  int near = 0, before = 0;
  for (const Eigen::Vector3f& p : mesh.positions) {
    if (p.z() < 0.3F) continue;
    const Eigen::Vector2d pixel = truth.camera.project(p.cast<double>());
    const int x = static_cast<int>(std::lround(pixel.x())), y = static_cast<int>(std::lround(pixel.y()));
    if (x < 2 || y < 2 || x >= depth.cols - 2 || y >= depth.rows - 2) continue;
    const double z = depth.at<std::uint16_t>(y, x) / truth.camera.depth_units_per_metre;
    if (!(z > 0) || z > 3) continue;
    if (std::abs(p.z() - z) < 0.04) ++near;
    if (p.z() < z - 0.08) ++before;
  }
  EXPECT_GT(near, 1000);
  EXPECT_LT(before, near / 20) << "nothing stands where the camera saw through";
}

TEST(DenseMap, StaysWithTheMapFile) {
  const TestFolder folder;
  Walk first(dense_settings());
  first.go(0, 30);
  first.slam.save_map(folder / "room.map");
  const TriangleMesh mesh = first.slam.mesh();
  const StoredMap stored = load_map(folder / "room.map");
  EXPECT_EQ(stored.version, 3U);
  EXPECT_GT(stored.views.size(), 1U);

  // A session that knows nothing of dense maps keeps it; one that makes one goes on with it.
  Walk plain;
  plain.slam.load_map(folder / "room.map");
  EXPECT_TRUE(same_mesh(mesh, plain.slam.mesh({0}, kVoxel)));
  plain.slam.save_map(folder / "again.map");
  EXPECT_EQ(mesh_bytes(folder / "room.map"), mesh_bytes(folder / "again.map"));
  Walk later(dense_settings());
  later.slam.load_map(folder / "room.map");
  later.go(20, 50);
  later.slam.finish();
  EXPECT_GT(later.slam.mesh().triangles.size(), mesh.triangles.size());

  Walk without;
  without.go(0, 10);
  without.slam.save_map(folder / "plain.map");
  EXPECT_EQ(load_map(folder / "plain.map").version, 2U) << "older programs can read it";
}

}  // namespace
}  // namespace stdc
