#include "core/files/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "core/error.hpp"

namespace stdc {
namespace {

/// Brings what was written to the disk. False, with errno, if that fails.
bool flush_to_disk(const std::filesystem::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = fsync(file) == 0;
  close(file);
  return done;
}

}  // namespace

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), partial_(path_) {
  partial_ += fmt::format(".partial-{}", getpid());
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) fail(EISDIR);
  errno = 0;
  stream_.open(partial_, std::ios::binary | std::ios::trunc);
  if (!stream_) fail(errno);
}

WholeFile::~WholeFile() {
  if (partial_.empty()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void WholeFile::fail(int problem) const {
  const std::error_code reason(problem != 0 ? problem : EIO, std::generic_category());
  throw Error(path_.string(), fmt::format("cannot be written ({})", reason.message()),
              "check that its folder exists, may be written to, and has room");
}

void WholeFile::flush() {
  if (flushed_) return;
  errno = 0;
  const bool good = static_cast<bool>(stream_.flush());
  const int problem = errno;
  stream_.close();
  if (!good || !stream_) fail(problem);
  if (!flush_to_disk(partial_)) fail(errno);
  flushed_ = true;
}

void WholeFile::commit() {
  flush();
  std::error_code problem;
  std::filesystem::rename(partial_, path_, problem);
  if (problem) fail(problem.value());
  partial_.clear();
}

}  // namespace stdc
