#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/files/text_file.hpp"
#include "segmentation/network/onnx_segmenter.hpp"

namespace stdc {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& problem) {
  throw Error(file.string(), problem, "see the description of ONNX models in docs/segmentation.md");
}

int read_side(const std::filesystem::path& file, const json& description, const char* key, int otherwise) {
  if (!description.contains(key)) return otherwise;
  const json& value = description[key];
  constexpr int kMax = 8192;
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < 1 || value.get<std::uint64_t>() > kMax) {
    refuse(file, std::string(key) + " is not a number of pixels");
  }
  return value.get<int>();
}

void read_triple(const std::filesystem::path& file, const json& description, const char* key,
                 std::array<double, 3>& triple) {
  if (!description.contains(key)) return;
  const json& value = description[key];
  if (!value.is_array() || value.size() != 3 ||
      !std::all_of(value.begin(), value.end(), [](const json& number) { return number.is_number(); })) {
    refuse(file, std::string(key) + " is not a list of three numbers");
  }
  for (std::size_t i = 0; i < 3; ++i) triple[i] = value[i].get<double>();
}

}  // namespace

OnnxModel read_onnx_description(const std::filesystem::path& model) {
  OnnxModel result;
  std::filesystem::path file = model;
  file.replace_extension(".json");
  std::error_code fault;
  if (!std::filesystem::exists(file, fault)) return result;
  constexpr std::size_t kMaxBytes = 100000;
  const json description =
      json::parse(read_file(file, "remove it or make it readable", kMaxBytes), nullptr, false);
  if (!description.is_object()) refuse(file, "is not a JSON object");
  result.input_size.width = read_side(file, description, "input_width", result.input_size.width);
  result.input_size.height = read_side(file, description, "input_height", result.input_size.height);
  read_triple(file, description, "mean", result.mean);
  read_triple(file, description, "std", result.deviation);
  if (std::any_of(result.deviation.begin(), result.deviation.end(),
                  [](double value) { return !(value > 0); })) {
    refuse(file, "std is not positive");
  }
  if (description.contains("dynamic_classes")) {
    result.dynamic_classes.clear();
    const json& classes = description["dynamic_classes"];
    if (!classes.is_array()) refuse(file, "dynamic_classes is not a list");
    for (const json& number : classes) {
      constexpr std::uint64_t kMax = 10000;
      if (!number.is_number_unsigned() || number.get<std::uint64_t>() > kMax) {
        refuse(file, "dynamic_classes is not a list of channels");
      }
      result.dynamic_classes.push_back(number.get<int>());
    }
  }
  return result;
}

}  // namespace stdc
