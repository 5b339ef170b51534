#include "framework/base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <ctime>
#include <string_view>
#include <system_error>
#include <utility>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"

namespace lightloom {
namespace {

namespace fs = std::filesystem;

/// The topmost of the folder and those above it that is not there yet; empty if all are.
fs::path topmost_missing(const fs::path& folder) {
  fs::path missing;
  std::error_code ignored;
  for (fs::path at = fs::absolute(folder, ignored); !at.empty() && !fs::exists(at, ignored); at = at.parent_path()) {
    missing = at;
    if (at == at.parent_path()) break;
  }
  return missing;
}

/// From the folder up to the topmost that was made, as far as they are empty.
void remove_made(const fs::path& folder, const fs::path& made) {
  if (made.empty()) return;
  std::error_code ignored;
  for (fs::path at = fs::absolute(folder, ignored); fs::remove(at, ignored) && at != made;) at = at.parent_path();
}

std::string who_am_i(const std::string& work) {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0) host = {'?'};
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::array<char, 32> time{};
  ::gmtime_r(&now, &parts);
  static_cast<void>(std::strftime(time.data(), time.size(), "%Y-%m-%d %H:%M:%S UTC", &parts));
  return work + "\nprocess " + std::to_string(::getpid()) + " on " + host.data() + ", since " + time.data() + "\n";
}

std::string text_in(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  return size > 0 ? std::string(text.data(), static_cast<size_t>(size)) : std::string();
}

/// The file that is locked may have been removed by who had it before: then the lock guards nothing.
bool is_still_there(int descriptor, const fs::path& file) {
  struct stat locked {
  }, named{};
  return ::fstat(descriptor, &locked) == 0 && ::stat(file.c_str(), &named) == 0 && locked.st_ino == named.st_ino &&
         locked.st_dev == named.st_dev;
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& holder) {
  const size_t line = holder.find('\n');
  const std::string work = line == std::string::npos || line == 0 ? "run" : holder.substr(0, line);
  std::string who = line == std::string::npos ? "" : holder.substr(line + 1, holder.find('\n', line + 1) - line - 1);
  if (!who.empty()) who = " (" + who + ")";
  throw Error(ExitCode::run_failed, "another " + work + " is running in '" + folder.string() + "'" + who,
              "wait for it, or choose another folder with --out");
}

}  // namespace

FolderLock::FolderLock(fs::path folder, const std::string& work) : folder_(std::move(folder)) {
  made_ = topmost_missing(folder_);
  make_folder(folder_);
  const fs::path file = folder_ / kFile;
  while (descriptor_ < 0) {
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0644);
    if (descriptor_ < 0) {
      const int cause = errno;
      remove_made(folder_, made_);
      throw Error(ExitCode::run_failed,
                  "cannot write in '" + folder_.string() + "': " + std::generic_category().message(cause),
                  "choose a folder that you may write to");
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      const int cause = errno;
      const std::string holder = text_in(descriptor_);
      ::close(std::exchange(descriptor_, -1));
      if (cause == EINTR) continue;
      if (cause == EWOULDBLOCK) refuse(folder_, holder);
      throw Error(ExitCode::run_failed,
                  "cannot lock '" + file.string() + "': " + std::generic_category().message(cause));
    }
    if (!is_still_there(descriptor_, file)) ::close(std::exchange(descriptor_, -1));
  }
  const std::string text = who_am_i(work);
  // What stands in it is for the message of others alone; a disk that is full for it is told at the first real file.
  if (::ftruncate(descriptor_, 0) == 0) {
    [[maybe_unused]] const ssize_t written = ::pwrite(descriptor_, text.data(), text.size(), 0);
  }
}

FolderLock::~FolderLock() {
  if (is_still_there(descriptor_, folder_ / kFile)) ::unlink((folder_ / kFile).c_str());
  ::close(descriptor_);
  remove_made(folder_, made_);
}

}  // namespace lightloom
