#include "slam/system_tests/test_sequence.hpp"

#include <thread>

#include "core/test_bytes.hpp"

namespace stdc::test {

const TestSequence& TestSequence::of_a_desk() {
  static const TestSequence sequence(simulation::Preset::static_desk, 0, 1, 100);  // rendering takes seconds
  return sequence;
}

const TestSequence& TestSequence::of_a_room() {
  static const TestSequence sequence(simulation::Preset::static_room, 250, 2, 120);
  return sequence;
}

TestSequence::TestSequence(simulation::Preset preset, int first, int step, int count) {
  camera = simulation::default_render_camera();
  camera.width = 320;
  camera.height = 240;
  for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value *= 0.5;
  simulation::RenderSettings settings;
  settings.camera = camera;
  const simulation::RenderedSequence rendered(preset, settings);
  frames.resize(count);
  std::vector<std::thread> threads;
  threads.reserve(2);
  for (int start = 0; start < 2; ++start) {
    threads.emplace_back([&, start] {
      for (int i = start; i < count; i += 2) frames[i] = rendered.render(first + i * step);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

bool same_bytes(const std::vector<FramePose>& a, const std::vector<FramePose>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].frame != b[i].frame || !same_bytes(a[i].world_from_cam, b[i].world_from_cam)) return false;
  }
  return true;
}

}  // namespace stdc::test
