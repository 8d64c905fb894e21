// Tracks a recording of any kind that `stdc-slam info` knows, and writes its trajectory and a mesh of the
// room.
//   track_recording INPUT
#include <fstream>
#include <iostream>
#include <stdc_slam.hpp>

int main(int count, char** arguments) try {
  const auto source = stdc::open_source(count > 1 ? arguments[1] : ".");
  const stdc::RgbdCameras cameras = source->cameras().value();
  stdc::Settings settings;
  settings.dense.active = true;
  stdc::Slam slam(cameras.colour, settings, stdc::make_segmenter(settings, {}));
  const stdc::FrameDecoder decoder(cameras);
  while (const auto frame = source->next()) {
    const auto result = slam.track(decoder.decode(*frame, stdc::ColourMode::as_stored));
    if (!stdc::has_pose(result.status)) std::cerr << "frame " << result.frame << ": no pose\n";
  }
  slam.finish();
  stdc::Trajectory trajectory;
  for (const auto& pose : slam.trajectory()) trajectory.push_back({pose.timestamp, pose.world_from_cam});
  std::ofstream("trajectory.txt") << stdc::format_trajectory(trajectory);
  std::ofstream mesh("mesh.ply", std::ios::binary);
  stdc::write_mesh_ply(mesh, slam.mesh());
} catch (const stdc::Error& error) {
  std::cerr << error.what() << "\n";
  return 2;
}
