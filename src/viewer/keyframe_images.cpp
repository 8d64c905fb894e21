#include "viewer/keyframe_images.hpp"

#include <string_view>
#include <utility>

#include "viewer/messages/byte_writer.hpp"
#include "viewer/messages/image_message.hpp"

namespace stdc {
namespace {

ViewMessage make_message(std::uint32_t frame, std::string_view jpeg) {
  ByteWriter bytes;
  bytes.put(frame);
  bytes.put_bytes(jpeg);
  return std::make_shared<const std::string>(bytes.take());
}

}  // namespace

void KeyframeImages::add(int frame, const cv::Mat& colour) {
  constexpr int kSmallWidth = 320, kSmallQuality = 75;
  const auto key = static_cast<std::uint32_t>(frame);
  ViewMessage message = make_message(key, encode_small_jpeg(colour, kSmallWidth, kSmallQuality));
  const std::lock_guard lock(mutex_);
  bytes_ += message->size();
  messages_[key] = std::move(message);
  while (bytes_ > max_bytes_ && messages_.size() > 1) {
    bytes_ -= messages_.begin()->second->size();
    messages_.erase(messages_.begin());
  }
}

ViewMessage KeyframeImages::message(std::uint32_t frame) const {
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = messages_.find(frame); found != messages_.end()) return found->second;
  }
  return make_message(frame, {});
}

}  // namespace stdc
