#include "input/recordings/containers/decompression.hpp"

#include <bzlib.h>
#include <fmt/format.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>
#include <memory>
#include <span>

#include "core/files/text_file.hpp"

namespace stdc {
namespace {

/// Room for the next part of the result. False if it is full and may not grow.
class Output {
 public:
  Output(std::vector<std::uint8_t>& bytes, std::uint64_t limit) : bytes_(bytes), limit_(limit) {
    // One byte more than is to come tells a result that is too long from one that ends in time.
    bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(limit_ + 1, kFirst)));
  }
  ~Output() { bytes_.resize(std::min<std::size_t>(used_, static_cast<std::size_t>(limit_))); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Valid until the next call.
  std::span<std::uint8_t> room() {
    if (used_ == bytes_.size()) {
      bytes_.resize(static_cast<std::size_t>(std::min<std::uint64_t>(limit_ + 1, 4 * std::uint64_t{used_})));
    }
    return std::span(bytes_).subspan(used_);
  }
  void add(std::size_t count) { used_ += count; }
  std::size_t used() const { return used_; }
  bool too_long() const { return used_ > limit_; }

 private:
  static constexpr std::uint64_t kFirst = 4U << 20U;
  std::vector<std::uint8_t>& bytes_;
  std::uint64_t limit_;
  std::size_t used_ = 0;
};

std::string unpack_zstd(Bytes packed, Output& out) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  // A frame may ask for a window of its own; more than this is not what recorders write.
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, 27);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  std::size_t left = 1;
  while (in.pos < in.size || left > 0) {
    const std::span<std::uint8_t> room = out.room();
    ZSTD_outBuffer part{room.data(), room.size(), 0};
    const std::size_t before = in.pos;
    left = ZSTD_decompressStream(context.get(), &part, &in);
    out.add(part.pos);
    if (ZSTD_isError(left) != 0) return "its zstd data are damaged";
    if (out.too_long()) return "";
    if (left > 0 && part.pos == 0 && in.pos == before) return "its zstd data end too early";
  }
  return "";
}

std::string unpack_lz4(Bytes packed, Output& out) {
  LZ4F_dctx* made = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&made, LZ4F_VERSION)) != 0) return "there is no memory";
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      made, LZ4F_freeDecompressionContext);
  std::size_t left = 1;
  while (!packed.empty() || left > 0) {
    const std::span<std::uint8_t> room = out.room();
    std::size_t written = room.size(), read = packed.size();
    left = LZ4F_decompress(context.get(), room.data(), &written, packed.data(), &read, nullptr);
    if (LZ4F_isError(left) != 0) return "its lz4 data are damaged";
    out.add(written);
    packed = packed.subspan(read);
    if (out.too_long()) return "";
    if (left > 0 && written == 0 && read == 0) return "its lz4 data end too early";
  }
  return "";
}

std::string unpack_bz2(Bytes packed, Output& out) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return "there is no memory";
  const std::unique_ptr<bz_stream, decltype(&BZ2_bzDecompressEnd)> end(&stream, BZ2_bzDecompressEnd);
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed.data()));  // bzlib only reads
  stream.avail_in = static_cast<unsigned>(packed.size());
  for (;;) {
    const std::span<std::uint8_t> room = out.room();
    const unsigned before = stream.avail_in;
    stream.next_out = reinterpret_cast<char*>(room.data());
    stream.avail_out = static_cast<unsigned>(room.size());
    const int result = BZ2_bzDecompress(&stream);
    const std::size_t written = room.size() - stream.avail_out;
    out.add(written);
    if (result == BZ_STREAM_END || out.too_long()) return "";
    if (result != BZ_OK) return "its bz2 data are damaged";
    if (written == 0 && stream.avail_in == before) return "its bz2 data end too early";
  }
}

}  // namespace

std::string decompress(std::string_view method, Bytes packed, std::optional<std::uint64_t> size,
                       std::vector<std::uint8_t>& out) {
  if (size.value_or(0) > kMaxPiece || packed.size() > kMaxPiece) {
    out.clear();
    return fmt::format("it claims {} bytes, more than {} MB",
                       std::max<std::uint64_t>(size.value_or(0), packed.size()), kMaxPiece >> 20U);
  }
  std::string problem;
  if (method.empty() || method == "none") {
    out.assign(packed.begin(), packed.end());
  } else {
    Output output(out, size.value_or(kMaxPiece));
    if (method == "zstd") {
      problem = unpack_zstd(packed, output);
    } else if (method == "lz4") {
      problem = unpack_lz4(packed, output);
    } else if (method == "bz2") {
      problem = unpack_bz2(packed, output);
    } else {
      problem = fmt::format("its compression {} is not known", shown(method));
    }
    if (problem.empty() && output.too_long()) problem = "more is in it than it claims";
  }
  if (problem.empty() && size && out.size() != *size) {
    problem = fmt::format("it holds {} bytes, but claims {}", out.size(), *size);
  }
  return problem;
}

}  // namespace stdc
