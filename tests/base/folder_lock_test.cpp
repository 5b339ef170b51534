#include "framework/base/folder_lock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class FolderLockTest : public ::testing::Test {
 protected:
  FolderLockTest() {
    fs::remove_all(top_);
    fs::create_directories(top_);
  }
  ~FolderLockTest() override { fs::remove_all(top_); }

  const fs::path top_ = fs::temp_directory_path() / ("lightloom-lock-" + std::to_string(getpid()));
};

TEST_F(FolderLockTest, ASecondOneIsRefusedAndToldWhoHasIt) {
  const FolderLock first(top_ / "run", "render");
  try {
    const FolderLock second(top_ / "run", "study");
    ADD_FAILURE() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::run_failed);
    EXPECT_THAT(error.what(), HasSubstr("another render is running in '" + (top_ / "run").string() + "' (process " +
                                        std::to_string(getpid()) + " on "));
    EXPECT_THAT(error.what(), HasSubstr("UTC)"));
    EXPECT_THAT(error.hint(), HasSubstr("--out"));
  }
  EXPECT_NO_THROW(FolderLock(top_ / "other", "render"));
}

TEST_F(FolderLockTest, WhatItMadeGoesUnlessSomethingIsInIt) {
  { const FolderLock lock(top_ / "a/b/c", "render"); }
  EXPECT_FALSE(fs::exists(top_ / "a"));
  {
    const FolderLock lock(top_ / "a/b/c", "render");
    std::ofstream(top_ / "a/b/picture.png") << "x";
  }
  EXPECT_FALSE(fs::exists(top_ / "a/b/c"));
  EXPECT_TRUE(fs::exists(top_ / "a/b/picture.png"));
  fs::create_directories(top_ / "there");
  { const FolderLock lock(top_ / "there", "render"); }
  EXPECT_TRUE(fs::is_empty(top_ / "there"));
}

TEST_F(FolderLockTest, AProcessThatWasKilledHasNoLockAnyMore) {
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(top_ / "run", "render");
    _exit(0);  // as if killed: nothing is tidied up
  }
  ::waitpid(child, nullptr, 0);
  ASSERT_TRUE(fs::exists(top_ / "run" / FolderLock::kFile));
  EXPECT_NO_THROW(FolderLock(top_ / "run", "render"));
  EXPECT_FALSE(fs::exists(top_ / "run" / FolderLock::kFile));
}

TEST_F(FolderLockTest, AFileInTheWayIsAnError) {
  std::ofstream(top_ / "run") << "x";
  EXPECT_THROW(FolderLock(top_ / "run", "render"), Error);
  fs::create_directories(top_ / "folder" / FolderLock::kFile);
  EXPECT_THROW(FolderLock(top_ / "folder", "render"), Error);
}

}  // namespace
}  // namespace lightloom
