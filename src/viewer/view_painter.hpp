#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "viewer/aligned_truth.hpp"
#include "viewer/keyframe_images.hpp"
#include "viewer/messages/image_message.hpp"
#include "viewer/messages/map_message.hpp"
#include "viewer/view_board.hpp"
#include "viewer/view_state.hpp"

namespace stdc {

/// Makes messages of what the run gives, on a thread of its own that gives way to the tracker. Of images and
/// maps it has at most one waiting: a newer one takes its place.
class ViewPainter {
 public:
  ViewPainter(ViewSubject subject, ViewBoard& board, KeyframeImages& keyframes);
  ~ViewPainter();
  ViewPainter(const ViewPainter&) = delete;
  ViewPainter& operator=(const ViewPainter&) = delete;

  // For the run's thread. Cheap.
  void add(const TrackingResult& result);
  void add(const LoopReport& loop);
  /// Whether the last image is done with.
  bool free_for_image() const;
  bool free_for_map() const;
  void give(ViewImage image, std::uint32_t wanted);
  void give(ViewMap map);
  void give_keyframe(int frame, ViewColour colour);
  void set_truth(Trajectory truth);
  void finish();

  // For any thread.
  void set_paused(bool paused);
  void set_mesh(std::size_t triangles, double voxel);
  /// Waits until all that was given is done, at most for a time.
  void drain(std::chrono::milliseconds max);

 private:
  struct Inbox {
    std::vector<FrameRecord> records;
    std::optional<ViewImage> image;
    std::uint32_t wanted = 0;
    std::optional<ViewMap> map;
    std::optional<Trajectory> truth;
    std::deque<std::pair<int, ViewColour>> keyframes;
    bool state = true;   ///< something in it has changed
    bool urgent = true;  ///< and is to be seen at once
    bool empty() const { return records.empty() && !image && !map && !truth && keyframes.empty() && !state; }
  };
  void run();
  void paint(Inbox& inbox);
  void paint_map(ViewMap& map);
  void post_state();
  void touch(bool urgent);

  const ViewSubject subject_;
  ViewBoard& board_;
  KeyframeImages& keyframes_;
  std::optional<AlignedTruth> truth_;  ///< the thread's own

  mutable std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  Inbox inbox_;
  ViewState state_;
  ViewEvents events_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;
};

}  // namespace stdc
