#include "framework/base/file.hpp"

#include <cerrno>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/input_file.hpp"

namespace lightloom {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::invalid_input, "cannot read '" + path.string() + "': " + reason);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path, uint64_t most_bytes) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, std::generic_category().message(EISDIR));
  InputFile file(path);
  if (file.problem() == "does not exist") fail(path, std::generic_category().message(ENOENT));
  if (!file.problem().empty()) fail(path, "it " + file.problem());
  if (file.size() > most_bytes) {
    fail(path, "it has " + std::to_string(file.size()) + " bytes, expected at most " + std::to_string(most_bytes));
  }
  std::string text(static_cast<size_t>(file.size()), '\0');
  if (!file.read(text.data(), text.size())) fail(path, std::generic_category().message(EIO));
  return text;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder, error))
    throw Error(ExitCode::run_failed, "cannot make the folder '" + folder.string() + "': " +
                                          (error ? error.message() : std::string("a file of that name is in the way")));
}

}  // namespace lightloom
