#include "framework/base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, int cause) {
  std::string hint;
  if (cause == ENOENT || cause == ENOTDIR) hint = "the folder must exist";
  if (cause == ENOSPC || cause == EDQUOT) hint = "free some space or choose another folder with --out";
  if (cause == EACCES || cause == EROFS || cause == EPERM) hint = "choose a folder that you may write to";
  throw Error(ExitCode::run_failed, "cannot write '" + file.string() + "': " + std::generic_category().message(cause),
              hint);
}

/// The file under its working name; removed again unless `rename_to` succeeds.
class AsideFile {
 public:
  explicit AsideFile(const std::filesystem::path& file)
      : target_(file), aside_(file.parent_path() / ("." + file.filename().string() + "." + std::to_string(getpid()))) {
    descriptor_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(target_, errno);
  }
  AsideFile(const AsideFile&) = delete;
  AsideFile& operator=(const AsideFile&) = delete;
  ~AsideFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!finished_) ::unlink(aside_.c_str());
  }

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) fail(target_, errno);
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
  }

  void finish() {
    // Some file systems report a full disk only when the file is closed.
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(target_, errno);
    if (::rename(aside_.c_str(), target_.c_str()) != 0) fail(target_, errno);
    finished_ = true;
  }

 private:
  std::filesystem::path target_;
  std::filesystem::path aside_;
  int descriptor_ = -1;
  bool finished_ = false;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  AsideFile aside(file);
  aside.write(bytes);
  aside.finish();
}

void write_file_atomically(const std::filesystem::path& file, std::string_view text) {
  write_file_atomically(file, std::as_bytes(std::span<const char>(text.data(), text.size())));
}

}  // namespace lightloom
