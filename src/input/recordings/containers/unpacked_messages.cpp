#include "input/recordings/containers/unpacked_messages.hpp"

#include <set>
#include <utility>

#include "input/recordings/containers/decompression.hpp"
#include "input/recordings/containers/unpacked_file.hpp"

namespace stdc {
namespace {

class UnpackedMessages : public Recording {
 public:
  explicit UnpackedMessages(std::unique_ptr<Recording> packed) : packed_(std::move(packed)) {}

  std::string where() const override { return packed_->where(); }
  std::string format() const override { return packed_->format(); }
  const std::vector<RecordedTopic>& topics() const override { return packed_->topics(); }
  std::optional<LogTime> first_time() const override { return packed_->first_time(); }
  std::optional<LogTime> last_time() const override { return packed_->last_time(); }
  void start(std::span<const int> topics, LogTime from, LogTime until) override {
    packed_->start(topics, from, until);
  }

  std::optional<RecordedMessage> next() override {
    while (std::optional<RecordedMessage> message = packed_->next()) {
      const RecordedTopic& topic = topics()[static_cast<std::size_t>(message->topic)];
      if (topic.serialisation != Serialisation::cdr || !is_zstd(message->data)) return message;
      const std::string problem = decompress("zstd", message->data, std::nullopt, bytes_);
      if (problem.empty()) return RecordedMessage{message->topic, message->log_time, bytes_};
      faults_.insert(where() + ": a message of " + topic.name + " is left out: " + problem);
    }
    return std::nullopt;
  }

  std::vector<std::string> faults() const override {
    std::vector<std::string> faults = packed_->faults();
    faults.insert(faults.end(), faults_.begin(), faults_.end());
    return faults;
  }

 private:
  std::unique_ptr<Recording> packed_;
  std::vector<std::uint8_t> bytes_;
  std::set<std::string> faults_;
};

}  // namespace

std::unique_ptr<Recording> unpack_messages(std::unique_ptr<Recording> recording) {
  return std::make_unique<UnpackedMessages>(std::move(recording));
}

}  // namespace stdc
