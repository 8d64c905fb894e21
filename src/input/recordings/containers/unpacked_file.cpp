#include "input/recordings/containers/unpacked_file.hpp"

#include <stdlib.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

fs::path new_file_name(const fs::path& packed) {
  std::string name = (fs::temp_directory_path() / "stdc-unpacked-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0) {
    throw Error(packed.string(),
                "cannot be unpacked: no file can be made in " + fs::temp_directory_path().string(),
                "set TMPDIR to a folder with room");
  }
  close(file);
  return name;
}

/// Bytes that may be written without filling the disk.
std::uintmax_t room_of(const fs::path& folder) {
  constexpr std::uintmax_t kLeft = 256U << 20U;
  std::error_code failed;
  const fs::space_info space = fs::space(folder, failed);
  return failed || space.available < kLeft ? 0 : space.available - kLeft;
}

/// Half a sentence on what went wrong, or "".
std::string unpack_file(const fs::path& packed, const fs::path& to) {
  std::ifstream in(packed, std::ios::binary);
  std::ofstream out(to, std::ios::binary);
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  std::vector<char> from(ZSTD_DStreamInSize()), result(ZSTD_DStreamOutSize());
  std::uintmax_t room = room_of(to.parent_path());
  std::size_t left = 1;
  while (in.read(from.data(), static_cast<std::streamsize>(from.size())), in.gcount() > 0) {
    ZSTD_inBuffer input{from.data(), static_cast<std::size_t>(in.gcount()), 0};
    while (input.pos < input.size) {
      ZSTD_outBuffer output{result.data(), result.size(), 0};
      left = ZSTD_decompressStream(context.get(), &output, &input);
      if (ZSTD_isError(left) != 0) return "its zstd data are damaged";
      if (output.pos > room) return "there is no room to unpack it in " + to.parent_path().string();
      room -= output.pos;
      out.write(result.data(), static_cast<std::streamsize>(output.pos));
    }
  }
  if (left != 0) return "its zstd data end too early";
  return out.flush() ? "" : "it cannot be unpacked to " + to.parent_path().string();
}

}  // namespace

UnpackedFile::UnpackedFile(const fs::path& packed) : path_(new_file_name(packed)) {
  const std::string problem = unpack_file(packed, path_);
  if (problem.empty()) return;
  std::error_code ignored;
  fs::remove(path_, ignored);
  throw Error(packed.string(), problem, "unpack it by 'zstd -d' first, or set TMPDIR to a folder with room");
}

UnpackedFile::~UnpackedFile() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

bool is_zstd(Bytes beginning) {
  constexpr std::array<std::uint8_t, 4> kMagic{0x28, 0xB5, 0x2F, 0xFD};
  return beginning.size() >= kMagic.size() && std::equal(kMagic.begin(), kMagic.end(), beginning.begin());
}

}  // namespace stdc
