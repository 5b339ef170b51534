#pragma once

#include <cstdint>
#include <ctime>
#include <fstream>
#include <string>

namespace lightloom::test {

/// Processor time and memory that something takes, from the construction on. Memory is the highest resident size of
/// this process since then, less what it was, as Linux counts it. Both are divided by what sanitizers cost.
class Usage {
 public:
  Usage() {
    std::ofstream("/proc/self/clear_refs") << "5";  // forgets the highest size so far
    before_ = peak();
  }
  [[nodiscard]] uint64_t megabytes() const {
    return peak() > before_ ? ((peak() - before_) >> 10) / kSanitizerMemory : 0;
  }
  [[nodiscard]] double seconds() const { return (now() - start_) / kSanitizerTime; }

 private:
#if defined(__SANITIZE_ADDRESS__)
  static constexpr bool kSanitized = true;
#elif defined(__has_feature)
  static constexpr bool kSanitized = __has_feature(address_sanitizer);
#else
  static constexpr bool kSanitized = false;
#endif
  static constexpr uint64_t kSanitizerMemory = kSanitized ? 4 : 1;
  static constexpr double kSanitizerTime = kSanitized ? 40 : 1;  // slow unwinding included

  static double now() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  static uint64_t peak() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      uint64_t kilobytes = 0;
      if (word == "VmHWM:" && status >> kilobytes) return kilobytes;
    }
    return 0;
  }

  uint64_t before_ = 0;
  double start_ = now();
};

}  // namespace lightloom::test
