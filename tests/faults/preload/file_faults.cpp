// Faults of files and of the clock, for a program that is started with this library in LD_PRELOAD. By the environment:
//   LIGHTLOOM_FILE_PREFIX   paths below it are meant
//   LIGHTLOOM_FILE_CALL     open, write, close, rename, mkdir, link, fsync or syncfs: which calls are counted
//   LIGHTLOOM_FILE_NTH      the call, from 1, that fails; 0: none
//   LIGHTLOOM_FILE_ERRNO    its reason
//   LIGHTLOOM_FILE_STAYS    1: all later calls fail as well, as on a disk that is full
//   LIGHTLOOM_FILE_REMOVE   a folder that is removed before that call, which then goes on
//   LIGHTLOOM_FILE_HOLD     a file: the call that fails waits until it is there, for a minute at most
//   LIGHTLOOM_FILE_LOG      gets "COUNT STRUCK\n" at the end
//   LIGHTLOOM_CLOCK         seconds that the clock of the day jumps at each look at it
// Only what this program calls is covered: 64-bit Linux, glibc, open with and without 64.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>

#define LIGHTLOOM_EXPORT extern "C" __attribute__((visibility("default")))

namespace {

constexpr int kDescriptors = 4096;

const char* text_of(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? "" : text;
}

template <typename Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

struct Faults {
  std::string prefix = text_of("LIGHTLOOM_FILE_PREFIX");
  std::string call = text_of("LIGHTLOOM_FILE_CALL");
  std::string remove = text_of("LIGHTLOOM_FILE_REMOVE");
  std::string hold = text_of("LIGHTLOOM_FILE_HOLD");
  std::string log = text_of("LIGHTLOOM_FILE_LOG");
  long nth = std::atol(text_of("LIGHTLOOM_FILE_NTH"));
  int cause = std::atoi(text_of("LIGHTLOOM_FILE_ERRNO"));
  bool stays = *text_of("LIGHTLOOM_FILE_STAYS") == '1';
  long jump = std::atol(text_of("LIGHTLOOM_CLOCK"));
  std::atomic<long> calls{0};
  std::atomic<long> struck{0};
  std::atomic<long> looks{0};
  std::array<std::atomic<bool>, kDescriptors> watched{};

  ~Faults() { write_log(); }

  void write_log() const {
    if (log.empty()) return;
    if (std::FILE* file = std::fopen(log.c_str(), "w")) {
      std::fprintf(file, "%ld %ld\n", calls.load(), struck.load());
      std::fclose(file);
    }
  }

  [[nodiscard]] bool meant(const char* path) const {
    return !prefix.empty() && path != nullptr && std::strncmp(path, prefix.c_str(), prefix.size()) == 0;
  }
  [[nodiscard]] bool meant(int descriptor) const {
    return descriptor >= 0 && descriptor < kDescriptors && watched[static_cast<size_t>(descriptor)];
  }
  void watch(int descriptor, bool yes) {
    if (descriptor >= 0 && descriptor < kDescriptors) watched[static_cast<size_t>(descriptor)] = yes;
  }

  void wait_until_released() const {
    constexpr int kTries = 6000;
    if (hold.empty()) return;
    for (int i = 0; i < kTries && access(hold.c_str(), F_OK) != 0; ++i) usleep(10'000);
  }

  /// Does this call fail? errno is set then.
  template <typename Place>
  bool strike(const char* name, Place place) {
    if (call != name || !meant(place)) return false;
    const long number = ++calls;
    if (nth == 0 || number < nth || (number > nth && !stays)) return false;
    ++struck;
    wait_until_released();
    if (!remove.empty()) {
      std::error_code ignored;
      std::filesystem::remove_all(remove, ignored);
      return false;
    }
    errno = cause;
    return true;
  }
};

Faults& faults() {
  static Faults all;
  return all;
}

/// Its counts are written when the program ends, even if no call was counted.
[[maybe_unused]] const Faults& at_start = faults();

using Open = int (*)(const char*, int, ...);

int open_by(const char* name, const char* path, int flags, mode_t mode) {
  if ((flags & (O_WRONLY | O_RDWR)) != 0 && faults().strike("open", path)) return -1;
  const int descriptor = next<Open>(name)(path, flags, mode);
  faults().watch(descriptor, faults().meant(path));
  return descriptor;
}

mode_t mode_of(int flags, va_list more) {
  return (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
}

}  // namespace

// The program ends by one of these, past destructors.
LIGHTLOOM_EXPORT void _exit(int status) {
  faults().write_log();
  next<void (*)(int)>("_exit")(status);
  __builtin_unreachable();
}

LIGHTLOOM_EXPORT void _Exit(int status) {
  _exit(status);
}

LIGHTLOOM_EXPORT int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_by("open", path, flags, mode);
}

LIGHTLOOM_EXPORT int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_of(flags, more);
  va_end(more);
  return open_by("open64", path, flags, mode);
}

LIGHTLOOM_EXPORT ssize_t write(int descriptor, const void* bytes, size_t size) {
  const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  if (!faults().strike("write", descriptor)) return real(descriptor, bytes, size);
  const int cause = errno;
  // A disk that runs full takes the beginning.
  [[maybe_unused]] const ssize_t begun = real(descriptor, bytes, size / 2);
  errno = cause;
  return -1;
}

LIGHTLOOM_EXPORT int close(int descriptor) {
  const bool fails = faults().strike("close", descriptor);
  const int cause = errno;
  faults().watch(descriptor, false);
  const int closed = next<int (*)(int)>("close")(descriptor);
  if (!fails) return closed;
  errno = cause;
  return -1;
}

LIGHTLOOM_EXPORT int fsync(int descriptor) {
  return faults().strike("fsync", descriptor) ? -1 : next<int (*)(int)>("fsync")(descriptor);
}

LIGHTLOOM_EXPORT int syncfs(int descriptor) noexcept {
  return faults().strike("syncfs", descriptor) ? -1 : next<int (*)(int)>("syncfs")(descriptor);
}

LIGHTLOOM_EXPORT int rename(const char* from, const char* to) noexcept {
  return faults().strike("rename", to) ? -1 : next<int (*)(const char*, const char*)>("rename")(from, to);
}

LIGHTLOOM_EXPORT int link(const char* from, const char* to) noexcept {
  return faults().strike("link", to) ? -1 : next<int (*)(const char*, const char*)>("link")(from, to);
}

LIGHTLOOM_EXPORT int mkdir(const char* path, mode_t mode) noexcept {
  return faults().strike("mkdir", path) ? -1 : next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}

LIGHTLOOM_EXPORT int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const int result = next<int (*)(clockid_t, timespec*)>("clock_gettime")(clock, time);
  if (clock == CLOCK_REALTIME && faults().jump != 0) time->tv_sec += faults().jump * ++faults().looks;
  return result;
}

LIGHTLOOM_EXPORT time_t time(time_t* result) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (result != nullptr) *result = now.tv_sec;
  return now.tv_sec;
}

LIGHTLOOM_EXPORT int gettimeofday(timeval* result, void* /*zone*/) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  *result = {.tv_sec = now.tv_sec, .tv_usec = now.tv_nsec / 1000};
  return 0;
}
