#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/files/image_list.hpp"
#include "core/images/image_codec.hpp"
#include "core/rgbd_image.hpp"
#include "input/ground_truth.hpp"
#include "input/image_file.hpp"
#include "input/rgbd_cameras.hpp"

namespace stdc {

/// One colour image and the depth image that belongs to it.
struct SequenceFrame {
  double timestamp = 0;        ///< of the colour image [s]
  double depth_timestamp = 0;  ///< [s]
  std::filesystem::path colour, depth;
  int line = 0;        ///< of rgb.txt, for messages
  int depth_line = 0;  ///< of depth.txt
};

/// A folder in TUM RGB-D layout: rgb.txt, depth.txt, optional groundtruth.txt and camera.yaml.
class TumSequence {
 public:
  /// Reads the lists and associates depth to colour: one to one, at most 20 ms apart, nearest pairs first.
  /// Throws Error for a missing folder or list, an empty or unordered one, bad numbers, no pair at all.
  /// @param rate  [Hz] takes the order of the lines for the time, in place of the stamps: line i of both
  /// lists
  ///              is frame i, at i / rate; they must be equally long
  explicit TumSequence(const std::filesystem::path& folder, std::optional<double> rate = {});

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<SequenceFrame>& frames() const { return frames_; }
  /// Colour images that found no depth image; they are not among the frames.
  int colour_without_depth() const { return colour_without_depth_; }
  bool has_ground_truth() const;
  /// Throws Error if there is none.
  GroundTruth ground_truth() const;

 private:
  void pair_by_stamps(const std::vector<ImageListEntry>& colour, const std::vector<ImageListEntry>& depth);
  void pair_by_order(const std::vector<ImageListEntry>& colour, const std::vector<ImageListEntry>& depth,
                     double rate);
  void add(const ImageListEntry& colour, const ImageListEntry& depth);

  std::filesystem::path folder_;
  std::optional<double> rate_;
  std::vector<SequenceFrame> frames_;
  int colour_without_depth_ = 0;
};

/// The images of a frame, as messages call them.
ImageFile colour_file(const SequenceFrame& frame);
ImageFile depth_file(const SequenceFrame& frame);

/// Reads both images of a frame. `camera` is for checking sizes and depth. Throws Error naming the image for
/// a missing, truncated or undecodable file, wrong size, wrong bit depth or channels.
RgbdImage load_frame(const SequenceFrame& frame, const Camera& camera,
                     ColourMode mode = ColourMode::as_stored);

/// The camera of a sequence: `camera_file` if given, else camera.yaml in the folder, else the TUM
/// freiburg1/2/3 calibration named in the folder's name, as given or as a link resolves it. Throws Error if
/// none is known or the file is wrong.
Camera find_camera(const TumSequence& sequence, const std::optional<std::filesystem::path>& camera_file);

/// The same without a camera file, and with the depth camera of camera.yaml; nothing if none is known.
std::optional<RgbdCameras> known_cameras(const TumSequence& sequence);
/// What a user can do if none is.
extern const char* const kTumCameraHint;

}  // namespace stdc
