#include "input/recordings/containers/rosbag2_folder.hpp"

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "input/recordings/containers/rosbag2_metadata.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

using OpenFile = std::unique_ptr<Recording> (*)(const fs::path&);

/// Whether one name comes before another, with numbers in them by their value: x_9 before x_10.
bool naturally_before(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  const auto digits = [](const std::string& text, std::size_t& at) {
    const std::size_t first = at;
    while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    const std::size_t value = std::min(text.find_first_not_of('0', first), at);
    return text.substr(value, at - value);
  };
  while (i < a.size() && j < b.size()) {
    const std::string m = digits(a, i), n = digits(b, j);
    if (m != n) return m.size() != n.size() ? m.size() < n.size() : m < n;
    if (i == a.size() || j == b.size()) break;
    if (a[i] != b[j]) return a[i] < b[j];
    ++i, ++j;
  }
  return a.size() - i < b.size() - j;
}

std::vector<fs::path> storage_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed)) {
    if (entry->is_regular_file(failed) && !storage_format(entry->path()).empty())
      files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturally_before(a.filename().string(), b.filename().string());
  });
  return files;
}

class Rosbag2Folder : public Recording {
 public:
  Rosbag2Folder(const fs::path& folder, OpenFile open_file) : folder_(folder), open_file_(open_file) {
    const fs::path metadata = folder / kRosbag2Metadata;
    std::error_code failed;
    if (fs::exists(metadata, failed)) {
      take(parse_rosbag2_metadata(read_file(metadata, "", std::size_t{16} << 20U), metadata.string()));
    } else {
      look_into_files();
    }
  }

  std::string where() const override { return folder_.string(); }
  std::string format() const override { return format_; }
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::optional<LogTime> first_time() const override { return first_; }
  std::optional<LogTime> last_time() const override { return last_; }

  void start(std::span<const int> topics, LogTime from, LogTime until) override {
    chosen_.assign(topics.begin(), topics.end());
    from_ = from;
    until_ = until;
    keep_faults();
    part_.reset();
    next_file_ = 0;
  }

  std::optional<RecordedMessage> next() override {
    for (;;) {
      if (part_) {
        if (const std::optional<RecordedMessage> message = part_->next()) {
          return RecordedMessage{topic_of_part_[static_cast<std::size_t>(message->topic)], message->log_time,
                                 message->data};
        }
      }
      keep_faults();
      part_.reset();
      if (next_file_ == files_.size() || !open_next()) return std::nullopt;
    }
  }

  std::vector<std::string> faults() const override {
    std::vector<std::string> faults = faults_;
    if (part_) add_new(part_->faults(), faults);
    return faults;
  }

 private:
  void take(const Rosbag2Metadata& metadata) {
    for (const std::string& file : metadata.files) {
      fs::path path = folder_ / file;
      std::error_code failed;
      // Older versions name the files as they were recorded, with the name of the folder in front.
      if (!fs::exists(path, failed)) path = folder_ / fs::path(file).filename();
      if (!fs::exists(path, failed)) {
        add_new(
            {where() + ": the file " + file + " that metadata.yaml names is not there; the others are read"},
            faults_);
        continue;
      }
      files_.push_back(path);
    }
    if (files_.empty()) {
      throw Error((folder_ / kRosbag2Metadata).string(), "names files that are not there",
                  "copy the whole folder");
    }
    topics_ = metadata.topics;
    first_ = metadata.first, last_ = metadata.last;
    format_ = storage_format(files_.front());
  }

  /// Without metadata.yaml each file is asked for its topics and times.
  void look_into_files() {
    files_ = storage_files(folder_);
    if (files_.empty()) {
      throw Error(where(), "holds no recording",
                  "give a folder of rosbag2: metadata.yaml and .mcap or .db3 files");
    }
    add_new({where() + ": there is no metadata.yaml, as if the recorder had been stopped; its files are read "
                       "in the order of their numbers"},
            faults_);
    std::map<std::string, RecordedTopic> topics;
    for (const fs::path& file : files_) {
      const std::unique_ptr<Recording> part = open_file_(file);
      for (const RecordedTopic& topic : part->topics()) {
        RecordedTopic& known = topics.try_emplace(topic.name, topic).first->second;
        known.count.reset();
      }
      if (!first_ || (part->first_time() && *part->first_time() < *first_)) first_ = part->first_time();
      if (!last_ || (part->last_time() && *part->last_time() > *last_)) last_ = part->last_time();
      add_new(part->faults(), faults_);
    }
    for (auto& [name, topic] : topics) topics_.push_back(std::move(topic));
    format_ = storage_format(files_.front());
  }

  static void add_new(const std::vector<std::string>& lines, std::vector<std::string>& to) {
    for (const std::string& line : lines) {
      if (std::find(to.begin(), to.end(), line) == to.end()) to.push_back(line);
    }
  }

  void keep_faults() {
    if (part_) add_new(part_->faults(), faults_);
  }

  /// Opens the next file that can be opened. False if there is none.
  bool open_next() {
    while (next_file_ < files_.size()) {
      try {
        part_ = open_file_(files_[next_file_++]);
        break;
      } catch (const Error& error) {
        add_new({std::string(error.what()) + "; the file is left out"}, faults_);
      }
    }
    if (!part_) return false;
    topic_of_part_.assign(part_->topics().size(), 0);
    std::vector<int> chosen;
    for (const int topic : chosen_) {
      const RecordedTopic& wanted = topics_.at(static_cast<std::size_t>(topic));
      const std::optional<int> found = part_->find_topic(wanted.name);
      if (!found) continue;
      topic_of_part_[static_cast<std::size_t>(*found)] = topic;
      chosen.push_back(*found);
    }
    part_->start(chosen, from_, until_);
    return true;
  }

  fs::path folder_;
  OpenFile open_file_;
  std::string format_;
  std::vector<fs::path> files_;
  std::vector<RecordedTopic> topics_;
  std::optional<LogTime> first_, last_;
  std::vector<std::string> faults_;

  std::vector<int> chosen_;
  LogTime from_ = kBegin, until_ = kEnd;
  std::size_t next_file_ = 0;
  std::unique_ptr<Recording> part_;  ///< null: none is open
  std::vector<int> topic_of_part_;   ///< by its index in the open file
};

}  // namespace

std::string storage_format(const fs::path& file) {
  fs::path name = file.filename();
  if (name.extension() == ".zstd") name = name.stem();
  if (name.extension() == ".mcap") return "mcap";
  return name.extension() == ".db3" ? "db3" : "";
}

std::string rosbag2_format(const fs::path& folder) {
  const std::vector<fs::path> files = storage_files(folder);
  return files.empty() ? "" : storage_format(files.front());
}

std::unique_ptr<Recording> open_rosbag2_folder(const fs::path& folder, OpenFile open_file) {
  return std::make_unique<Rosbag2Folder>(folder, open_file);
}

}  // namespace stdc
