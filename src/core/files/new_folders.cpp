#include "core/files/new_folders.hpp"

namespace stdc {
namespace fs = std::filesystem;

NewFolders::~NewFolders() {
  std::error_code ignored;
  for (auto path = made_.rbegin(); path != made_.rend(); ++path) fs::remove(*path, ignored);
}

std::error_code NewFolders::make(const fs::path& folder) {
  std::error_code problem;
  std::vector<fs::path> missing;
  for (fs::path path = folder.lexically_normal(); !path.empty() && !fs::exists(path, problem);
       path = path.parent_path()) {
    missing.push_back(path);
    if (path == path.parent_path()) break;
  }
  for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
    if (path->filename().empty()) continue;  // "results/" is there once "results" is
    if (fs::create_directory(*path, problem)) made_.push_back(*path);
    if (problem) return problem;
  }
  return {};
}

}  // namespace stdc
