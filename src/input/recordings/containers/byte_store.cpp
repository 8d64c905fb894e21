#include "input/recordings/containers/byte_store.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.hpp"

namespace stdc {
namespace {

class ByteFile : public ByteStore {
 public:
  explicit ByteFile(const std::filesystem::path& path) : file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat status {};
    if (file_ < 0 || fstat(file_, &status) != 0)
      fail(path, std::string("cannot be opened: ") + std::strerror(errno));
    if (!S_ISREG(status.st_mode)) fail(path, "is not a file");
    size_ = static_cast<std::uint64_t>(status.st_size);
  }
  ~ByteFile() override { close(); }
  ByteFile(const ByteFile&) = delete;
  ByteFile& operator=(const ByteFile&) = delete;

  std::uint64_t size() const override { return size_; }

 private:
  [[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem) {
    close();
    throw Error(path.string(), problem, "give a recording that is there and can be read");
  }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }
  bool copy(std::uint64_t offset, std::size_t count, std::uint8_t* to) const override {
    while (count > 0) {
      const ssize_t got = pread(file_, to, count, static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      offset += static_cast<std::uint64_t>(got), to += got, count -= static_cast<std::size_t>(got);
    }
    return true;
  }

  int file_;
  std::uint64_t size_ = 0;
};

class ByteMemory : public ByteStore {
 public:
  explicit ByteMemory(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }

 private:
  bool copy(std::uint64_t offset, std::size_t count, std::uint8_t* to) const override {
    if (count > 0) std::memcpy(to, bytes_.data() + offset, count);
    return true;
  }
  std::vector<std::uint8_t> bytes_;
};

}  // namespace

bool ByteStore::read(std::uint64_t offset, std::uint64_t count, std::vector<std::uint8_t>& out) const {
  if (offset <= size() && count <= size() - offset) {
    out.resize(static_cast<std::size_t>(count));
    if (copy(offset, out.size(), out.data())) return true;
  }
  out.clear();
  return false;
}

std::unique_ptr<ByteStore> open_byte_file(const std::filesystem::path& path) {
  return std::make_unique<ByteFile>(path);
}

std::unique_ptr<ByteStore> bytes_in_memory(std::vector<std::uint8_t> bytes) {
  return std::make_unique<ByteMemory>(std::move(bytes));
}

}  // namespace stdc
