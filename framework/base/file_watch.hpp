#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace lightloom {

/// What was read of files: by path, the hash of the contents (hash_text), or empty where there was no file.
using FileContents = std::map<std::filesystem::path, std::optional<uint64_t>>;

/// The same of a file as it is now; empty where there is none that can be read.
[[nodiscard]] std::optional<uint64_t> content_of(const std::filesystem::path& file);

/// Tells when files no longer hold what was read of them, by looking again and again: editors that replace a file
/// rather than write into it, and file systems without notices, make no difference.
class FileWatch {
 public:
  /// From now on it is about these files. Contents that changed after they were read are found as well.
  void watch(const FileContents& read);
  /// Looks once. Returns the files whose contents differ, but none while some file is not yet the same as at the last
  /// look, as someone may be writing it.
  [[nodiscard]] std::vector<std::filesystem::path> look();
  [[nodiscard]] size_t size() const { return files_.size(); }

 private:
  /// Tells without reading whether a file was written.
  struct Stamp {
    int64_t seconds = 0;
    int64_t nanoseconds = 0;
    uintmax_t size = 0;
    uint64_t inode = 0;  ///< 0: there is no file
    bool operator==(const Stamp&) const = default;
  };
  struct File {
    std::optional<uint64_t> read;
    std::optional<Stamp> stamp;                   ///< at the last look
    std::optional<std::optional<uint64_t>> seen;  ///< contents at that stamp, once they were looked at
  };
  [[nodiscard]] static Stamp stamp_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, File> files_;
};

}  // namespace lightloom
