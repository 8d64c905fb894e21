#pragma once

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>

#include "input/frame_source.hpp"
#include "input/live/frame_queue.hpp"
#include "input/recordings/containers/packed_messages.hpp"
#include "input/recordings/stamp_pairing.hpp"
#include "input/recordings/transform_tree.hpp"
#include "ros2/camera_search.hpp"
#include "ros2/camera_topics.hpp"
#include "ros2/given_frames.hpp"
#include "ros2/node.hpp"

namespace stdc::ros2 {

/// How images are to be received.
enum class Reception {
  best_effort,  ///< what is lost is lost: ROS 2's profile for sensor data; connects with every publisher
  reliable,     ///< lost messages are sent again; connects with reliable publishers only
  every_frame,  ///< reliable, and the publisher waits for us (if it keeps all): to play back a recording
};

struct Ros2SourceOptions {
  CameraTopics topics;
  Reception reception = Reception::best_effort;
  double max_difference = 0.02;  ///< between the stamps of colour and depth [s]
  bool camera_is_known = false;  ///< from elsewhere: no camera info is waited for
  int max_waiting = 3;           ///< frames that may wait for who works on them; `every_frame` has more
};

/// What came so far.
struct ReceptionCounts {
  int colour = 0, depth = 0;  ///< messages
  int lost = 0;               ///< known to be lost on the way
  int damaged = 0;            ///< messages that are not what their type says
  int backwards = 0;          ///< with a stamp that is not later than the last one's
  int restarts = 0;           ///< how often the stamps began anew, earlier
  int colour_without_depth = 0;
  int dropped = 0;  ///< frames that came too late
};

/// The images of a running ROS 2 system as a source of frames. A thread takes the messages and pairs colour
/// and depth by their stamps; few frames wait, the oldest goes.
class Ros2Source : public FrameSource {
 public:
  /// `node` must outlive the source. Throws Error for names that are none.
  Ros2Source(Node& node, const Ros2SourceOptions& options);
  ~Ros2Source() override;

  /// Waits until images came and the cameras are known. False if that is not so after `patience`. Throws
  /// Error for a camera info that makes no sense, or images that are none of colour and depth.
  bool wait_for_cameras(std::chrono::milliseconds patience);

  std::optional<SourceFrame> next() override;
  void rewind() override;
  bool can_rewind() const override { return false; }
  bool is_live() const override { return true; }
  void stop() override;
  int dropped() const override { return queue_.dropped(); }
  std::optional<int> frame_count() const override { return std::nullopt; }
  /// After wait_for_cameras(), like camera_hint() and notes().
  std::optional<RgbdCameras> cameras() const override { return found_.cameras; }
  std::string camera_hint() const override { return found_.hint; }
  std::vector<std::string> notes() const override { return found_.notes; }
  std::string kind() const override { return "ros2"; }
  std::string where() const override { return "ROS 2 domain " + std::to_string(node_.options().domain); }
  std::vector<std::string> faults() const override;
  int colour_without_depth() const override { return counts().colour_without_depth; }

  ReceptionCounts counts() const;
  /// Why no images come, in words with the remedy: nobody publishes, another type, another quality of
  /// service, no camera info. Empty: nothing is wrong.
  std::vector<std::string> problems() const;
  /// The frame that the images say they are in.
  std::string image_frame() const;
  /// How the frames of the robot stand to each other, as far as /tf_static told.
  TransformTree transforms() const;
  /// The exact stamp of a frame [ns], of the last few.
  std::int64_t stamp_of(double timestamp) const;
  /// When the later image of that frame came; nothing if the frame is too old.
  std::optional<std::chrono::steady_clock::time_point> arrival_of(double timestamp) const;

 private:
  void subscribe(const CameraTopics& topics);
  void work();
  bool has_room() const;
  /// Takes one message of each topic; false if there was none, or no room for it.
  bool take_some();
  void add(CameraStream stream, std::vector<std::uint8_t> data);
  void add_image(CameraStream stream, std::vector<std::uint8_t> data);
  bool goes_forward(CameraStream stream, std::int64_t stamp);
  void hand_on_pairs();

  Node& node_;
  Ros2SourceOptions options_;
  std::shared_ptr<const ImageTopic> colour_topic_, depth_topic_;
  FrameQueue queue_;
  FoundCameras found_;  ///< of the thread that waits for the cameras

  mutable std::mutex mutex_;  ///< of all that follows, but for the threads
  std::condition_variable changed_;
  bool news_ = false, stop_ = false;
  bool images_wait_ = false;  ///< in the middleware, for room
  CameraSearch search_;
  bool search_is_over_ = false;
  std::unique_ptr<StampPairing> pairing_;
  std::optional<std::int64_t> last_stamp_[2];  ///< of colour and depth [ns]
  GivenFrames given_;
  ReceptionCounts counts_;
  std::string image_frame_;
  TransformTree transforms_;

  std::vector<std::pair<CameraStream, std::unique_ptr<Subscription>>> subscriptions_;
  std::thread thread_;  // last: it uses what is above
};

}  // namespace stdc::ros2
