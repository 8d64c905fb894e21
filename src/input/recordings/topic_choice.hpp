#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/frame_source.hpp"
#include "input/recordings/recording_survey.hpp"
#include "input/source_options.hpp"

namespace stdc {

/// The topics of a recording that make an RGB-D sequence: indices into Recording::topics().
struct TopicChoice {
  int colour = 0, depth = 0;
  std::optional<int> colour_info, depth_info, imu, truth;
  bool depth_is_registered = false;  ///< by the topic's name
};

/// Chooses topics: those that the options name, else the one sensible choice. Of a picture that was recorded
/// both raw and compressed the raw one; colour before grey; depth that the driver registered to colour before
/// other depth; depth and CameraInfo of the colour image's own camera. Throws Error, naming the topics that
/// there are and the option, if a named topic is not there or of the wrong kind, if there is no colour or
/// depth, or if several are as sensible.
TopicChoice choose_topics(const Recording& recording, const RecordingSurvey& survey,
                          const SourceOptions& options);

/// All topics, for people: those of images with encoding and size, and which are used.
std::vector<StreamInfo> streams_of(const Recording& recording, const RecordingSurvey& survey,
                                   const TopicChoice& choice);

}  // namespace stdc
