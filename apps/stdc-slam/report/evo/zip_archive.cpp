#include "report/evo/zip_archive.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <memory>
#include <optional>

#include "core/error.hpp"

namespace stdc::app {
namespace {

constexpr std::uint32_t kLocal = 0x04034b50, kCentral = 0x02014b50, kEnd = 0x06054b50;
constexpr std::uint32_t kFirstDay = 0x00210000;  // 1980-01-01, 00:00: the earliest that the format has
constexpr std::size_t kLocalBytes = 30, kCentralBytes = 46, kEndBytes = 22;

void put16(std::string& to, std::uint32_t value) {
  to.push_back(static_cast<char>(value & 0xffU));
  to.push_back(static_cast<char>((value >> 8U) & 0xffU));
}
void put32(std::string& to, std::uint32_t value) {
  put16(to, value & 0xffffU);
  put16(to, value >> 16U);
}

/// What both heads of a file have in common: version, flags, method, time, checksum, sizes, lengths of names.
void put_head(std::string& to, const std::string& name, const std::string& content) {
  put16(to, 20);  // version 2.0
  put16(to, 0);
  put16(to, 0);  // stored
  put32(to, kFirstDay);
  put32(to, libdeflate_crc32(0, content.data(), content.size()));
  put32(to, static_cast<std::uint32_t>(content.size()));
  put32(to, static_cast<std::uint32_t>(content.size()));
  put16(to, static_cast<std::uint32_t>(name.size()));
  put16(to, 0);
}

/// Reads little-endian numbers; nothing beyond the end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : bytes_(bytes) {}
  std::optional<std::uint32_t> number(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes_[at + i])) << (8 * i);
    }
    return value;
  }
  std::optional<std::string_view> part(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return std::nullopt;
    return bytes_.substr(at, count);
  }
  std::size_t size() const { return bytes_.size(); }

 private:
  std::string_view bytes_;
};

[[noreturn]] void refuse_archive(const std::string& where, const std::string& problem) {
  throw Error(where, problem, "write it again");
}

/// Where the end record is: the last one, before a comment.
std::size_t find_end(const Bytes& bytes, const std::string& where) {
  constexpr std::size_t kMaxComment = 65535;
  for (std::size_t back = kEndBytes; back <= bytes.size() && back <= kEndBytes + kMaxComment; ++back) {
    if (bytes.number(bytes.size() - back, 4) == kEnd) return bytes.size() - back;
  }
  refuse_archive(where, "is no ZIP archive");
}

std::string unpack(std::string_view packed, std::uint32_t method, std::size_t size,
                   const std::string& where) {
  if (method == 0) {
    if (packed.size() != size) refuse_archive(where, "is a damaged ZIP archive");
    return std::string(packed);
  }
  constexpr std::uint32_t kDeflated = 8;
  if (method != kDeflated)
    refuse_archive(where, fmt::format("is packed by method {}, which is not known", method));
  const std::unique_ptr<libdeflate_decompressor, void (*)(libdeflate_decompressor*)> unpacker(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  std::string content(size, '\0');
  const libdeflate_result result = libdeflate_deflate_decompress(unpacker.get(), packed.data(), packed.size(),
                                                                 content.data(), size, nullptr);
  if (result != LIBDEFLATE_SUCCESS) refuse_archive(where, "is a damaged ZIP archive");
  return content;
}

}  // namespace

std::string make_zip(const std::vector<std::pair<std::string, std::string>>& files) {
  std::string archive, directory;
  for (const auto& [name, content] : files) {
    put32(directory, kCentral);
    put16(directory, 20);
    put_head(directory, name, content);
    put16(directory, 0);  // comment, disk, attributes
    put16(directory, 0);
    put16(directory, 0);
    put32(directory, 0);
    put32(directory, static_cast<std::uint32_t>(archive.size()));
    directory += name;
    put32(archive, kLocal);
    put_head(archive, name, content);
    archive.append(name).append(content);
  }
  const auto start = static_cast<std::uint32_t>(archive.size());
  archive += directory;
  put32(archive, kEnd);
  put32(archive, 0);  // disks
  put16(archive, static_cast<std::uint32_t>(files.size()));
  put16(archive, static_cast<std::uint32_t>(files.size()));
  put32(archive, static_cast<std::uint32_t>(directory.size()));
  put32(archive, start);
  put16(archive, 0);
  return archive;
}

std::map<std::string, std::string> read_zip(std::string_view text, const std::string& where,
                                            std::size_t max_bytes) {
  const Bytes bytes(text);
  const std::size_t end = find_end(bytes, where);
  std::size_t at = *bytes.number(end + 16, 4), total = 0;
  std::map<std::string, std::string> files;
  for (std::uint32_t left = *bytes.number(end + 10, 2); left > 0; --left) {
    const auto name = bytes.part(at + kCentralBytes, bytes.number(at + 28, 2).value_or(0));
    const auto local = bytes.number(at + 42, 4);
    if (bytes.number(at, 4) != kCentral || !name || !local || bytes.number(*local, 4) != kLocal) {
      refuse_archive(where, "is a damaged ZIP archive");
    }
    const std::size_t packed_size = *bytes.number(at + 20, 4), size = *bytes.number(at + 24, 4);
    total += size;
    if (total > max_bytes) refuse_archive(where, "is too large");
    const std::size_t data = *local + kLocalBytes + bytes.number(*local + 26, 2).value_or(0) +
                             bytes.number(*local + 28, 2).value_or(0);
    const auto packed = bytes.part(data, packed_size);
    if (!packed) refuse_archive(where, "is a damaged ZIP archive");
    std::string content = unpack(*packed, *bytes.number(at + 10, 2), size, where);
    if (libdeflate_crc32(0, content.data(), content.size()) != *bytes.number(at + 16, 4)) {
      refuse_archive(where, "is a damaged ZIP archive");
    }
    files[std::string(*name)] = std::move(content);
    at += kCentralBytes + name->size() + bytes.number(at + 30, 2).value_or(0) +
          bytes.number(at + 32, 2).value_or(0);
  }
  return files;
}

}  // namespace stdc::app
