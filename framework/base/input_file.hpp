#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace lightloom {

/// A regular file opened for reading. Opening never blocks: pipes, devices, sockets and folders are refused, as what
/// reads them may wait for ever or never end.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Why it cannot be read, fit to follow "the file X ": "does not exist", "is not a regular file", "cannot be opened:
  /// …". Empty if it can.
  [[nodiscard]] const std::string& problem() const { return problem_; }
  /// As the file system says [bytes].
  [[nodiscard]] uint64_t size() const { return size_; }
  /// Reads the next `count` bytes; false where the file ends before, or cannot be read.
  [[nodiscard]] bool read(void* to, uint64_t count);

 private:
  int descriptor_ = -1;
  uint64_t size_ = 0;
  std::string problem_;
};

}  // namespace lightloom
