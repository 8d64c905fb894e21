#include <fmt/format.h>

#include <algorithm>

#include "input/recordings/topic_choice.hpp"

namespace stdc {

std::vector<StreamInfo> streams_of(const Recording& recording, const RecordingSurvey& survey,
                                   const TopicChoice& choice) {
  std::vector<StreamInfo> streams;
  for (std::size_t i = 0; i < recording.topics().size(); ++i) {
    const RecordedTopic& topic = recording.topics()[i];
    const int index = static_cast<int>(i);
    StreamInfo info{topic.name, topic.type, std::nullopt, false};
    if (const ImageSample* sample = survey.find(topic.name)) {
      info.content = fmt::format("{}, {} x {}", sample->encoding, sample->size.width, sample->size.height);
    }
    if (topic.count) info.count = static_cast<int>(std::min<std::uint64_t>(*topic.count, 1'000'000'000));
    info.used = index == choice.colour || index == choice.depth || choice.colour_info == index ||
                choice.depth_info == index || choice.imu == index || choice.truth == index;
    streams.push_back(std::move(info));
  }
  return streams;
}

}  // namespace stdc
