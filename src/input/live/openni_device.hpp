#pragma once

#include <OpenNI.h>

#include <span>
#include <string>
#include <vector>

namespace stdc {

/// A camera of OpenNI 2 with both kinds of images under way; closed when it goes. Only where the build has
/// OpenNI.
class OpenNiDevice {
 public:
  /// Throws Error if there is no such device, or if it does not give both.
  /// @param uri  empty: the first device that is found
  explicit OpenNiDevice(const std::string& uri);
  ~OpenNiDevice();
  OpenNiDevice(const OpenNiDevice&) = delete;
  OpenNiDevice& operator=(const OpenNiDevice&) = delete;

  openni::VideoStream& colour() { return colour_; }
  openni::VideoStream& depth() { return depth_; }
  const openni::VideoStream& colour() const { return colour_; }
  const openni::VideoStream& depth() const { return depth_; }
  bool is_there() const { return device_.isValid(); }
  const std::string& where() const { return where_; }
  /// What the user should know of it.
  const std::vector<std::string>& notes() const { return notes_; }
  /// How to describe it in a camera file, since OpenNI tells no intrinsics.
  std::string camera_hint() const;
  /// Size and rate.
  static std::string describe(const openni::VideoStream& stream);
  /// OpenNI's own words on the last failure, in one line.
  static std::string reason();

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& hint) const;
  void open(const std::string& uri);
  void start(openni::VideoStream& stream, openni::SensorType type,
             std::span<const openni::PixelFormat> formats, const char* name);
  void register_depth();
  void close();

  std::string where_;
  openni::Device device_;
  openni::VideoStream colour_, depth_;
  std::vector<std::string> notes_;
};

}  // namespace stdc
