#include "framework/base/process.hpp"

#include <fstream>
#include <sstream>
#include <string>

namespace lightloom {
namespace {

/// A line of /proc/self/status, which counts in KiB.
uint64_t status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(key + ":", 0) != 0) continue;
    std::istringstream value(line.substr(key.size() + 1));
    uint64_t kibibytes = 0;
    value >> kibibytes;
    return kibibytes * 1024;
  }
  return 0;
}

}  // namespace

uint64_t peak_memory_bytes() {
  return status_bytes("VmHWM");
}

uint64_t memory_bytes() {
  return status_bytes("VmRSS");
}

}  // namespace lightloom
