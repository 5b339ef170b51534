#include "framework/run/write_journal.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"

namespace lightloom::run {
namespace {

namespace fs = std::filesystem;

/// RunFolder clears such names away when their process is gone.
fs::path hidden_name(const fs::path& file) {
  return file.parent_path() / (".old-" + file.filename().string() + "." + std::to_string(::getpid()));
}

}  // namespace

WriteJournal::WriteJournal(fs::path folder) : folder_(std::move(folder)), identity_(identity_of(folder_)) {}

WriteJournal::~WriteJournal() {
  roll_back();
}

std::optional<WriteJournal::Identity> WriteJournal::identity_of(const fs::path& folder) {
  struct stat info {};
  if (::stat(folder.c_str(), &info) != 0) return std::nullopt;
  return Identity{info.st_dev, info.st_ino};
}

void WriteJournal::require_same(const fs::path& folder, const std::optional<Identity>& identity) const {
  if (identity_of(folder) == identity) return;
  throw Error(ExitCode::run_failed,
              "cannot go on writing into '" + folder_.string() + "': the folder '" + folder.string() +
                  "' was removed or replaced while the run was writing into it",
              "leave the run folder alone until the run has ended");
}

void WriteJournal::prepare(const fs::path& relative) {
  require_same(folder_, identity_);
  const bool is_dump = *relative.begin() == "dumps";
  if (is_dump && dumps_) require_same(folder_ / "dumps", dumps_);
  make_folder((folder_ / relative).parent_path());
  if (is_dump) dumps_ = identity_of(folder_ / "dumps");
  std::error_code ignored;
  if (std::find(new_.begin(), new_.end(), relative) != new_.end()) return;
  if (!fs::is_directory(folder_ / relative, ignored)) keep(relative);
  new_.push_back(relative);
}

void WriteJournal::set_aside(const fs::path& relative) {
  const fs::path file = folder_ / relative;
  const fs::path hidden = hidden_name(file);
  if (::rename(file.c_str(), hidden.c_str()) == 0) {
    old_.emplace_back(file, hidden);
  } else if (errno != ENOENT) {
    throw Error(ExitCode::run_failed,
                "cannot replace '" + file.string() + "': " + std::generic_category().message(errno));
  }
}

void WriteJournal::keep(const fs::path& relative) {
  const fs::path file = folder_ / relative;
  const fs::path hidden = hidden_name(file);
  ::unlink(hidden.c_str());
  // A second name, so that whoever looks at the file sees it until the new one is there.
  if (::link(file.c_str(), hidden.c_str()) == 0)
    old_.emplace_back(file, hidden);
  else if (errno != ENOENT)
    set_aside(relative);  // file systems without links
}

void WriteJournal::commit() {
  std::error_code ignored;
  for (const auto& [file, hidden] : old_) fs::remove(hidden, ignored);
  old_.clear();
  new_.clear();
}

void WriteJournal::roll_back() {
  // What stands there by now may be another's.
  if (identity_of(folder_) != identity_) return;
  std::error_code ignored;
  for (const fs::path& file : new_) {
    if (!fs::is_directory(folder_ / file, ignored)) fs::remove(folder_ / file, ignored);
  }
  for (const auto& [file, hidden] : old_) fs::rename(hidden, file, ignored);
  // Folders go only when they are empty.
  for (const fs::path& file : new_)
    for (fs::path at = file.parent_path(); !at.empty() && fs::remove(folder_ / at, ignored);) at = at.parent_path();
}

}  // namespace lightloom::run
