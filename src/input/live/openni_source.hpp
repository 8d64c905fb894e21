#pragma once

#include <filesystem>
#include <memory>

#include "input/frame_source.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// "openni2:" (the first device that is found) or "openni2:URI".
bool is_openni_device(const std::filesystem::path& path);
/// A camera by OpenNI 2: Kinect 360, Xtion, Astra, with their drivers. Depth is registered by the device
/// where it can. OpenNI knows no intrinsics: the camera file gives them. Throws Error if this build lacks
/// OpenNI, if there is no such device, or if it has not both kinds of images.
std::unique_ptr<FrameSource> open_openni_device(const std::filesystem::path& path,
                                                const SourceOptions& options);

}  // namespace stdc
