#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include "core/error.hpp"
#include "core/files/unique_folder.hpp"

namespace stdc::test {

/// A new empty folder that is removed with what is in it. For tests.
class TestFolder {
 public:
  TestFolder() {
    std::error_code failed;
    path_ = make_unique_folder(std::filesystem::temp_directory_path() / "stdc-test", failed);
    if (failed) throw std::runtime_error("no temporary folder: " + failed.message());
  }
  ~TestFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  /// Writes a file, making its folders.
  template <typename Bytes>
  std::filesystem::path write(const std::string& name, const Bytes& bytes) const {
    std::filesystem::path path = path_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

 private:
  std::filesystem::path path_;
};

/// The one-line message of the Error that `action` throws; "" if it throws none.
template <typename Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace stdc::test
