#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "slam/slam.hpp"
#include "viewer/view_board.hpp"

namespace stdc {

/// Makes the mesh of the dense map as it grows, on a thread of its own that gives way to the tracker and
/// rests three times as long as it works. Its voxels become larger when a mesh takes too long.
class MeshPainter {
 public:
  /// @param made  called on that thread with the number of triangles and the size of the voxels [m]
  MeshPainter(ViewBoard& board, std::function<void(std::size_t triangles, double voxel)> made);
  ~MeshPainter();
  MeshPainter(const MeshPainter&) = delete;
  MeshPainter& operator=(const MeshPainter&) = delete;

  /// Whether it would make a mesh now.
  bool due() const;
  void give(Slam::DenseSoFar dense);

 private:
  void run();
  double make(const Slam::DenseSoFar& dense);

  ViewBoard& board_;
  std::function<void(std::size_t, double)> made_;
  double voxel_ = 0;  ///< [m] of the last mesh; 0: none yet
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Slam::DenseSoFar> dense_;
  std::chrono::steady_clock::time_point next_{};
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace stdc
