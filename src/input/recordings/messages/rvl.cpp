#include "input/recordings/messages/rvl.hpp"

#include <cstring>

namespace stdc {
namespace {

/// The stream of four-bit groups, eight of them in each word of four bytes, highest first.
class Groups {
 public:
  explicit Groups(Bytes bytes) : bytes_(bytes) {}
  bool ok() const { return ok_; }

  /// Three bits from each group, lowest first, up to a group whose fourth bit is not set.
  std::uint32_t number() {
    std::uint32_t value = 0;
    for (int shift = 0; shift < 32; shift += 3) {
      const std::uint32_t group = next();
      value |= (group & 7U) << static_cast<unsigned>(shift);
      if ((group & 8U) == 0) return value;
    }
    ok_ = false;
    return 0;
  }

 private:
  std::uint32_t next() {
    if (left_ == 0) {
      if (bytes_.size() < sizeof(word_)) {
        ok_ = false;
        return 0;
      }
      std::memcpy(&word_, bytes_.data(), sizeof(word_));
      bytes_ = bytes_.subspan(sizeof(word_));
      left_ = 8;
    }
    const std::uint32_t group = word_ >> 28U;
    word_ <<= 4U;
    --left_;
    return group;
  }

  Bytes bytes_;
  std::uint32_t word_ = 0;
  int left_ = 0;
  bool ok_ = true;
};

}  // namespace

DecodedImage decode_rvl(Bytes bytes, cv::Size size) {
  // A few bytes may claim to be any number of zeros.
  constexpr std::int64_t kMaxPixels = 64 << 20;
  if (std::int64_t{size.width} * size.height > kMaxPixels) return {{}, "its RVL data claim too many pixels"};
  cv::Mat image = cv::Mat::zeros(size, CV_16UC1);
  auto* pixels = image.ptr<std::uint16_t>();
  const std::size_t count = image.total();
  Groups groups(bytes);
  std::uint32_t previous = 0;
  for (std::size_t at = 0; at < count;) {
    const std::uint32_t zeros = groups.number(), values = groups.number();
    if (!groups.ok() || zeros > count - at || values > count - at - zeros || zeros + values == 0) {
      return {{}, "its RVL data are damaged or end too early"};
    }
    at += zeros;
    for (std::uint32_t i = 0; i < values; ++i) {
      const std::uint32_t coded = groups.number();
      previous += (coded >> 1U) ^ (0U - (coded & 1U));  // 0, -1, 1, -2, ...
      pixels[at++] = static_cast<std::uint16_t>(previous);
    }
  }
  if (!groups.ok()) return {{}, "its RVL data are damaged or end too early"};
  return {image, ""};
}

}  // namespace stdc
