#include "run/output_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "core/error.hpp"
#include "core/files/unique_folder.hpp"

namespace stdc::app {
namespace fs = std::filesystem;

namespace {

constexpr const char* kHint = "give another --output folder or free it";

}  // namespace

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
  if (const std::error_code failed = made_.make(folder_)) {
    throw Error(folder_.string(), fmt::format("cannot be made ({})", failed.message()), kHint);
  }
  std::error_code failed;
  if (!fs::is_directory(folder_, failed)) {
    throw Error(folder_.string(), "is not a folder", "give another --output");
  }
  hidden_ = make_unique_folder(folder_ / ".partial", failed);
  if (failed)
    throw Error(folder_.string(), fmt::format("cannot be written to ({})", failed.message()), kHint);
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!hidden_.empty()) fs::remove_all(hidden_, ignored);
}

void OutputFolder::write(const std::string& name, std::string_view content) {
  const fs::path path = hidden_ / name;
  std::FILE* file = std::fopen(path.c_str(), "wb");
  bool good = file != nullptr && std::fwrite(content.data(), 1, content.size(), file) == content.size();
  if (file != nullptr && std::fclose(file) != 0) good = false;
  if (!good) {
    throw Error((folder_ / name).string(), fmt::format("cannot be written ({})", std::strerror(errno)),
                kHint);
  }
  names_.push_back(name);
}

void OutputFolder::write(const std::string& name, std::span<const std::uint8_t> content) {
  write(name, std::string_view(reinterpret_cast<const char*>(content.data()), content.size()));
}

void OutputFolder::commit() {
  for (const std::string& name : names_) {
    std::error_code failed;
    fs::rename(hidden_ / name, folder_ / name, failed);
    if (failed) {
      throw Error((folder_ / name).string(), fmt::format("cannot be replaced ({})", failed.message()), kHint);
    }
  }
  remove_dropped();
  std::error_code ignored;
  fs::remove_all(hidden_, ignored);
  hidden_.clear();
  made_.keep();
}

void OutputFolder::remove_dropped() noexcept {
  constexpr std::string_view kEnding = ".txt";
  const auto is_dropped = [&](std::string_view name) {
    return std::any_of(dropped_.begin(), dropped_.end(), [&](const std::string& stem) {
      if (name.size() <= stem.size() + kEnding.size() || !name.starts_with(stem) || !name.ends_with(kEnding))
        return false;
      const std::string_view number = name.substr(stem.size(), name.size() - stem.size() - kEnding.size());
      return number.find_first_not_of("0123456789") == std::string_view::npos;
    });
  };
  std::error_code ignored;
  std::vector<fs::path> old;
  for (fs::directory_iterator entry(folder_, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const bool written = std::find(names_.begin(), names_.end(), name) != names_.end();
    if (!written && is_dropped(name)) old.push_back(entry->path());
  }
  for (const fs::path& path : old) fs::remove(path, ignored);
}

}  // namespace stdc::app
