#include "input/recordings/containers/packed_messages.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/error.hpp"
#include "input/recordings/messages/message_image.hpp"
#include "input/recordings/messages/stamp.hpp"

namespace stdc {
namespace {

[[noreturn]] void fail(const PackedMessage& message, const std::string& problem) {
  throw Error(
      message.where(), problem,
      fmt::format("leave the frame out, or record with an encoding that is known: {}", known_encodings()));
}

/// Before memory is taken for it.
void check_size(const PackedMessage& message, cv::Size has, cv::Size wanted) {
  if (wanted.empty() || has == wanted) return;
  throw Error(message.where(),
              fmt::format("is {} x {} pixels, but the camera has {} x {}", has.width, has.height,
                          wanted.width, wanted.height),
              "give the camera of these images with --camera or --info");
}

/// Calls one of two functions with the message, depending on its kind.
template <typename Raw, typename Compressed>
cv::Mat unpack(const PackedMessage& message, cv::Size size, const Raw& raw, const Compressed& compressed) {
  DecodedImage decoded;
  if (message.topic->compressed) {
    const auto image = read_compressed_image_message(message.topic->serialisation, *message.data);
    if (!image) fail(message, "the message is damaged");
    if (const auto has = size_of(*image)) check_size(message, *has, size);
    decoded = compressed(*image);
  } else {
    const auto image = read_image_message(message.topic->serialisation, *message.data);
    if (!image) fail(message, "the message is damaged");
    check_size(message, {static_cast<int>(image->width), static_cast<int>(image->height)}, size);
    decoded = raw(*image);
  }
  if (!decoded.problem.empty()) fail(message, decoded.problem);
  return decoded.image;
}

class MessageImages : public PackedImages {
 public:
  MessageImages(PackedMessage colour, PackedMessage depth)
      : colour_(std::move(colour)), depth_(std::move(depth)) {}

  cv::Mat colour(cv::Size size, ColourMode mode) const override {
    const auto decode = [&](const auto& image) { return colour_of(image, mode); };
    return unpack(colour_, size, decode, decode);
  }
  bool stores_brightness() const override {
    const auto stores = [](const auto& image) { return image && stdc::stores_brightness(*image); };
    const Serialisation serialisation = colour_.topic->serialisation;
    return colour_.topic->compressed ? stores(read_compressed_image_message(serialisation, *colour_.data))
                                     : stores(read_image_message(serialisation, *colour_.data));
  }
  std::optional<std::vector<std::uint8_t>> colour_file() const override {
    if (!colour_.topic->compressed) return std::nullopt;
    const auto image = read_compressed_image_message(colour_.topic->serialisation, *colour_.data);
    if (!image || !(is_png(image->data) || is_jpeg(image->data))) return std::nullopt;
    return std::vector<std::uint8_t>(image->data.begin(), image->data.end());
  }
  cv::Mat depth(cv::Size size) const override {
    const auto decode = [](const auto& image) { return depth_of(image); };
    return unpack(depth_, size, decode, decode);
  }

 private:
  PackedMessage colour_, depth_;
};

}  // namespace

std::string PackedMessage::where() const {
  return fmt::format("{} ({} at {})", topic->file, topic->name, stamp_text(stamp));
}

std::shared_ptr<const PackedImages> pack_images(PackedMessage colour, PackedMessage depth) {
  return std::make_shared<MessageImages>(std::move(colour), std::move(depth));
}

}  // namespace stdc
