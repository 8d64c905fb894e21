#include "input/recordings/containers/rosbag2_metadata.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/files/text_file.hpp"

namespace stdc {
namespace {

constexpr const char* kMetadataHint =
    "write it anew by 'ros2 bag reindex', or remove it: the files are then read by their numbers";

RecordedTopic topic_of(const YAML::Node& node) {
  RecordedTopic topic;
  const YAML::Node metadata = node["topic_metadata"];
  topic.name = metadata["name"].as<std::string>();
  topic.type = plain_type_name(metadata["type"].as<std::string>());
  if (metadata["serialization_format"].as<std::string>("cdr") == "cdr")
    topic.serialisation = Serialisation::cdr;
  topic.count = node["message_count"].as<std::uint64_t>();
  return topic;
}

std::string checked_file(const std::string& file, const std::string& name) {
  const std::filesystem::path path(file);
  const bool outside = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  if (file.empty() || outside)
    throw Error(name, "names a file outside its folder: " + shown(file), kMetadataHint);
  return file;
}

Rosbag2Metadata read(const YAML::Node& info, const std::string& name) {
  Rosbag2Metadata metadata;
  for (const YAML::Node& file : info["relative_file_paths"]) {
    metadata.files.push_back(checked_file(file.as<std::string>(), name));
  }
  for (const YAML::Node& topic : info["topics_with_message_count"])
    metadata.topics.push_back(topic_of(topic));
  std::sort(metadata.topics.begin(), metadata.topics.end(),
            [](const RecordedTopic& a, const RecordedTopic& b) { return a.name < b.name; });
  if (const YAML::Node start = info["starting_time"]["nanoseconds_since_epoch"]) {
    metadata.first = start.as<LogTime>();
    metadata.last = *metadata.first + info["duration"]["nanoseconds"].as<LogTime>(0);
  }
  return metadata;
}

}  // namespace

Rosbag2Metadata parse_rosbag2_metadata(const std::string& yaml, const std::string& name) {
  Rosbag2Metadata metadata;
  try {
    const YAML::Node info = YAML::Load(yaml)["rosbag2_bagfile_information"];
    if (!info || !info.IsMap()) throw Error(name, "has no rosbag2_bagfile_information", kMetadataHint);
    metadata = read(info, name);
  } catch (const YAML::Exception& error) {
    throw Error(name, "is damaged (" + shown(error.msg) + ")", kMetadataHint);
  }
  if (metadata.files.empty()) throw Error(name, "names no file", kMetadataHint);
  return metadata;
}

}  // namespace stdc
