#include "framework/scene/input_context.hpp"

#include <algorithm>
#include <cctype>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/input_file.hpp"
#include "framework/base/text.hpp"

namespace lightloom::scene {
namespace {

constexpr size_t kLongestPath = 4096;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// RFC 3986, 3.1: a letter, then letters, digits, '+', '-' and '.', then ':'.
bool has_scheme(const std::string& uri) {
  const size_t colon = uri.find(':');
  if (colon == 0) return true;
  if (colon == std::string::npos || std::isalpha(static_cast<unsigned char>(uri[0])) == 0) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
  });
}

[[noreturn]] void refuse(const std::string& wanted_by, const std::string& sentence, std::string hint = {}) {
  throw Error(ExitCode::invalid_input, (wanted_by.empty() ? "" : wanted_by + ": ") + sentence, std::move(hint));
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  return folder.empty() ? "." : folder;
}

}  // namespace

std::string percent_decode(const std::string& uri) {
  std::string decoded;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 && hex_digit(uri[i + 2]) >= 0) {
      decoded += static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2]));
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

InputContext::InputContext(const std::filesystem::path& main_file, const LoadOptions& options)
    : options_(options), main_folder_(folder_of(main_file)) {}

std::vector<uint8_t> InputContext::read(const std::filesystem::path& path, const std::string& wanted_by,
                                        std::optional<uint64_t> count) {
  InputFile file(path);
  const std::string name = "the file " + path.string();
  if (!file.problem().empty()) refuse(wanted_by, name + " " + file.problem());
  const uint64_t wanted = std::min(file.size(), count.value_or(file.size()));
  require_within(limits(), &Limits::file_bytes, (wanted_by.empty() ? "" : wanted_by + ": ") + name, wanted);
  spend_bytes(wanted, wanted_by.empty() ? name : wanted_by);
  std::vector<uint8_t> bytes(static_cast<size_t>(wanted));
  if (!file.read(bytes.data(), bytes.size())) refuse(wanted_by, name + " cannot be read");
  return bytes;
}

std::filesystem::path InputContext::resolve(const std::filesystem::path& folder, const std::string& uri,
                                            const std::string& wanted_by) const {
  if (has_scheme(uri))
    refuse(wanted_by, "is " + in_quotes(uri) + ", expected a path relative to the file or a data URI");
  const std::string decoded = percent_decode(uri);
  const bool control = std::any_of(decoded.begin(), decoded.end(), [](unsigned char c) { return c < 0x20; });
  if (uri.empty() || uri.size() > kLongestPath || control) {
    refuse(wanted_by, "is " + in_quotes(uri) + ", expected a path of at most " + std::to_string(kLongestPath) +
                          " bytes without control characters");
  }
  std::error_code ignored;
  const std::filesystem::path literal = folder / uri;
  const std::filesystem::path file = std::filesystem::is_regular_file(literal, ignored) ? literal : folder / decoded;
  if (!options_.allow_outside && !is_inside(file, folder) && !is_inside(file, main_folder_)) {
    refuse(wanted_by,
           "is " + in_quotes(uri) + ", which lies outside of the folder '" + folder.string() +
               "', expected a file in it or below it",
           "--allow-outside lets scenes name files anywhere; use it with scenes that you trust");
  }
  return file;
}

bool InputContext::is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) const {
  std::error_code error;
  const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, error);
  if (error) return false;
  const std::filesystem::path place = std::filesystem::weakly_canonical(file, error);
  if (error) return false;
  return std::mismatch(root.begin(), root.end(), place.begin(), place.end()).first == root.end();
}

void InputContext::spend_bytes(uint64_t count, const std::string& wanted_by) {
  bytes_ = add_saturated(bytes_, count);
  require_within(limits(), &Limits::total_bytes, wanted_by + ": all that was read for the scene", bytes_);
}

void InputContext::spend_accessor_values(uint64_t count, const std::string& wanted_by) {
  accessor_values_ = add_saturated(accessor_values_, count);
  require_within(limits(), &Limits::accessor_values, wanted_by + ": with what was read before, the file",
                 accessor_values_);
}

void InputContext::spend_image(uint64_t texels, const std::string& wanted_by) {
  ++images_;
  texels_ = add_saturated(texels_, texels);
  require_within(limits(), &Limits::images, wanted_by + ": the scene", images_);
  require_within(limits(), &Limits::texture_texels, wanted_by + ": with the images before, the scene", texels_);
}

}  // namespace lightloom::scene
