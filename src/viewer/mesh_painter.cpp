#include "viewer/mesh_painter.hpp"

#include <algorithm>
#include <utility>

#include "core/give_way.hpp"
#include "core/stopwatch.hpp"
#include "viewer/messages/mesh_message.hpp"

namespace stdc {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kVoxel = 0.02, kMaxVoxel = 0.1;  // [m]
constexpr double kMaxMilliseconds = 2500;
constexpr std::size_t kMaxTriangles = 1'500'000;

}  // namespace

MeshPainter::MeshPainter(ViewBoard& board, std::function<void(std::size_t, double)> made)
    : board_(board), made_(std::move(made)), thread_([this] { run(); }) {}

MeshPainter::~MeshPainter() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

bool MeshPainter::due() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && !dense_ && Clock::now() >= next_;
}

void MeshPainter::give(Slam::DenseSoFar dense) {
  {
    const std::lock_guard lock(mutex_);
    dense_ = std::move(dense);
  }
  changed_.notify_all();
}

void MeshPainter::run() {
  give_way();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stop_ || dense_; });
    if (stop_) return;
    const Slam::DenseSoFar dense = *std::exchange(dense_, std::nullopt);
    busy_ = true;
    lock.unlock();
    const double milliseconds = make(dense);
    lock.lock();
    busy_ = false;
    constexpr double kRest = 3, kMinRest = 1000;  // [ms]
    next_ =
        Clock::now() + std::chrono::milliseconds(static_cast<int>(std::max(kMinRest, kRest * milliseconds)));
  }
}

/// @return the milliseconds of CPU time that it took: what else the machine does is no reason for large
/// voxels
double MeshPainter::make(const Slam::DenseSoFar& dense) {
  const double begin = thread_cpu_ms();
  voxel_ = std::max({voxel_, kVoxel, dense.settings.voxel});
  constexpr int kThreads = 1;
  const TriangleMesh mesh = dense.mesh(voxel_, kThreads);
  board_.post(ViewTopic::mesh, encode_mesh(mesh));
  made_(mesh.triangles.size(), voxel_);
  const double milliseconds = thread_cpu_ms() - begin;
  if (milliseconds > kMaxMilliseconds || mesh.triangles.size() > kMaxTriangles) {
    constexpr double kCoarser = 1.4;
    voxel_ = std::min(kMaxVoxel, kCoarser * voxel_);
  }
  return milliseconds;
}

}  // namespace stdc
