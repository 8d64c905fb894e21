#include "features/mask.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace stdc {

bool is_set_at(const cv::Mat& mask, float x, float y) {
  const int column = std::clamp(static_cast<int>(std::lround(x)), 0, mask.cols - 1);
  const int row = std::clamp(static_cast<int>(std::lround(y)), 0, mask.rows - 1);
  return mask.at<std::uint8_t>(row, column) != 0;
}
namespace {

using Words = std::vector<std::uint64_t>;

/// One bit for each of eight bytes, set where the byte is not zero; the first byte gives the lowest bit.
std::uint64_t bits_of(const std::uint8_t* bytes) {
  constexpr std::uint64_t kLow = 0x7f7f7f7f7f7f7f7fU, kGather = 0x0102040810204080U;
  std::uint64_t eight = 0;
  std::memcpy(&eight, bytes, sizeof(eight));
  const std::uint64_t high = (((eight & kLow) + kLow) | eight) & ~kLow;
  return ((high >> 7U) * kGather) >> 56U;
}

/// Joins the row with itself moved towards higher x by `step` < 64 pixels.
void join_moved(Words& row, unsigned step) {
  for (std::size_t i = row.size(); i-- > 0;) {
    const std::uint64_t below = i > 0 ? row[i - 1] >> (64U - step) : 0;
    row[i] |= row[i] << step | below;
  }
}

/// Every bit becomes a run of 2 radius + 1 around it. `row`: scratch.
void spread_along(std::uint64_t* words, std::size_t count, int radius, Words& row) {
  row.assign(count + static_cast<std::size_t>(2 * radius) / 64 + 1, 0);
  for (std::size_t i = 0; i < count; ++i) row[i] = words[i];
  // Runs that begin at the bit, doubled until they are long enough; then moved back by the radius.
  for (int length = 1; length < 2 * radius + 1;) {
    const int step = std::min({length, 2 * radius + 1 - length, 63});
    join_moved(row, static_cast<unsigned>(step));
    length += step;
  }
  const auto whole = static_cast<std::size_t>(radius) / 64;
  const auto rest = static_cast<unsigned>(radius) % 64U;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t next = i + whole + 1 < row.size() ? row[i + whole + 1] : 0;
    words[i] = rest == 0 ? row[i + whole] : row[i + whole] >> rest | next << (64U - rest);
  }
}

/// Joins each row with the `radius` rows above and below. `padded`: scratch.
void spread_down(Words& rows, std::size_t words, int radius, Words& padded) {
  // Windows begin `radius` rows above their middle: so many empty rows stand before the first.
  const std::size_t before = static_cast<std::size_t>(radius) * words;
  padded.assign(before + rows.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) padded[before + i] = rows[i];
  for (int length = 1; length < 2 * radius + 1;) {
    const int step = std::min(length, 2 * radius + 1 - length);
    const std::size_t offset = static_cast<std::size_t>(step) * words;
    for (std::size_t i = 0; i + offset < padded.size(); ++i) padded[i] |= padded[i + offset];
    length += step;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = padded[i];
}

}  // namespace

void DynamicArea::set(const cv::Mat& mask) {
  width_ = mask.cols;
  height_ = mask.rows;
  words_ = (static_cast<std::size_t>(width_) + 63) / 64;
  rows_.assign(words_ * static_cast<std::size_t>(height_), 0);
  std::uint64_t any = 0;
  for (int y = 0; y < height_; ++y) {
    const std::uint8_t* row = mask.ptr(y);
    std::uint64_t* words = rows_.data() + static_cast<std::size_t>(y) * words_;
    int x = 0;
    for (; x + 8 <= width_; x += 8) words[x / 64] |= bits_of(row + x) << (x % 64U);
    for (; x < width_; ++x) words[x / 64] |= static_cast<std::uint64_t>(row[x] != 0 ? 1 : 0) << (x % 64U);
    for (std::size_t word = 0; word < words_; ++word) any |= words[word];
  }
  empty_ = any == 0;
  spread_ = rows_;
  radius_ = 0;
}

void DynamicArea::spread(int radius) {
  if (empty_) return;
  if (radius < radius_) {
    spread_ = rows_;
    radius_ = 0;
  }
  // Squares add up: what was spread before is spread by the rest.
  const int more = radius - std::exchange(radius_, radius);
  if (more == 0) return;
  for (int y = 0; y < height_; ++y) {
    std::uint64_t* words = spread_.data() + static_cast<std::size_t>(y) * words_;
    if (std::all_of(words, words + words_, [](std::uint64_t word) { return word == 0; })) continue;
    spread_along(words, words_, more, scratch_);
  }
  spread_down(spread_, words_, more, scratch_);
}

}  // namespace stdc
