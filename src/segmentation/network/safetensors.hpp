#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace stdc {

/// One entry of a safetensors file.
struct TensorEntry {
  std::string type;  ///< "F32", "F16", "I64", ... as written in the file
  std::vector<std::int64_t> shape;
  std::uint64_t begin = 0, end = 0;  ///< bytes within the data
};

/// A file of named tensors: the format of huggingface/safetensors. An 8-byte length, a JSON header, the data.
/// The header is read and checked whole, the data of a tensor only when it is asked for.
class SafetensorsFile {
 public:
  /// Throws Error naming the file if it is missing, truncated, has a damaged header, or tensors that overlap,
  /// leave gaps, reach beyond the end or have the wrong length for their shape.
  explicit SafetensorsFile(const std::filesystem::path& path);
  /// Reads from a stream of `size` bytes; `name` is for messages.
  SafetensorsFile(std::unique_ptr<std::istream> stream, std::uint64_t size, std::string name);
  ~SafetensorsFile();
  SafetensorsFile(SafetensorsFile&&) noexcept;

  const std::string& name() const { return name_; }
  /// In the order of their names.
  const std::map<std::string, TensorEntry>& tensors() const { return tensors_; }
  /// The texts of "__metadata__".
  const std::map<std::string, std::string>& metadata() const { return metadata_; }

  /// The numbers of a tensor of type F32 or F16. Throws Error naming file and tensor if there is no such
  /// tensor, it is of another type, cannot be read, or holds NaN or infinity.
  std::vector<float> floats(const std::string& tensor) const;

 private:
  void read_header(std::uint64_t size);

  std::string name_;
  std::unique_ptr<std::istream> stream_;
  std::uint64_t data_begin_ = 0;
  std::map<std::string, TensorEntry> tensors_;
  std::map<std::string, std::string> metadata_;
};

}  // namespace stdc
