#include "framework/gpu/pipeline_file.hpp"

#include <sys/stat.h>

#include <thread>

#include "framework/base/file.hpp"
#include "tests/gpu/gpu_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::gpu {
namespace {

namespace fs = std::filesystem;

using ::testing::HasSubstr;

constexpr size_t kHeaderBytes = 56;  ///< what the file has before the driver's data

class PipelineFileTest : public test::DeviceTest {
 protected:
  /// Makes a pipeline, as a process would.
  PipelineFileStatistics make_one() const {
    PipelineCache cache(device(), cache_folder());
    static_cast<void>(cache.compute(program_, {}));
    cache.save();
    return cache.file().statistics();
  }
  [[nodiscard]] fs::path cache_folder() const { return folder_.path() / "new" / "cache"; }
  [[nodiscard]] fs::path file() const { return PipelineFile(device(), cache_folder()).file(); }
  [[nodiscard]] size_t files_there() const {
    return static_cast<size_t>(std::distance(fs::directory_iterator(cache_folder()), {}));
  }

  /// What stands in the file's place is refused with this reason, and replaced by a sound file.
  void expect_replaced(const std::string& reason) const {
    const PipelineFileStatistics first = make_one();
    EXPECT_THAT(first.rejected, HasSubstr(reason));
    EXPECT_EQ(first.loaded_bytes, 0u);
    EXPECT_EQ(first.written, 1u) << first.write_failure;
    const PipelineFileStatistics second = make_one();
    EXPECT_EQ(second.rejected, "");
    EXPECT_GT(second.loaded_bytes, 0u);
    EXPECT_EQ(files_there(), 1u) << "a file was left behind";
  }
  void expect_bytes_replaced(const std::string& bytes, const std::string& reason) const {
    fs::create_directories(cache_folder());
    std::ofstream(file(), std::ios::binary) << bytes;
    expect_replaced(reason);
  }

  test::TemporaryFolder folder_;
  ShaderProgram program_ = test::compile_compute(
      "layout(local_size_x = 1) in;\nlayout(std430) buffer R { float r; };\nvoid main() { r = 2.0; }\n");
};

TEST_F(PipelineFileTest, TheSecondTimeTheDriverIsGivenWhatItGave) {
  const PipelineFileStatistics first = make_one();
  EXPECT_EQ(first.loaded_bytes, 0u);
  EXPECT_EQ(first.rejected, "");
  ASSERT_EQ(first.written, 1u) << first.write_failure;
  const std::string bytes = read_text_file(file());
  EXPECT_EQ(make_one().loaded_bytes, bytes.size() - kHeaderBytes);
  EXPECT_EQ(files_there(), 1u) << "an unfinished file was left behind";
}

TEST_F(PipelineFileTest, WhatHasNotChangedIsNotWrittenAgain) {
  static_cast<void>(make_one());
  PipelineFile same(device(), cache_folder());
  same.save();
  EXPECT_EQ(same.statistics().written, 0u);
}

TEST_F(PipelineFileTest, NothingIsWrittenWithoutAPipelineOrAFolder) {
  { const PipelineCache unused(device(), cache_folder()); }
  EXPECT_FALSE(fs::exists(cache_folder()));
  PipelineCache memory_only(device());
  static_cast<void>(memory_only.compute(program_, {}));
  memory_only.save();
  EXPECT_EQ(memory_only.file().get(), VkPipelineCache{VK_NULL_HANDLE});
  EXPECT_EQ(memory_only.file().statistics().written, 0u);
}

TEST_F(PipelineFileTest, TheEndOfTheCacheSaves) {
  {
    PipelineCache cache(device(), cache_folder());
    static_cast<void>(cache.compute(program_, {}));
  }
  EXPECT_TRUE(fs::is_regular_file(file()));
}

TEST_F(PipelineFileTest, EachByteFlippedOrTheEndCutOffIsNoticed) {
  ASSERT_EQ(make_one().written, 1u);
  const std::string bytes = read_text_file(file());
  const PipelineFileOwner owner = pipeline_file_owner(device());
  EXPECT_EQ(decode_pipeline_file(bytes, owner), std::string_view(bytes).substr(kHeaderBytes));
  for (size_t byte = 0; byte < bytes.size(); byte += byte < 200 ? 1 : 97) {
    std::string flipped = bytes;
    flipped[byte] = static_cast<char>(flipped[byte] ^ (1 << (byte % 8)));
    EXPECT_THROW(static_cast<void>(decode_pipeline_file(flipped, owner)), Error) << "byte " << byte;
  }
  for (size_t length = 0; length < bytes.size(); length += length < 200 ? 1 : 97)
    EXPECT_THROW(static_cast<void>(decode_pipeline_file(bytes.substr(0, length), owner)), Error) << "length " << length;
  EXPECT_THROW(static_cast<void>(decode_pipeline_file(bytes + "x", owner)), Error);
}

TEST_F(PipelineFileTest, ADamagedOneIsMadeAnew) {
  ASSERT_EQ(make_one().written, 1u);
  const std::string bytes = read_text_file(file());
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  expect_bytes_replaced("", "is cut off");
  expect_bytes_replaced(bytes.substr(0, kHeaderBytes - 1), "is cut off");
  expect_bytes_replaced(bytes.substr(0, bytes.size() - 1), "has another length than it says");
  expect_bytes_replaced(bytes + "more", "has another length than it says");
  expect_bytes_replaced(flipped, "is damaged");
  expect_bytes_replaced("#!/bin/sh\n" + bytes, "is of another kind or version");
}

TEST_F(PipelineFileTest, ThatOfAnotherDeviceOrDriverIsNotGivenToThisOne) {
  ASSERT_EQ(make_one().written, 1u);
  const PipelineFileOwner owner = pipeline_file_owner(device());
  const std::string data(decode_pipeline_file(read_text_file(file()), owner));
  std::array<PipelineFileOwner, 4> others{owner, owner, owner, owner};
  ++others[0].vendor;
  ++others[1].device;
  ++others[2].driver_version;
  ++others[3].cache_uuid[15];
  for (const PipelineFileOwner& other : others)
    expect_bytes_replaced(encode_pipeline_file(other, data), "is of another device or driver");
}

TEST_F(PipelineFileTest, DataThatIsNotThisDriversIsNotGivenToIt) {
  ASSERT_EQ(make_one().written, 1u);
  const PipelineFileOwner owner = pipeline_file_owner(device());
  const std::string data(decode_pipeline_file(read_text_file(file()), owner));
  const auto changed = [&](size_t byte, char by) {
    std::string other = data;
    other[byte] = static_cast<char>(other[byte] ^ by);
    return encode_pipeline_file(owner, other);
  };
  expect_bytes_replaced(encode_pipeline_file(owner, ""), "too short");
  expect_bytes_replaced(encode_pipeline_file(owner, data.substr(0, 31)), "too short");
  expect_bytes_replaced(changed(0, 16), "a header that Vulkan does not know");
  expect_bytes_replaced(changed(3, 1), "a header that Vulkan does not know");
  expect_bytes_replaced(changed(4, 2), "a header that Vulkan does not know");
  for (const size_t byte : {8, 12, 16, 31}) expect_bytes_replaced(changed(byte, 1), "is of another device");
}

TEST_F(PipelineFileTest, APipeOrAFileOfAbsurdSizeInItsPlaceIsReplaced) {
  fs::create_directories(cache_folder());
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  expect_replaced("is not a regular file");
  fs::resize_file(file(), (uintmax_t{256} << 20) + 1);
  expect_replaced("expected at most 268435456");
}

TEST_F(PipelineFileTest, AFolderInItsPlaceOnlyCostsTime) {
  fs::create_directories(file());
  const PipelineFileStatistics statistics = make_one();
  EXPECT_THAT(statistics.rejected, HasSubstr("cannot read"));
  EXPECT_THAT(statistics.write_failure, HasSubstr("cannot write"));
  EXPECT_EQ(files_there(), 1u) << "a file was left behind";
}

TEST_F(PipelineFileTest, ACacheFolderThatCannotBeMadeOnlyCostsTime) {
  folder_.write("new", "a file where the folder should be");
  const PipelineFileStatistics statistics = make_one();
  EXPECT_EQ(statistics.written, 0u);
  EXPECT_THAT(statistics.write_failure, HasSubstr("cannot make the folder"));
}

TEST_F(PipelineFileTest, TwoThatWriteAtOnceLeaveAWholeFile) {
  ASSERT_EQ(make_one().written, 1u);
  const fs::path place = file();
  const auto write = [&](std::string& problems) {
    for (int i = 0; i < 200; ++i) {
      std::error_code ignored;
      fs::remove(place, ignored);
      PipelineFile one(device(), cache_folder());
      one.save();
      if (one.statistics().rejected.find("does not exist") == std::string::npos &&
          one.statistics().rejected.find("No such file") == std::string::npos)
        problems += one.statistics().rejected;
      problems += one.statistics().write_failure;
    }
  };
  std::array<std::string, 2> problems;
  {
    const std::jthread other(write, std::ref(problems[1]));
    write(problems[0]);
  }
  EXPECT_EQ(problems[0] + problems[1], "");
  EXPECT_EQ(files_there(), 1u) << "a file was left behind";
  EXPECT_GT(make_one().loaded_bytes, 0u);
}

}  // namespace
}  // namespace lightloom::gpu
