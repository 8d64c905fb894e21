#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <opencv2/core.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/camera.hpp"
#include "core/files/new_folders.hpp"

namespace stdc {

/// Where a sequence is to be written, and what may be replaced there.
struct TumTarget {
  std::filesystem::path folder;
  /// Sub-folders of images: "rgb" and "depth", which get lists, and others, named like "rgb" without a list.
  std::vector<std::string> parts{"rgb", "depth"};
  /// A folder that is there already is replaced if this is in it and nothing but `parts` and the files of a
  /// sequence; empty: only an empty folder is.
  std::string replaceable{};
  std::string option = "--output";  ///< by which the user gave the folder, for messages
  std::string hint = "choose another --output";
};

/// Writes a folder in TUM RGB-D layout: images as PNG, named by their times, their lists rgb.txt and
/// depth.txt, camera.yaml and groundtruth.txt. All files go to a hidden folder beside it, which takes its
/// place in commit(): a sequence is never there half written.
class TumWriter {
 public:
  /// Throws Error if something is at the place that must not be replaced, or if it cannot be written to.
  explicit TumWriter(TumTarget target);
  /// Removes what was written if `commit` was not reached, and the folders above that were made for it.
  ~TumWriter();
  TumWriter(const TumWriter&) = delete;
  TumWriter& operator=(const TumWriter&) = delete;

  /// Writes PART/TIMESTAMP.png; several threads may do so at once.
  /// @param timestamp  [s]; two images of a part must not have the same to the microsecond: the later one
  /// stays Throws Error if the disk is full or a file cannot be written, as do the others.
  void write_image(const std::string& part, double timestamp, const cv::Mat& image);
  /// Writes PART/TIMESTAMP.EXTENSION: an image that is a file already. Otherwise as write_image.
  void write_image_file(const std::string& part, double timestamp, const std::string& extension,
                        std::span<const std::uint8_t> bytes);
  void write_camera(const Camera& camera);
  /// Any other file, for instance groundtruth.txt; `name` has no folders.
  void write_text(const std::string& name, const std::string& text);
  /// A file of another place, as it is.
  void copy_file(const std::string& name, const std::filesystem::path& source);
  /// Writes the lists and puts the folder in its place.
  void commit();

  /// As an absolute path without a slash at its end.
  const std::filesystem::path& folder() const { return target_.folder; }

 private:
  void check_place() const;
  void write_list(const std::string& part, const std::string& title) const;
  [[noreturn]] void cannot_write(const std::string& why) const;

  TumTarget target_;
  NewFolders above_;
  std::filesystem::path partial_;
  std::mutex mutex_;
  std::map<std::string, std::map<double, std::string>> names_;  ///< file names of each part, by time
};

}  // namespace stdc
