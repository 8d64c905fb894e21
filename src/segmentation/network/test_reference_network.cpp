#include "segmentation/network/test_reference_network.hpp"

#include <cmath>

namespace stdc::test {

double relu(double value) { return value > 0 ? value : 0; }

double logistic(double value) { return 1 / (1 + std::exp(-value)); }

double same(double value) { return value; }

Planes ReferenceNetwork::run(const Planes& image) const {
  Planes x = convolve(net_.stage2, convolve(net_.stage1, image));
  std::vector<Planes> stages;
  for (const auto& modules : net_.stages) {
    for (const ModuleWeights& module : modules) x = apply(module, x);
    stages.push_back(x);
  }
  const Planes pooled = convolve(net_.context_pool, average(stages[2]));
  const Planes context5 = sum(refine(net_.refinement5, stages[2]), pooled);
  const Planes head5 = convolve(net_.head5, twice(context5));
  const Planes context4 = sum(refine(net_.refinement4, stages[1]), head5);
  const Planes head4 = convolve(net_.head4, twice(context4));
  const Planes fused = convolve(net_.fusion, join({stages[0], head4}));
  const Planes attention = convolve(net_.excite, convolve(net_.squeeze, average(fused)), logistic);
  return convolve(net_.classify, convolve(net_.head, sum(fused, scaled(fused, attention))), same);
}

Planes ReferenceNetwork::convolve(const ConvolutionWeights& layer, const Planes& in, double (*then)(double)) {
  const int k = layer.kernel, pad = k / 2;
  Planes out(layer.outputs, (in.height - 1) / layer.stride + 1, (in.width - 1) / layer.stride + 1);
  for (int o = 0; o < out.channels; ++o) {
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        double total = layer.bias[static_cast<std::size_t>(o)];
        for (int i = 0; i < in.channels; ++i) {
          for (int tap = 0; tap < k * k; ++tap) {
            const int v = y * layer.stride + tap / k - pad, u = x * layer.stride + tap % k - pad;
            if (v < 0 || u < 0 || v >= in.height || u >= in.width) continue;
            const int weight = (o * in.channels + i) * k * k + tap;
            total += layer.weights[static_cast<std::size_t>(weight)] * in.at(i, v, u);
          }
        }
        out.at(o, y, x) = then(total);
      }
    }
  }
  return out;
}

Planes ReferenceNetwork::pool(const Planes& in) {
  constexpr double kTaps = 9;
  Planes out(in.channels, in.height / 2, in.width / 2);
  for (int c = 0; c < out.channels; ++c) {
    for (int y = 0; y < in.height; ++y) {
      for (int x = 0; x < in.width; ++x) {
        for (int v = y / 2; v <= (y + 1) / 2 && v < out.height; ++v) {
          for (int u = x / 2; u <= (x + 1) / 2 && u < out.width; ++u)
            out.at(c, v, u) += in.at(c, y, x) / kTaps;
        }
      }
    }
  }
  return out;
}

Planes ReferenceNetwork::average(const Planes& in) {
  Planes out(in.channels, 1, 1);
  for (int c = 0; c < in.channels; ++c) {
    for (int y = 0; y < in.height; ++y) {
      for (int x = 0; x < in.width; ++x) out.at(c, 0, 0) += in.at(c, y, x) / (in.height * in.width);
    }
  }
  return out;
}

Planes ReferenceNetwork::join(const std::vector<Planes>& parts) {
  Planes out(0, parts[0].height, parts[0].width);
  for (const Planes& part : parts) {
    out.channels += part.channels;
    out.values.insert(out.values.end(), part.values.begin(), part.values.end());
  }
  return out;
}

Planes ReferenceNetwork::twice(const Planes& in) {
  Planes out(in.channels, 2 * in.height, 2 * in.width);
  for (int c = 0; c < out.channels; ++c) {
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) out.at(c, y, x) = in.at(c, y / 2, x / 2);
    }
  }
  return out;
}

Planes ReferenceNetwork::sum(const Planes& a, const Planes& b) {
  return combine(a, b, [](double p, double q) { return p + q; });
}

Planes ReferenceNetwork::scaled(const Planes& a, const Planes& b) {
  return combine(a, b, [](double p, double q) { return p * q; });
}

Planes ReferenceNetwork::refine(const AttentionRefinementWeights& layers, const Planes& in) {
  const Planes feature = convolve(layers.convolution, in);
  return scaled(feature, convolve(layers.attention, average(feature), logistic));
}

Planes ReferenceNetwork::apply(const ModuleWeights& module, const Planes& in) {
  const Planes first = convolve(module.blocks[0], in);
  std::vector<Planes> parts{module.stride() == 2 ? pool(first) : first};
  Planes x = first;
  for (std::size_t i = 1; i < 4; ++i) {
    x = convolve(module.blocks[i], x);
    parts.push_back(x);
  }
  return join(parts);
}

}  // namespace stdc::test
