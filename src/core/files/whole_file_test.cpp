#include "core/files/whole_file.hpp"

#include <gtest/gtest.h>

#include <iterator>

#include "core/error.hpp"
#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;
using test::TestFolder;

std::string content(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

long files_in(const TestFolder& folder) {
  return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

TEST(WholeFile, AppearsWithCommitOnly) {
  const TestFolder folder;
  folder.write("a.txt", std::string("old"));
  {
    WholeFile file(folder / "a.txt");
    file.stream() << "new";
    EXPECT_EQ(content(folder / "a.txt"), "old");
  }
  EXPECT_EQ(content(folder / "a.txt"), "old") << "never committed";
  WholeFile file(folder / "a.txt");
  file.stream() << "new";
  file.commit();
  EXPECT_EQ(content(folder / "a.txt"), "new");
  EXPECT_EQ(files_in(folder), 1);
}

TEST(WholeFile, PlacesThatWillNotDoAreRefused) {
  const TestFolder folder;
  EXPECT_THROW(WholeFile(folder / "none/a.txt"), Error);
  EXPECT_THROW(WholeFile(folder.path()), Error);
  EXPECT_EQ(files_in(folder), 0);
}

TEST(WholeFile, AFullDiskIsAnErrorAndLeavesNothing) {
  const TestFolder folder;
  WholeFile file(folder / "a.txt");
  // A device that is always full stands for the disk.
  file.stream().setstate(std::ios::badbit);
  EXPECT_THROW(file.commit(), Error);
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
}

}  // namespace
}  // namespace stdc
