#include "framework/base/file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

TEST(ReadTextFile, GivesEveryByte) {
  const auto path = std::filesystem::path(testing::TempDir()) / "lightloom_read_text_file";
  const std::string bytes("a\r\nb\0c\xff", 7);
  std::ofstream(path, std::ios::binary) << bytes;
  EXPECT_EQ(read_text_file(path), bytes);
  std::filesystem::remove(path);
}

void expect_unreadable(const std::filesystem::path& path, const std::string& reason) {
  try {
    static_cast<void>(read_text_file(path));
    FAIL() << "no error for " << path;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_EQ(std::string(error.what()), "cannot read '" + path.string() + "': " + reason);
  }
}

TEST(ReadTextFile, SaysWhyItCannot) {
  expect_unreadable(std::filesystem::path(testing::TempDir()) / "no" / "such" / "file", "No such file or directory");
  expect_unreadable(std::filesystem::temp_directory_path(), "Is a directory");
}

}  // namespace
}  // namespace lightloom
