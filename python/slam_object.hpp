#pragma once

#include <pybind11/pybind11.h>
#include <unistd.h>

#include <memory>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "released_gil.hpp"
#include "slam/slam.hpp"

namespace stdc::python {

/// Slam for several Python threads: one call at a time, and other threads of Python run meanwhile.
class SlamObject {
 public:
  SlamObject(const Camera& camera, const Settings& settings, std::unique_ptr<Segmenter> segmenter)
      : camera_(camera),
        // Everything else sees brightness only.
        needs_colour_(settings.segmentation.source == SegmentationSource::network || settings.dense.active),
        slam_(std::make_unique<Slam>(camera, settings, std::move(segmenter))) {}
  ~SlamObject() {
    // Waiting for the workers takes a while. A forked child has none: what it inherited is left alone.
    const ReleasedGil others;
    if (is_child()) {
      static_cast<void>(slam_.release());
    } else {
      slam_.reset();
    }
  }
  SlamObject(const SlamObject&) = delete;
  SlamObject& operator=(const SlamObject&) = delete;

  /// Calls `function(Slam&)` without the GIL. Throws Error in a process that was forked after the
  /// construction: the workers are threads of the parent.
  template <typename Function>
  auto with(Function&& function) {
    if (is_child()) {
      throw Error("Slam", "was made before this process was forked, and its threads are not here",
                  "make it in the child, or start processes by 'spawn'");
    }
    const ReleasedGil others;
    const std::lock_guard lock(mutex_);
    return std::forward<Function>(function)(*slam_);
  }

  const Camera& camera() const { return camera_; }
  /// Whether colours of frames make a difference.
  bool needs_colour() const { return needs_colour_; }

 private:
  bool is_child() const { return getpid() != process_; }

  Camera camera_;
  bool needs_colour_;
  pid_t process_ = getpid();
  std::mutex mutex_;
  std::unique_ptr<Slam> slam_;
};

}  // namespace stdc::python
