#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/images/image_codec.hpp"
#include "input/ground_truth.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc {

/// One reading of an inertial sensor, in its own frame.
struct ImuSample {
  double timestamp = 0;          ///< [s], of the same clock as the images
  Eigen::Vector3d gyroscope;     ///< [rad/s]
  Eigen::Vector3d acceleration;  ///< with gravity [m/s^2]
};

/// The images of a frame as they are stored: paths, or the bytes of a message. Reading and decoding wait
/// until they are asked for, so that passing over frames costs little. Both functions may be called from any
/// thread, also when the source has gone on or is gone.
class PackedImages {
 public:
  virtual ~PackedImages() = default;
  PackedImages() = default;
  PackedImages(const PackedImages&) = delete;
  PackedImages& operator=(const PackedImages&) = delete;

  /// CV_8UC1 or CV_8UC3 (BGR). `size`: what the image must have; empty: whatever it has.
  /// Throws Error naming the image if it is missing, damaged, of another size or of an unknown kind.
  virtual cv::Mat colour(cv::Size size, ColourMode mode) const = 0;
  /// Whether colour() in grey is something else than the conversion of colour() as stored: where the
  /// brightness is stored apart from the colours, as JPEG and YUV do.
  virtual bool stores_brightness() const { return false; }
  /// CV_16UC1 in Camera::depth_units_per_metre, 0 = missing, or CV_32FC1 in metres, <= 0 or NaN = missing; as
  /// recorded, not registered. Size and errors: as above.
  virtual cv::Mat depth(cv::Size size) const = 0;
  /// The colour image as the PNG or JPEG that it is stored as; nothing if it is stored otherwise. Throws
  /// Error if it cannot be read.
  virtual std::optional<std::vector<std::uint8_t>> colour_file() const { return std::nullopt; }
};

/// A colour image and the depth image that belongs to it, still packed.
struct SourceFrame {
  double timestamp = 0;        ///< of the colour image [s]
  double depth_timestamp = 0;  ///< [s]
  std::string name;   ///< stem of the colour image's file, or the time as "%.6f": for results and masks
  std::string where;  ///< of the colour image, for messages: "rgb/0.png (rgb.txt:2)"
  std::vector<ImuSample> imu;  ///< readings after the last frame's time, up to this one's; may be empty
  std::shared_ptr<const PackedImages> images;
};

/// What one stream of a source is, for people: `stdc-slam info` prints it.
struct StreamInfo {
  std::string name;          ///< topic, folder or list: "/camera/color/image_raw", "rgb.txt"
  std::string content;       ///< "colour images, rgb8", "camera info", "ground truth"
  std::optional<int> count;  ///< messages or files, if known without reading all
  bool used = true;          ///< false: there, but not read
};

/// An RGB-D recording or camera: gives frames in order of time. Layouts of files are in layouts/, recordings
/// of robots in recordings/. To be used by one thread at a time; frames are for any thread.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  /// The next frame; nothing at the end. A source that is damaged ends there and adds a line to faults().
  virtual std::optional<SourceFrame> next() = 0;
  /// Starts again from the first frame. Only if can_rewind().
  virtual void rewind() = 0;
  /// False for live cameras.
  virtual bool can_rewind() const { return true; }
  /// Whether frames come at a pace of their own, until stop() is called: next() waits for them, and those
  /// that are not asked for in time are lost.
  virtual bool is_live() const { return false; }
  /// Ends a live source: next() gives what has come already, then nothing. From any thread.
  virtual void stop() {}
  /// Frames of a live source that were left out so far because they came too late.
  virtual int dropped() const { return 0; }
  /// How many frames next() gives in all; nothing if that is not known before the end.
  virtual std::optional<int> frame_count() const = 0;
  /// About how many, for a progress bar.
  virtual std::optional<int> expected_frame_count() const { return frame_count(); }
  /// Times of all these frames [s]; nothing if they are not known without reading the frames.
  virtual std::optional<std::vector<double>> frame_times() const { return std::nullopt; }
  /// Names of the colour images of these frames (SourceFrame::name), where they are files; else empty.
  virtual std::vector<std::string> frame_names() const { return {}; }

  /// The cameras as the source knows them; nothing if it does not.
  virtual std::optional<RgbdCameras> cameras() const = 0;
  /// What the user can do where cameras() is nothing, for the hint of an Error.
  virtual std::string camera_hint() const { return "give a camera file with --camera"; }
  /// The true trajectory; nothing if the source has none. Throws Error if it is there but cannot be read.
  virtual std::optional<GroundTruth> ground_truth() const { return std::nullopt; }
  /// Whether ground_truth() goes through the whole input unless it is called when next() has reached the end.
  virtual bool truth_comes_last() const { return false; }
  /// Where a ground truth is, or would be, for messages.
  virtual std::string truth_where() const { return where(); }

  /// Name of the kind, one of source_kinds(): "tum".
  virtual std::string kind() const = 0;
  /// File, folder or device, for messages.
  virtual std::string where() const = 0;
  virtual std::vector<StreamInfo> streams() const { return {}; }
  /// What the user ought to know of how the source was understood, a line each without "stdc-slam:": settled
  /// when it is opened.
  virtual std::vector<std::string> notes() const { return {}; }
  /// What was wrong with the data so far, a line each; grows while frames are read.
  virtual std::vector<std::string> faults() const { return {}; }
  /// Colour images that found no depth image so far; they are not among the frames.
  virtual int colour_without_depth() const { return 0; }
};

}  // namespace stdc
