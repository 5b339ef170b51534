#include "framework/base/file.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ExitCode::invalid_input, "cannot read '" + path.string() + "': " + reason);
}

}  // namespace

std::string read_text_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) fail(path, std::generic_category().message(EISDIR));
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) fail(path, std::generic_category().message(errno != 0 ? errno : EIO));
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (stream.bad()) fail(path, std::generic_category().message(EIO));
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
