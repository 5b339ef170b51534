#include "framework/base/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

/// "it needs 100 bytes, and 20 are free there; " or "" where nobody knows.
std::string room_text(const std::filesystem::path& file, size_t needed) {
  struct statvfs room {};
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  if (::statvfs(folder.c_str(), &room) != 0) return {};
  return "it needs " + std::to_string(needed) + " bytes, and " + std::to_string(room.f_bavail * room.f_frsize) +
         " are free there; ";
}

[[noreturn]] void fail(const std::filesystem::path& file, int cause, size_t needed) {
  std::string hint;
  if (cause == ENOENT || cause == ENOTDIR) hint = "the folder must exist";
  if (cause == ENOSPC || cause == EDQUOT)
    hint = room_text(file, needed) + "free some space or choose another folder with --out";
  if (cause == EACCES || cause == EROFS || cause == EPERM) hint = "choose a folder that you may write to";
  throw Error(ExitCode::run_failed, "cannot write '" + file.string() + "': " + std::generic_category().message(cause),
              hint);
}

/// The file under its working name, which no other thread of any process uses meanwhile; removed again unless
/// `finish` succeeds.
class AsideFile {
 public:
  AsideFile(const std::filesystem::path& file, size_t size)
      : target_(file),
        size_(size),
        aside_(file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::gettid()))) {
    descriptor_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail(target_, errno, size_);
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
      if (written == 0) fail(target_, EIO, size_);
      if (written < 0) fail(target_, errno, size_);
      bytes = bytes.subspan(static_cast<size_t>(written));
    }
  }

  /// The file, and all that was written to its file system before, lasts through a loss of power. The second keeps
  /// a checkpoint from being newer than the frames that it counts.
  void make_durable() const {
    if (::fsync(descriptor_) != 0 || ::syncfs(descriptor_) != 0) fail(target_, errno, size_);
  }

  void finish() {
    // Some file systems report a full disk only when the file is closed.
    const int closed = ::close(descriptor_);
    descriptor_ = -1;
    if (closed != 0) fail(target_, errno, size_);
    if (::rename(aside_.c_str(), target_.c_str()) != 0) fail(target_, errno, size_);
    finished_ = true;
  }

 private:
  std::filesystem::path target_;
  size_t size_;
  std::filesystem::path aside_;
  int descriptor_ = -1;
  bool finished_ = false;
};

/// Without it the new name of a file may be lost with the power, but not the old one.
void make_names_durable(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path().empty() ? "." : file.parent_path();
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) fail(file, errno, 0);
  const int synced = ::fsync(descriptor);
  const int cause = errno;
  ::close(descriptor);
  // Some network file systems cannot do it for folders.
  if (synced != 0 && cause != EINVAL) fail(file, cause, 0);
}

}  // namespace

void write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> bytes, Durability durability) {
  AsideFile aside(file, bytes.size());
  aside.write(bytes);
  if (durability == Durability::power_loss) aside.make_durable();
  aside.finish();
  if (durability == Durability::power_loss) make_names_durable(file);
}

void write_file_atomically(const std::filesystem::path& file, std::string_view text) {
  write_file_atomically(file, std::as_bytes(std::span<const char>(text.data(), text.size())));
}

}  // namespace lightloom
