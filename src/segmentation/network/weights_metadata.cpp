#include "segmentation/network/weights_metadata.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace stdc {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxClasses = 1000;
constexpr const char* kWeightsHint = "give weights written by the training package of this project";

/// The entries of "__metadata__", with messages that name them.
class Metadata {
 public:
  explicit Metadata(const SafetensorsFile& file) : file_(file) {}

  std::string text(const std::string& key) const {
    const auto found = file_.metadata().find(key);
    if (found == file_.metadata().end())
      throw Error(file_.name(), fmt::format("has no '{}'", key), kWeightsHint);
    return found->second;
  }
  std::string text_or_nothing(const std::string& key) const {
    const auto found = file_.metadata().find(key);
    return found == file_.metadata().end() ? "" : found->second;
  }
  bool has(const std::string& key) const { return file_.metadata().count(key) > 0; }
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const {
    throw Error(fmt::format("{}: '{}'", file_.name(), key), problem, kWeightsHint);
  }

  int whole_number(const std::string& key) const {
    const std::string word = text(key);
    int value = 0;
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || end != word.data() + word.size()) refuse(key, "is not a whole number");
    return value;
  }
  json parsed(const std::string& key) const {
    const std::string words = text(key);
    constexpr std::size_t kMax = 1U << 20U;
    // Lists and objects of this file are two deep; the parser would follow any depth.
    const bool deep =
        std::count(words.begin(), words.end(), '[') + std::count(words.begin(), words.end(), '{') > 2000;
    json value =
        words.size() > kMax || deep ? json(json::value_t::discarded) : json::parse(words, nullptr, false);
    if (value.is_discarded()) refuse(key, "is not JSON");
    return value;
  }
  std::vector<std::string> names(const std::string& key) const {
    const json list = parsed(key);
    std::vector<std::string> result;
    if (!list.is_array() || list.size() > kMaxClasses) refuse(key, "is not a list of names");
    for (const json& name : list) {
      if (!name.is_string() || name.get<std::string>().empty()) refuse(key, "is not a list of names");
      result.push_back(name.get<std::string>());
    }
    return result;
  }
  std::array<float, 3> triple(const std::string& key) const {
    const json list = parsed(key);
    if (!list.is_array() || list.size() != 3) refuse(key, "is not a list of three numbers");
    std::array<float, 3> result{};
    for (std::size_t i = 0; i < 3; ++i) {
      if (!list[i].is_number()) refuse(key, "is not a list of three numbers");
      result[i] = list[i].get<float>();
    }
    return result;
  }

 private:
  const SafetensorsFile& file_;
};

void read_classes(const Metadata& metadata, NetworkWeights& network) {
  network.classes = metadata.names("classes");
  if (network.classes.size() < 2) metadata.refuse("classes", "has fewer than two classes");
  for (const std::string& name : metadata.names("dynamic_classes")) {
    if (std::find(network.classes.begin(), network.classes.end(), name) == network.classes.end())
      metadata.refuse("dynamic_classes", fmt::format("'{}' is not among the classes", name.substr(0, 80)));
  }
  network.choose_dynamic(metadata.names("dynamic_classes"));
}

/// Optional; by default the logits' own probabilities.
void read_probability(const Metadata& metadata, NetworkWeights& network) {
  constexpr float kMinScale = 1e-3F, kMaxScale = 1e3F, kMaxOffset = 1e3F;
  if (!metadata.has("probability")) return;
  const json pair = metadata.parsed("probability");
  if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number())
    metadata.refuse("probability", "is not a list of scale and offset");
  const ProbabilityCalibration read{pair[0].get<float>(), pair[1].get<float>()};
  if (!(read.scale >= kMinScale && read.scale <= kMaxScale && std::abs(read.offset) <= kMaxOffset))
    metadata.refuse("probability", "is damaged");
  network.probability = read;
}

void read_normalisation(const Metadata& metadata, NetworkWeights& network) {
  network.mean = metadata.triple("mean");
  network.deviation = metadata.triple("std");
  for (const float mean : network.mean) {
    if (!(mean >= 0 && mean <= 1)) metadata.refuse("mean", "is outside 0..1");
  }
  constexpr float kMin = 0.01F, kMax = 10;
  for (const float deviation : network.deviation) {
    if (!(deviation >= kMin && deviation <= kMax)) metadata.refuse("std", "is outside 0.01..10");
  }
}

ActivationRanges read_ranges(const Metadata& metadata) {
  ActivationRanges ranges;
  const std::string key = "activation_ranges";
  if (!metadata.has(key)) return ranges;
  const json object = metadata.parsed(key);
  if (!object.is_object()) metadata.refuse(key, "is not an object");
  for (const auto& [name, pair] : object.items()) {
    if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
      metadata.refuse(key, "does not give two numbers per layer");
    }
    const ActivationRange range{pair[0].get<float>(), pair[1].get<float>()};
    constexpr float kMax = 1e6F;
    if (!(range.low >= -kMax && range.low <= range.high && range.high <= kMax)) {
      metadata.refuse(key, fmt::format("the range of '{}' is damaged", name.substr(0, 80)));
    }
    ranges[name] = range;
  }
  return ranges;
}

/// Files of stdc-weights-1 may lack a checksum; those of stdc-weights-2 must have it, else a damaged name of
/// its entry would pass for a file without one.
void check_format(const Metadata& metadata, const SafetensorsFile& file) {
  const std::string format = metadata.text("format");
  if (format != "stdc-weights-1" && format != "stdc-weights-2") {
    metadata.refuse("format", "is neither stdc-weights-1 nor stdc-weights-2, which this version reads");
  }
  if (format == "stdc-weights-2" && !metadata.has("crc32")) {
    throw Error(file.name(), "is damaged (it has lost its checksum)", "copy or download the file again");
  }
}

}  // namespace

ActivationRanges read_metadata(const SafetensorsFile& file, NetworkWeights& network) {
  const Metadata metadata(file);
  check_format(metadata, file);
  network.file = file.name();
  network.architecture = metadata.text("architecture");
  if (network.architecture != "STDC1-Seg" && network.architecture != "STDC2-Seg") {
    metadata.refuse("architecture", "is neither STDC1-Seg nor STDC2-Seg");
  }
  network.input_size = {metadata.whole_number("input_width"), metadata.whole_number("input_height")};
  check_input_size(network.input_size, fmt::format("{}: 'input_width' x 'input_height'", file.name()));
  network.has_checksum = metadata.has("crc32");
  network.licence = metadata.text("licence");
  network.version = metadata.text_or_nothing("version");
  network.trained = metadata.text_or_nothing("trained");
  network.scores = metadata.text_or_nothing("scores");
  read_classes(metadata, network);
  read_normalisation(metadata, network);
  read_probability(metadata, network);
  return read_ranges(metadata);
}

}  // namespace stdc
