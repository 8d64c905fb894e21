#include "segmentation/network/kernels/class_map.hpp"

#include <algorithm>
#include <cstring>

namespace stdc {
namespace {

constexpr std::uint8_t kDynamic = 255;

}  // namespace

ClassMap::ClassMap(cv::Size logits, cv::Size mask, std::vector<bool> dynamic)
    : logits_size_(logits),
      size_(mask),
      dynamic_(std::move(dynamic)),
      two_classes_(dynamic_.size() == 2 && dynamic_[0] != dynamic_[1]),
      rows_(samples(mask.height, logits.height)),
      columns_(samples(mask.width, logits.width)),
      blended_((two_classes_ ? 1 : dynamic_.size()) * static_cast<std::size_t>(logits.width)),
      winners_(static_cast<std::size_t>(logits.width)),
      best_(static_cast<std::size_t>(logits.width)) {
  for (int cell = 0; cell <= logits.width; ++cell) {
    const auto first = std::find_if(columns_.begin(), columns_.end(),
                                    [&](const Sample& sample) { return sample.first >= cell; });
    cell_begin_.push_back(static_cast<std::size_t>(first - columns_.begin()));
  }
}

std::vector<ClassMap::Sample> ClassMap::samples(int count, int of) {
  std::vector<Sample> result;
  const double step = static_cast<double>(of) / count;
  for (int i = 0; i < count; ++i) {
    const double position = std::clamp((i + 0.5) * step - 0.5, 0.0, of - 1.0);
    const int first = static_cast<int>(position);
    result.push_back({first, std::min(first + 1, of - 1), static_cast<float>(position - first)});
  }
  return result;
}

void ClassMap::blend_row(const Logits& logits, const Sample& sample) {
  const auto width = static_cast<std::size_t>(logits_size_.width);
  const auto plane = width * static_cast<std::size_t>(logits_size_.height);
  const auto upper = static_cast<std::size_t>(sample.first) * width,
             lower = static_cast<std::size_t>(sample.second) * width;
  const float weight = sample.weight;
  if (two_classes_) {
    const float* one = logits.planes.data() + (dynamic_[0] ? 0 : plane);
    const float* other = logits.planes.data() + (dynamic_[0] ? plane : 0);
    for (std::size_t x = 0; x < width; ++x) {
      blended_[x] =
          (1 - weight) * (one[upper + x] - other[upper + x]) + weight * (one[lower + x] - other[lower + x]);
      winners_[x] = two_class_winner(blended_[x]);
    }
    return;
  }
  std::fill(winners_.begin(), winners_.end(), 0);
  for (std::size_t k = 0; k < dynamic_.size(); ++k) {
    const float* data = logits.planes.data() + k * plane;
    float* row = &blended_[k * width];
    for (std::size_t x = 0; x < width; ++x) {
      row[x] = (1 - weight) * data[upper + x] + weight * data[lower + x];
      const bool wins = k == 0 || row[x] > best_[x];
      best_[x] = wins ? row[x] : best_[x];
      winners_[x] = wins ? k : winners_[x];
    }
  }
}

/// Of the difference of the dynamic and the other class. A tie is won by the class that is named first.
std::size_t ClassMap::two_class_winner(float difference) const {
  const bool is_dynamic = difference > 0 || (dynamic_[0] && difference == 0);
  return is_dynamic == dynamic_[0] ? 0 : 1;
}

std::size_t ClassMap::class_at(const Sample& sample) const {
  const auto first = static_cast<std::size_t>(sample.first), second = static_cast<std::size_t>(sample.second);
  const auto value = [&](std::size_t row) {
    const float* data = &blended_[row * static_cast<std::size_t>(logits_size_.width)];
    return (1 - sample.weight) * data[first] + sample.weight * data[second];
  };
  if (two_classes_) return two_class_winner(value(0));
  std::size_t best = 0;
  float best_logit = value(0);
  for (std::size_t k = 1; k < dynamic_.size(); ++k) {
    const float other = value(k);
    if (other > best_logit) best = k, best_logit = other;
  }
  return best;
}

void ClassMap::paint_row(const std::vector<std::uint8_t>& value_of_class, std::uint8_t* row) const {
  const std::size_t last = winners_.size() - 1;
  for (std::size_t cell = 0; cell <= last;) {
    const std::size_t begin = cell_begin_[cell];
    if (winners_[cell] != winners_[std::min(cell + 1, last)]) {
      for (std::size_t x = begin; x < cell_begin_[cell + 1]; ++x)
        row[x] = value_of_class[class_at(columns_[x])];
      ++cell;
      continue;
    }
    const std::uint8_t value = value_of_class[winners_[cell]];
    do {
      ++cell;
    } while (cell <= last && winners_[cell] == winners_[cell - 1] &&
             winners_[cell] == winners_[std::min(cell + 1, last)]);
    std::memset(row + begin, value, cell_begin_[cell] - begin);
  }
}

cv::Mat ClassMap::paint(const Logits& logits, const std::vector<std::uint8_t>& value_of_class) {
  cv::Mat map(size_, CV_8UC1);
  for (int y = 0; y < size_.height; ++y) {
    blend_row(logits, rows_[static_cast<std::size_t>(y)]);
    paint_row(value_of_class, map.ptr(y));
  }
  return map;
}

cv::Mat ClassMap::draw(const Logits& logits) {
  std::vector<std::uint8_t> values;
  for (const bool is_dynamic : dynamic_) values.push_back(is_dynamic ? kDynamic : 0);
  return paint(logits, values);
}

cv::Mat ClassMap::draw_classes(const Logits& logits) {
  std::vector<std::uint8_t> numbers;
  for (std::size_t k = 0; k < dynamic_.size(); ++k) numbers.push_back(static_cast<std::uint8_t>(k));
  return paint(logits, numbers);
}

}  // namespace stdc
