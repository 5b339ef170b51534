#pragma once

#include <filesystem>
#include <string>

namespace lightloom {

/// While it is there, no other process has a lock on the folder: one writer at a time. Readers need none. The kernel
/// gives it back when the process ends, however it ends; on network file systems that do not know flock it protects
/// against processes of the same machine only.
class FolderLock {
 public:
  /// Makes the folder if it is missing. Throws Error(run_failed) where that cannot be, or where another process has the
  /// lock, with its id, machine and start: "another WORK is running in 'FOLDER' (process 123 on host, since …)".
  /// @param work  what locks it, in words: "render", "study"
  FolderLock(std::filesystem::path folder, const std::string& work);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  /// The lock's file goes, and a folder that the lock has made and nobody has put anything into.
  ~FolderLock();

  /// Name of the hidden file that is locked.
  static constexpr const char* kFile = ".lock";

 private:
  std::filesystem::path folder_;
  std::filesystem::path made_;  ///< the topmost folder that was made; empty: none
  int descriptor_ = -1;
};

}  // namespace lightloom
