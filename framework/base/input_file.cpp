#include "framework/base/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace lightloom {

InputFile::InputFile(const std::filesystem::path& path) {
  // Without O_NONBLOCK, opening a pipe waits for somebody who writes into it.
  descriptor_ = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  if (descriptor_ < 0) {
    problem_ = errno == ENOENT || errno == ENOTDIR ? "does not exist"
               : errno == ENXIO                    ? "is not a regular file"
                                                   : "cannot be opened: " + std::generic_category().message(errno);
    return;
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) {
    problem_ = "cannot be looked at: " + std::generic_category().message(errno);
  } else if (!S_ISREG(status.st_mode)) {
    problem_ = "is not a regular file";
  } else {
    size_ = static_cast<uint64_t>(status.st_size);
  }
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool InputFile::read(void* to, uint64_t count) {
  constexpr uint64_t kMostAtOnce = uint64_t{1} << 30;
  auto* target = static_cast<unsigned char*>(to);
  while (count > 0) {
    const ssize_t got = ::read(descriptor_, target, std::min(count, kMostAtOnce));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    target += got;
    count -= static_cast<uint64_t>(got);
  }
  return true;
}

}  // namespace lightloom
