#include "atlas/storage/record_stream.hpp"

#include <fmt/format.h>
#include <libdeflate.h>

#include <algorithm>
#include <bit>
#include <istream>
#include <ostream>

namespace stdc {

static_assert(std::endian::native == std::endian::little, "map files are little-endian");

namespace {

constexpr std::size_t kTag = 4;
constexpr std::uint64_t kMaxRecord = std::uint64_t{1} << 28U;
struct Head {
  std::uint32_t sum = 0;
  std::uint64_t size = 0;
};

}  // namespace

std::uint32_t check_sum(const void* data, std::size_t size) { return libdeflate_crc32(0, data, size); }

void RecordWriter::finish(std::ostream& stream, std::string_view tag) {
  const std::uint32_t sum = check_sum(bytes_.data(), bytes_.size());
  const std::uint64_t size = bytes_.size();
  stream.write(tag.data(), kTag);
  stream.write(reinterpret_cast<const char*>(&sum), sizeof(sum));
  stream.write(reinterpret_cast<const char*>(&size), sizeof(size));
  stream.write(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
  bytes_.clear();
}

void RecordReader::fail(const char* problem) const {
  throw Error(name_, fmt::format("is damaged ({})", problem), "use a copy of it, or make the map again");
}

bool RecordReader::read_plain(void* data, std::size_t size) {
  return static_cast<bool>(stream_.read(static_cast<char*>(data), static_cast<std::streamsize>(size)));
}

void RecordReader::next() {
  Head head;
  tag_.resize(kTag);
  check(read_plain(tag_.data(), kTag) && read_plain(&head.sum, sizeof(head.sum)) &&
            read_plain(&head.size, sizeof(head.size)),
        "it ends too early");
  check(head.size <= kMaxRecord, "a record is too long");
  size_ = used_ = 0;
  // Piece by piece, so that a wrong length does not ask for memory that the file does not fill.
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  while (size_ < head.size) {
    const std::size_t piece = std::min<std::size_t>(kPiece, head.size - size_);
    if (bytes_.size() < size_ + piece) bytes_.resize(size_ + piece);
    check(read_plain(bytes_.data() + size_, piece), "it ends too early");
    size_ += piece;
  }
  check(check_sum(bytes_.data(), size_) == head.sum, "a check sum is wrong");
}

std::size_t RecordReader::get_count(std::size_t bytes_each) {
  const auto count = get<std::uint32_t>();
  check(count <= (size_ - used_) / bytes_each, "a record is too short");
  return count;
}

void RecordReader::expect_end() const { check(used_ == size_, "a record is too long"); }

}  // namespace stdc
