#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

namespace lightloom::run {

/// Files of a run folder that belong together and are not all there yet. Until `commit`, files that they take the place
/// of are kept under hidden names; where it never comes, the end of the object removes the new files and puts the old
/// ones back, which takes no space on the disk.
class WriteJournal {
 public:
  /// `folder` must exist.
  explicit WriteJournal(std::filesystem::path folder);
  WriteJournal(const WriteJournal&) = delete;
  WriteJournal& operator=(const WriteJournal&) = delete;
  ~WriteJournal();

  /// To be called before each file is written: makes its folder and keeps what has its name so far. Throws
  /// Error(run_failed) where that fails, or where the run folder or its folder `dumps` is no longer the one that the
  /// run began with: a folder that is made anew would lack what was written before.
  void prepare(const std::filesystem::path& relative);
  /// Takes a file away until it is clear whether it goes for good. A missing one is as good.
  void set_aside(const std::filesystem::path& relative);
  /// What was prepared stays, what it took the place of goes.
  void commit();

 private:
  using Identity = std::pair<dev_t, ino_t>;
  static std::optional<Identity> identity_of(const std::filesystem::path& folder);
  void require_same(const std::filesystem::path& folder, const std::optional<Identity>& identity) const;
  void keep(const std::filesystem::path& relative);
  void roll_back();

  std::filesystem::path folder_;
  std::optional<Identity> identity_;
  std::optional<Identity> dumps_;  ///< once the run has made or used it
  std::vector<std::filesystem::path> new_;
  std::vector<std::pair<std::filesystem::path, std::filesystem::path>> old_;  ///< name, hidden name
};

}  // namespace lightloom::run
