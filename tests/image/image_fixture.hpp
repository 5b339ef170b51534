#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <random>
#include <string>

#include "framework/base/error.hpp"
#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// A folder of its own for one test, removed with all that is in it.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lightloom_image_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] size_t file_count() const {
    return static_cast<size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

/// Random bits in every texel: floats include infinities, NaNs and denormals.
inline HostImage random_image(Format format, Dimension dimension, Extent3 extent, uint32_t seed) {
  HostImage image{{format, dimension, extent}, {}};
  image.texels.resize(byte_size(image.desc));
  std::mt19937 generator(seed);
  for (std::byte& byte : image.texels) byte = static_cast<std::byte>(generator() & 0xFFu);
  return image;
}

/// Demands that `read` refuses each of these files of the folder as invalid input, and names it.
template <class Read>
void expect_refused(const TemporaryFolder& folder, std::initializer_list<const char*> names, Read read) {
  for (const char* name : names) {
    try {
      (void)read(folder / name);
      ADD_FAILURE() << name << " was read";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::invalid_input) << name;
      EXPECT_THAT(error.what(), ::testing::HasSubstr(name));
    }
  }
}

}  // namespace lightloom::image
