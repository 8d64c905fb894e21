// replay LAST FOLDER...: gives one fuzz target each file of the folders, and simple mutations of each, the
// same ones each time. It keeps the targets alive where there is no libFuzzer; finding things is for
// scripts/fuzz. An input that ends the program is left in the file LAST.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "core/random.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Input = std::vector<std::uint8_t>;

constexpr int kMutationsPerFile = 200;

/// In the order of their paths; a folder need not be there.
std::vector<Input> read_inputs(const std::vector<std::filesystem::path>& folders) {
  std::vector<Input> inputs;
  for (const auto& folder : folders) {
    if (!std::filesystem::is_directory(folder)) continue;
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    for (const auto& path : paths) {
      std::ifstream file(path, std::ios::binary);
      inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
    }
  }
  return inputs;
}

class Mutator {
 public:
  explicit Mutator(std::uint64_t seed) : random_(seed) {}

  /// A few changes, each of bytes changed, cut out, inserted or repeated.
  Input mutated(Input input) {
    const int changes = 1 + below(4);
    for (int i = 0; i < changes; ++i) {
      switch (below(6)) {
        case 0:
          flip_bit(input);
          break;
        case 1:
          put_telling_bytes(input);
          break;
        case 2:
          cut_out(input);
          break;
        case 3:
          input.resize(static_cast<std::size_t>(below(size_of(input) + 1)));
          break;
        case 4:
          insert(input);
          break;
        default:
          repeat(input);
          break;
      }
    }
    return input;
  }

 private:
  static int size_of(const Input& input) { return static_cast<int>(input.size()); }
  int below(int n) { return static_cast<int>(random_.below(static_cast<std::uint32_t>(n))); }
  /// Where the change begins, and how many of the bytes from there on it is about: mostly few.
  std::pair<int, int> range(const Input& input) {
    const int first = below(size_of(input) + 1);
    return {first, below(std::min(size_of(input) - first, below(4) == 0 ? 256 : 8) + 1)};
  }

  void flip_bit(Input& input) {
    if (input.empty()) return;
    std::uint8_t& byte = input[static_cast<std::size_t>(below(size_of(input)))];
    byte = static_cast<std::uint8_t>(byte ^ 1U << random_.below(8));
  }
  /// All ones, all zeros, the maximum and the minimum: what sizes and offsets stumble over.
  void put_telling_bytes(Input& input) {
    const auto [first, count] = range(input);
    const std::uint8_t body = below(2) == 0 ? 0x00 : 0xFF;
    std::fill_n(input.begin() + first, count, body);
    const int last = first + count - 1;
    if (count > 0 && below(2) == 0) input[static_cast<std::size_t>(last)] ^= 0x80U;
  }
  void cut_out(Input& input) {
    const auto [first, count] = range(input);
    input.erase(input.begin() + first, input.begin() + first + count);
  }
  /// Anything, or what means something in text.
  void insert(Input& input) {
    static constexpr char kTelling[] = "0123456789.-+eE:,;#\"'{}[]()&*!|>%@ \t\r\n=/\\nainf";
    const bool text = below(2) == 0;
    Input bytes(static_cast<std::size_t>(1 + below(8)));
    for (std::uint8_t& byte : bytes) {
      byte = static_cast<std::uint8_t>(text ? kTelling[below(sizeof kTelling - 1)] : below(256));
    }
    input.insert(input.begin() + below(size_of(input) + 1), bytes.begin(), bytes.end());
  }
  void repeat(Input& input) {
    const auto [first, count] = range(input);
    const Input bytes(input.begin() + first, input.begin() + first + count);
    input.insert(input.begin() + below(size_of(input) + 1), bytes.begin(), bytes.end());
  }

  stdc::Random random_;
};

/// A copy of its own size, so that AddressSanitizer sees what is read behind its end.
void run(const Input& input, const std::filesystem::path& last) {
  std::ofstream(last, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  const Input copy(input.begin(), input.end());
  LLVMFuzzerTestOneInput(copy.data(), copy.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: replay LAST FOLDER...\n");
    return 2;
  }
  const std::filesystem::path last = argv[1];
  const std::vector<Input> inputs = read_inputs({argv + 2, argv + argc});
  if (inputs.empty()) {
    std::fprintf(stderr, "replay: there is no input in the folders\n");
    return 2;
  }
  try {
    run({}, last);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      run(inputs[i], last);
      Mutator mutator(i);
      for (int k = 0; k < kMutationsPerFile; ++k) run(mutator.mutated(inputs[i]), last);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "replay: the input kept in %s: %s\n", argv[1], error.what());
    return 1;
  }
  std::filesystem::remove(last);
  std::printf("%zu inputs, %d mutations of each\n", inputs.size(), kMutationsPerFile);
  return 0;
}
