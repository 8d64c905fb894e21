#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "input/frame_source.hpp"
#include "input/recordings/recording.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// Opens a robot's recording as a source of RGB-D frames: chooses topics, pairs colour and depth by the
/// stamps of their headers, and reads on with a bounded queue. Throws Error, naming file, topic and remedy,
/// if there is no sensible choice of topics, or if colour and depth have no common clock.
std::unique_ptr<FrameSource> open_recording_source(const std::filesystem::path& path,
                                                   const SourceOptions& options);
bool is_mcap_recording(const std::filesystem::path& path);
bool is_db3_recording(const std::filesystem::path& path);
bool is_bag_recording(const std::filesystem::path& path);

/// The same of any recording; `open` may be called several times.
std::unique_ptr<FrameSource> make_recording_source(const std::function<std::unique_ptr<Recording>()>& open,
                                                   const SourceOptions& options);

}  // namespace stdc
