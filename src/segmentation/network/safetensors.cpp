#include "segmentation/network/safetensors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <type_traits>

#include "core/error.hpp"
#include "segmentation/network/kernels/weight_kernels.hpp"
#include "segmentation/network/safetensors_checksum.hpp"

static_assert(std::endian::native == std::endian::little, "safetensors files are little-endian");

namespace stdc {
namespace {

using nlohmann::json;

constexpr std::uint64_t kLengthBytes = 8;
constexpr std::uint64_t kMaxHeader = 16U << 20U;  // a network of 100 layers has 0.05 MB
constexpr std::size_t kMaxDimensions = 8, kDeepestHeader = 8;
constexpr const char* kHint = "copy or download the file again";

std::uint64_t bytes_of_type(const std::string& type) {
  for (const auto& [name, bytes] : {std::pair{"F64", 8},
                                    {"I64", 8},
                                    {"U64", 8},
                                    {"F32", 4},
                                    {"I32", 4},
                                    {"U32", 4},
                                    {"F16", 2},
                                    {"BF16", 2},
                                    {"I16", 2},
                                    {"U16", 2},
                                    {"I8", 1},
                                    {"U8", 1},
                                    {"BOOL", 1}}) {
    if (type == name) return static_cast<std::uint64_t>(bytes);
  }
  return 0;
}

std::optional<std::uint64_t> as_count(const json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  return std::nullopt;
}

/// Parses JSON that is at most kDeepestHeader deep and has no name twice in one object.
json parse_strictly(const std::string& text, const std::string& where) {
  std::vector<std::set<std::string>> names;
  std::string problem;
  const auto watch = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) names.emplace_back();
    if (event == json::parse_event_t::object_end && !names.empty()) names.pop_back();
    if (event == json::parse_event_t::key && !names.empty() &&
        !names.back().insert(value.get_ref<const std::string&>()).second) {
      problem = fmt::format("the header names '{}' twice", value.get_ref<const std::string&>().substr(0, 80));
    }
    return true;
  };
  std::size_t depth = 0, deepest = 0;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_text && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      in_text = !in_text;
    } else if (!in_text && (text[i] == '{' || text[i] == '[')) {
      deepest = std::max(deepest, ++depth);
    } else if (!in_text && (text[i] == '}' || text[i] == ']')) {
      depth -= depth > 0 ? 1 : 0;
    }
  }
  if (deepest > kDeepestHeader) throw Error(where, "the header is not that of a safetensors file", kHint);
  json header = json::parse(text, watch, false);
  if (header.is_discarded() || !header.is_object()) {
    throw Error(where, "the header is not a JSON object", kHint);
  }
  if (!problem.empty()) throw Error(where, problem, kHint);
  return header;
}

/// The entry of one tensor; every number is checked before it is used.
TensorEntry parse_entry(const std::string& where, const json& value) {
  if (!value.is_object() || !value.contains("dtype") || !value["dtype"].is_string() ||
      !value.contains("shape") || !value["shape"].is_array() || !value.contains("data_offsets") ||
      !value["data_offsets"].is_array() || value["data_offsets"].size() != 2 ||
      value["shape"].size() > kMaxDimensions) {
    throw Error(where, "its header entry lacks dtype, shape or data_offsets", kHint);
  }
  TensorEntry entry{value["dtype"].get<std::string>(), {}, 0, 0};
  const std::uint64_t element = bytes_of_type(entry.type);
  if (element == 0) throw Error(where, "its type is not known", "store it as F32 or F16");
  std::uint64_t bytes = element;
  for (const json& size : value["shape"]) {
    const auto count = as_count(size);
    if (!count || (*count != 0 && bytes > (std::uint64_t{1} << 40U) / *count)) {
      throw Error(where, "its shape is damaged", kHint);
    }
    bytes *= *count;
    entry.shape.push_back(static_cast<std::int64_t>(*count));
  }
  const auto begin = as_count(value["data_offsets"][0]), end = as_count(value["data_offsets"][1]);
  if (!begin || !end || *begin > *end) throw Error(where, "its place in the file is damaged", kHint);
  entry.begin = *begin, entry.end = *end;
  if (entry.end - entry.begin != bytes) {
    throw Error(where, fmt::format("takes {} bytes, but its shape {}", entry.end - entry.begin, bytes),
                kHint);
  }
  return entry;
}

/// The tensors must fill the data without gaps and overlaps.
void check_places(const std::string& name, const std::map<std::string, TensorEntry>& tensors,
                  std::uint64_t data_bytes) {
  std::vector<std::pair<const TensorEntry*, const std::string*>> ordered;
  for (const auto& [tensor, entry] : tensors) ordered.emplace_back(&entry, &tensor);
  std::stable_sort(ordered.begin(), ordered.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first->begin, a.first->end) < std::pair(b.first->begin, b.first->end);
  });
  std::uint64_t filled = 0;
  for (const auto& [entry, tensor] : ordered) {
    if (entry->begin != filled) {
      throw Error(fmt::format("{}: tensor '{}'", name, *tensor),
                  entry->begin < filled ? "overlaps another tensor" : "leaves a gap before it", kHint);
    }
    filled = entry->end;
  }
  if (filled > data_bytes) {
    throw Error(name, fmt::format("the file is truncated: {} bytes of data are missing", filled - data_bytes),
                kHint);
  }
  if (filled < data_bytes) {
    throw Error(name, fmt::format("{} bytes too many follow the tensors", data_bytes - filled), kHint);
  }
}

std::unique_ptr<std::istream> open(const std::filesystem::path& path) {
  std::error_code fault;
  if (std::filesystem::is_directory(path, fault)) {
    throw Error(path.string(), "is a folder", "give a .safetensors file");
  }
  auto file = std::make_unique<std::ifstream>(path, std::ios::binary);
  if (!*file) throw Error(path.string(), "cannot be opened", "give the path of a readable .safetensors file");
  return file;
}

std::uint64_t size_of(std::istream& stream) {
  stream.seekg(0, std::ios::end);
  const auto size = stream.tellg();
  stream.clear();
  stream.seekg(0);
  return size < 0 ? 0 : static_cast<std::uint64_t>(size);
}

/// Appends `count` numbers of the type `Stored` to `values`, piece by piece: while a piece is in the cache,
/// it is converted and checked.
/// @returns nothing if the stream ends; else whether all are finite
template <typename Stored>
std::optional<bool> read_numbers(std::istream& stream, std::size_t count, std::vector<float>& values) {
  constexpr std::size_t kPiece = std::size_t{1} << 13U;
  std::vector<Stored> stored(std::min(count, kPiece));
  std::vector<float> piece(stored.size());
  values.reserve(count);
  bool finite = true;
  while (values.size() < count) {
    const std::size_t size = std::min(stored.size(), count - values.size());
    if (!stream.read(reinterpret_cast<char*>(stored.data()),
                     static_cast<std::streamsize>(size * sizeof(Stored))))
      return std::nullopt;
    if constexpr (std::is_same_v<Stored, float>) {
      std::swap(stored, piece);
    } else {
      widen_halves({stored.data(), size}, {piece.data(), size});
    }
    finite = finite && all_finite({piece.data(), size});
    values.insert(values.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(size));
  }
  return finite;
}

}  // namespace

SafetensorsFile::SafetensorsFile(const std::filesystem::path& path)
    : name_(path.string()), stream_(open(path)) {
  read_header(size_of(*stream_));
}

SafetensorsFile::SafetensorsFile(std::unique_ptr<std::istream> stream, std::uint64_t size, std::string name)
    : name_(std::move(name)), stream_(std::move(stream)) {
  read_header(size);
}

SafetensorsFile::~SafetensorsFile() = default;
SafetensorsFile::SafetensorsFile(SafetensorsFile&&) noexcept = default;

void SafetensorsFile::read_header(std::uint64_t size) {
  std::uint64_t length = 0;
  if (size < kLengthBytes || !stream_->read(reinterpret_cast<char*>(&length), kLengthBytes)) {
    throw Error(name_, "is too short for a safetensors file", kHint);
  }
  if (length > kMaxHeader) throw Error(name_, "is not a safetensors file (its header is too long)", kHint);
  if (length > size - kLengthBytes) throw Error(name_, "the file is truncated within its header", kHint);
  std::string text(length, '\0');
  if (!stream_->read(text.data(), static_cast<std::streamsize>(length))) {
    throw Error(name_, "its header cannot be read", kHint);
  }
  data_begin_ = kLengthBytes + length;
  const json header = parse_strictly(text, name_);
  for (const auto& [tensor, value] : header.items()) {
    const std::string where = fmt::format("{}: tensor '{}'", name_, tensor.substr(0, 80));
    if (tensor != "__metadata__") {
      tensors_.emplace(tensor, parse_entry(where, value));
      continue;
    }
    if (!value.is_object()) throw Error(name_, "its metadata are not an object", kHint);
    for (const auto& [key, entry] : value.items()) {
      if (!entry.is_string()) throw Error(name_, "its metadata are not all texts", kHint);
      metadata_.emplace(key, entry.get<std::string>());
    }
  }
  check_places(name_, tensors_, size - data_begin_);
  if (!check_safetensors_checksum(*stream_, text, name_) && metadata_.count("crc32") > 0) {
    throw Error(name_, "is damaged (its checksum is not as the training package writes it)", kHint);
  }
}

std::vector<float> SafetensorsFile::floats(const std::string& tensor) const {
  const auto found = tensors_.find(tensor);
  if (found == tensors_.end()) {
    throw Error(name_, fmt::format("has no tensor '{}'", tensor), "give the weights of this network");
  }
  const std::string where = fmt::format("{}: tensor '{}'", name_, tensor);
  const TensorEntry& entry = found->second;
  const bool half = entry.type == "F16";
  if (!half && entry.type != "F32") throw Error(where, "is of type " + entry.type, "store it as F32 or F16");
  const std::uint64_t bytes = entry.end - entry.begin;
  stream_->clear();
  stream_->seekg(static_cast<std::streamoff>(data_begin_ + entry.begin));
  std::vector<float> values;
  const auto finite = half ? read_numbers<std::uint16_t>(*stream_, bytes / 2, values)
                           : read_numbers<float>(*stream_, bytes / 4, values);
  if (!finite) throw Error(where, "cannot be read", kHint);
  if (!*finite) {
    throw Error(where, "holds NaN or infinity", "export the weights again from a network that has converged");
  }
  return values;
}

}  // namespace stdc
