#pragma once

#include <vector>

#include "segmentation/network/network_weights.hpp"

namespace stdc::test {

/// [channel][y][x]
struct Planes {
  int channels = 0, height = 0, width = 0;
  std::vector<double> values;

  Planes() = default;
  Planes(int c, int h, int w)
      : channels(c),
        height(h),
        width(w),
        values(static_cast<std::size_t>(c) * static_cast<std::size_t>(h) * static_cast<std::size_t>(w)) {}
  double& at(int c, int y, int x) {
    return values[(static_cast<std::size_t>(c) * static_cast<std::size_t>(height) +
                   static_cast<std::size_t>(y)) *
                      static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  double at(int c, int y, int x) const { return const_cast<Planes*>(this)->at(c, y, x); }
};

double relu(double value);
double logistic(double value);
double same(double value);

/// The network as its definition reads, in double precision: the truth for its tests.
class ReferenceNetwork {
 public:
  explicit ReferenceNetwork(const NetworkWeights& weights) : net_(weights) {}

  /// Logits of a normalised image.
  Planes run(const Planes& image) const;

  static Planes convolve(const ConvolutionWeights& layer, const Planes& in, double (*then)(double) = relu);
  /// 3x3, stride 2, padding 1; the padding counts.
  static Planes pool(const Planes& in);
  static Planes average(const Planes& in);
  static Planes join(const std::vector<Planes>& parts);
  static Planes twice(const Planes& in);

 private:
  /// b may have one pixel, which then counts for all.
  template <typename Operation>
  static Planes combine(const Planes& a, const Planes& b, Operation operation) {
    Planes out(a.channels, a.height, a.width);
    for (int c = 0; c < a.channels; ++c) {
      for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
          out.at(c, y, x) = operation(a.at(c, y, x), b.height == 1 ? b.at(c, 0, 0) : b.at(c, y, x));
        }
      }
    }
    return out;
  }
  static Planes sum(const Planes& a, const Planes& b);
  static Planes scaled(const Planes& a, const Planes& b);
  static Planes refine(const AttentionRefinementWeights& layers, const Planes& in);
  static Planes apply(const ModuleWeights& module, const Planes& in);

  const NetworkWeights& net_;
};

}  // namespace stdc::test
