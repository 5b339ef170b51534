#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace lightloom::test {

/// Bytes of all files of a run folder by relative path, but for run.json and the checkpoint, which hold times, and the
/// lock of who writes there.
inline std::map<std::string, std::string> run_files(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = std::filesystem::relative(entry.path(), folder).generic_string();
    if (!entry.is_regular_file() || name == "run.json" || name == ".lock" || name.starts_with("checkpoint/")) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    std::stringstream bytes;
    bytes << stream.rdbuf();
    files[name] = bytes.str();
  }
  return files;
}

/// The first file in which two runs differ; empty if they do not.
inline std::string first_difference(const std::filesystem::path& one, const std::filesystem::path& other) {
  const auto a = run_files(one), b = run_files(other);
  for (const auto& [name, bytes] : a)
    if (!b.contains(name) || b.at(name) != bytes) return name;
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) return name;
  return {};
}

}  // namespace lightloom::test
