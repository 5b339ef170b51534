#include "framework/base/file_watch.hpp"

#include <sys/stat.h>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom {

std::optional<uint64_t> content_of(const std::filesystem::path& file) {
  try {
    return hash_text(read_text_file(file));
  } catch (const Error&) {
    return std::nullopt;
  }
}

void FileWatch::watch(const FileContents& read) {
  std::map<std::filesystem::path, File> files;
  for (const auto& [path, contents] : read) {
    const auto known = files_.find(path);
    File& file = files[path];
    if (known != files_.end()) file = known->second;
    file.read = contents;
  }
  files_ = std::move(files);
}

FileWatch::Stamp FileWatch::stamp_of(const std::filesystem::path& file) {
  struct ::stat status {};
  if (::stat(file.c_str(), &status) != 0) return {};
  return {status.st_mtim.tv_sec, status.st_mtim.tv_nsec, static_cast<uintmax_t>(status.st_size), status.st_ino};
}

std::vector<std::filesystem::path> FileWatch::look() {
  std::vector<std::filesystem::path> changed;
  bool settled = true;
  for (auto& [path, file] : files_) {
    const Stamp stamp = stamp_of(path);
    if (file.stamp != stamp) {
      // At the first look there is nothing to compare with: a file that is as it was read is no cause to wait.
      const bool first = !file.stamp;
      file.stamp = stamp;
      file.seen.reset();
      if (first) file.seen = content_of(path);
      settled = settled && first && *file.seen == file.read;
      continue;
    }
    if (!file.seen) file.seen = content_of(path);
    if (*file.seen != file.read) changed.push_back(path);
  }
  if (!settled) changed.clear();
  return changed;
}

}  // namespace lightloom
