#include "core/files/new_folders.hpp"

#include <gtest/gtest.h>

#include "core/files/test_folder.hpp"

namespace stdc {
namespace {

namespace fs = std::filesystem;

TEST(NewFolders, AreRemovedUnlessKept) {
  const test::TestFolder root;
  for (const bool keep : {false, true}) {
    NewFolders folders;
    EXPECT_FALSE(folders.make(root / "a/b/c/"));
    EXPECT_TRUE(fs::is_directory(root / "a/b/c"));
    if (keep) folders.keep();
  }
  EXPECT_TRUE(fs::is_directory(root / "a/b/c"));
  { NewFolders().make(root / "a/d"); }
  EXPECT_FALSE(fs::exists(root / "a/d"));
  EXPECT_TRUE(fs::exists(root / "a/b/c"));  // was there before
}

TEST(NewFolders, LeaveAFolderThatHasSomethingInIt) {
  const test::TestFolder root;
  {
    NewFolders folders;
    EXPECT_FALSE(folders.make(root / "a/b"));
    root.write("a/thesis.txt", std::string("words"));
  }
  EXPECT_FALSE(fs::exists(root / "a/b"));
  EXPECT_TRUE(fs::exists(root / "a/thesis.txt"));
}

TEST(NewFolders, SayWhyTheyCannotBeMade) {
  const test::TestFolder root;
  root.write("file", std::string("x"));
  EXPECT_TRUE(NewFolders().make(root / "file/a"));
}

}  // namespace
}  // namespace stdc
