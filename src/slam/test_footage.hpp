#pragma once

#include <cstring>
#include <thread>
#include <vector>

#include "rendering/rendered_sequence.hpp"
#include "slam/slam.hpp"

namespace stdc::testing {

/// A hundred small frames of a desk, rendered once for all tests.
struct Footage {
  Camera camera;
  std::vector<RenderedFrame> frames;

  static const Footage& of_a_desk() {
    static const Footage footage;  // rendering takes seconds
    return footage;
  }

 private:
  Footage() {
    camera = default_render_camera();
    camera.width = 320;
    camera.height = 240;
    for (double* value : {&camera.fx, &camera.fy, &camera.cx, &camera.cy}) *value *= 0.5;
    RenderSettings settings;
    settings.camera = camera;
    const RenderedSequence sequence(Preset::static_desk, settings);
    constexpr int kFrames = 100;
    frames.resize(kFrames);
    std::vector<std::thread> threads;
    for (int start = 0; start < 2; ++start) {
      threads.emplace_back([&, start] {
        for (int i = start; i < kFrames; i += 2) frames[i] = sequence.render(i);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }
};

inline bool same_bytes(const std::vector<FramePose>& a, const std::vector<FramePose>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector4d qa = a[i].world_from_cam.rotation.coeffs(),
                          qb = b[i].world_from_cam.rotation.coeffs();
    const Eigen::Vector3d ta = a[i].world_from_cam.translation, tb = b[i].world_from_cam.translation;
    if (a[i].frame != b[i].frame || std::memcmp(qa.data(), qb.data(), sizeof(double) * 4) != 0 ||
        std::memcmp(ta.data(), tb.data(), sizeof(double) * 3) != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace stdc::testing
