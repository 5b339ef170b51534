#include "framework/image/npy.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

#include "framework/base/error.hpp"
#include "tests/image/image_fixture.hpp"

namespace lightloom::image {
namespace {

using ::testing::HasSubstr;

std::string read_bytes(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

struct Case {
  Format format;
  const char* dtype;
  int channels;
};

class NpyFormats : public ::testing::TestWithParam<Case> {};

// The header is taken apart by a regular expression made from NumPy's description of the format.
TEST_P(NpyFormats, the_header_is_numpys_and_the_data_follow_as_they_are) {
  const TemporaryFolder folder;
  const HostImage volume = random_image(GetParam().format, Dimension::d3, {5, 3, 2}, 1);
  write_npy(folder / "a.npy", volume);
  const std::string bytes = read_bytes(folder / "a.npy");
  ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\0", 8));
  const size_t length = static_cast<uint8_t>(bytes[8]) + 256u * static_cast<uint8_t>(bytes[9]);
  EXPECT_EQ((10 + length) % 64, 0u);
  const std::string header = bytes.substr(10, length);
  std::smatch match;
  ASSERT_TRUE(std::regex_match(
      header, match,
      std::regex(
          R"(\{'descr': '(.*)', 'fortran_order': (False|True), 'shape': \((\d+), (\d+), (\d+), (\d+)\), \} *\n)")))
      << header;
  EXPECT_EQ(match[1], GetParam().dtype);
  EXPECT_EQ(match[2], "False");
  EXPECT_EQ(match[3], "2");
  EXPECT_EQ(match[4], "3");
  EXPECT_EQ(match[5], "5");
  EXPECT_EQ(match[6], std::to_string(GetParam().channels));
  ASSERT_EQ(bytes.size() - 10 - length, volume.texels.size());
  EXPECT_EQ(std::memcmp(bytes.data() + 10 + length, volume.texels.data(), volume.texels.size()), 0);
}

TEST_P(NpyFormats, every_bit_survives) {
  const TemporaryFolder folder;
  for (const Dimension dimension : {Dimension::d2, Dimension::d3}) {
    const HostImage image = random_image(GetParam().format, dimension, {7, 4, dimension == Dimension::d3 ? 3u : 1u}, 2);
    write_npy(folder / "a.npy", image);
    const HostImage back = read_npy(folder / "a.npy");
    EXPECT_EQ(back.desc, image.desc);
    EXPECT_EQ(back.texels, image.texels);
  }
  EXPECT_EQ(folder.file_count(), 1u);
}

INSTANTIATE_TEST_SUITE_P(Formats, NpyFormats,
                         ::testing::Values(Case{Format::r8_unorm, "|u1", 1}, Case{Format::rgba8_unorm, "|u1", 4},
                                           Case{Format::rgba16_unorm, "<u2", 4}, Case{Format::r16_sfloat, "<f2", 1},
                                           Case{Format::rgba16_sfloat, "<f2", 4}, Case{Format::rg32_sfloat, "<f4", 2},
                                           Case{Format::rgba32_sfloat, "<f4", 4}, Case{Format::r32_uint, "<u4", 1},
                                           Case{Format::rg32_uint, "<u4", 2}));

std::string array_file(const std::string& header, size_t data_bytes) {
  std::string bytes("\x93NUMPY\x01\0", 8);
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  return bytes + header + std::string(data_bytes, 'x');
}

TEST(Npy, what_is_no_image_is_invalid_input) {
  const TemporaryFolder folder;
  const std::string good = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2, 3, 4), }\n";
  std::ofstream(folder / "good.npy", std::ios::binary) << array_file(good, 24);
  EXPECT_EQ(read_npy(folder / "good.npy").desc, (ImageDesc{Format::rgba8_unorm, Dimension::d3, {3, 2, 1}}));
  const std::vector<std::string> bad = {
      array_file(good, 23),
      array_file(good, 25),
      array_file(good, 24).substr(0, 40),
      array_file(good, 24).substr(0, 9),
      "PK\x03\x04",
      "",
      array_file("{'descr': '|u1', 'fortran_order': True, 'shape': (1, 2, 3, 4), }\n", 24),
      array_file("{'descr': '>f2', 'fortran_order': False, 'shape': (1, 1, 3, 4), }\n", 24),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (24,), }\n", 24),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2, 4, 3), }\n", 24),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (0, 2, 3, 4), }\n", 0),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (-1, 2, 3, 4), }\n", 0),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2, 3, 4\n", 24),
      array_file("{'descr': '|u1', 'fortran_order': False, }\n", 24),
      array_file("{'descr': '|u1', 'fortran_order': False, 'shape': (4294967296, 4294967296, 1, 4), }\n", 0),
  };
  for (const std::string& bytes : bad) {
    std::ofstream(folder / "bad.npy", std::ios::binary) << bytes;
    try {
      (void)read_npy(folder / "bad.npy");
      ADD_FAILURE() << "read: " << bytes;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input);
      EXPECT_THAT(error.what(), HasSubstr("bad.npy"));
    }
  }
  EXPECT_THROW((void)read_npy(folder / "none.npy"), Error);
}

}  // namespace
}  // namespace lightloom::image
