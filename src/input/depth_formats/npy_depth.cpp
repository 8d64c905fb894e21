#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <opencv2/core.hpp>
#include <string_view>
#include <vector>

#include "input/depth_formats/depth_formats.hpp"
#include "input/depth_formats/expected_size.hpp"

namespace stdc {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";

DecodedImage fault(std::string problem) { return {cv::Mat(), std::move(problem)}; }

struct Header {
  std::string_view type;  ///< "<f4"
  bool fortran_order = false;
  std::vector<std::int64_t> shape;
  std::size_t data_at = 0;
};

/// What follows "'key':" in the header, a Python dictionary.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  const std::size_t colon = header.find(':', at);
  if (colon == std::string_view::npos) return {};
  std::string_view value = header.substr(colon + 1);
  value.remove_prefix(std::min(value.find_first_not_of(' '), value.size()));
  return value;
}

std::vector<std::int64_t> parse_shape(std::string_view text) {
  std::vector<std::int64_t> shape;
  if (!text.starts_with('(')) return {};
  text = text.substr(1, text.find(')') == std::string_view::npos ? 0 : text.find(')') - 1);
  while (!text.empty()) {
    const std::size_t start = std::min(text.find_first_of("0123456789"), text.size());
    if (start == text.size()) break;
    std::int64_t number = 0;
    const auto [end, failed] = std::from_chars(text.data() + start, text.data() + text.size(), number);
    if (failed != std::errc() || shape.size() > 3) return {};
    shape.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
  // One channel, written as such.
  if (shape.size() == 3 && shape.front() == 1) shape.erase(shape.begin());
  if (shape.size() == 3 && shape.back() == 1) shape.pop_back();
  return shape;
}

bool parse_header(Bytes bytes, Header& header) {
  constexpr std::size_t kLengthAt = 8;
  const bool wide = bytes.size() > 6 && bytes[6] >= 2;
  const std::size_t start = kLengthAt + (wide ? 4 : 2);
  if (bytes.size() < start) return false;
  std::size_t length = 0;
  for (std::size_t i = start; i > kLengthAt; --i) length = length << 8U | bytes[i - 1];
  if (length > bytes.size() - start) return false;
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()) + start, length);
  header.type = value_of(text, "'descr'");
  header.fortran_order = value_of(text, "'fortran_order'").starts_with("True");
  header.shape = parse_shape(value_of(text, "'shape'"));
  header.data_at = start + length;
  return header.type.size() > 4 && header.shape.size() == 2;
}

/// A half in the bits of a float (IEEE 754 binary16).
float half_to_float(std::uint16_t half) {
  const std::uint32_t sign = (half & 0x8000U) << 16U, exponent = half >> 10U & 31U, fraction = half & 1023U;
  if (exponent == 31) return std::bit_cast<float>(sign | 0x7f800000U | fraction << 13U);
  if (exponent != 0) return std::bit_cast<float>(sign | (exponent + 112) << 23U | fraction << 13U);
  const float small = static_cast<float>(fraction) * 0x1p-24F;
  return sign != 0 ? -small : small;
}

/// The bytes of one number of `T`, turned round if need be.
template <typename T>
T number_at(const std::uint8_t* bytes, bool turned) {
  std::array<std::uint8_t, sizeof(T)> own{};
  std::memcpy(own.data(), bytes, sizeof(T));
  if (turned) std::reverse(own.begin(), own.end());
  return std::bit_cast<T>(own);
}

/// Reads numbers stored as `Stored` into an image of `Pixel`.
template <typename Stored, typename Pixel, typename Convert>
DecodedImage read_pixels(Bytes bytes, const Header& header, cv::Size size, int type, bool turned,
                         const Convert& convert) {
  const auto count = static_cast<std::size_t>(size.area());
  if (bytes.size() - header.data_at < count * sizeof(Stored)) return fault("the NPY ends too early");
  cv::Mat image(size, type);
  const std::uint8_t* data = bytes.data() + header.data_at;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const std::size_t at = header.fortran_order
                                 ? static_cast<std::size_t>(x) * static_cast<std::size_t>(size.height) +
                                       static_cast<std::size_t>(y)
                                 : static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) +
                                       static_cast<std::size_t>(x);
      image.at<Pixel>(y, x) = convert(number_at<Stored>(data + at * sizeof(Stored), turned));
    }
  }
  return {image, ""};
}

}  // namespace

bool is_npy(Bytes bytes) {
  return bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
}

DecodedImage decode_npy_depth(Bytes bytes, cv::Size size) {
  Header header;
  if (!is_npy(bytes) || !parse_header(bytes, header)) return fault("is no NPY of a two-dimensional array");
  const std::string problem = size_problem(header.shape[1], header.shape[0], size);
  if (!problem.empty()) return fault(problem);
  const cv::Size own(static_cast<int>(header.shape[1]), static_cast<int>(header.shape[0]));
  const bool turned = header.type[1] == '>';  // the machine is little-endian, as '<' and '=' say
  const std::string_view kind = header.type.substr(2, 2);
  const auto as_float = [](auto value) { return static_cast<float>(value); };
  if (kind == "u2") {
    return read_pixels<std::uint16_t, std::uint16_t>(bytes, header, own, CV_16UC1, turned,
                                                     [](std::uint16_t v) { return v; });
  }
  if (kind == "f2")
    return read_pixels<std::uint16_t, float>(bytes, header, own, CV_32FC1, turned, half_to_float);
  if (kind == "f4") return read_pixels<float, float>(bytes, header, own, CV_32FC1, turned, as_float);
  if (kind == "f8") return read_pixels<double, float>(bytes, header, own, CV_32FC1, turned, as_float);
  return fault(fmt::format("is an NPY of the type {}, depth is uint16 (units) or floating point (metres)",
                           std::string(header.type.substr(1, 3))));
}

}  // namespace stdc
