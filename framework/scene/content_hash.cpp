#include "framework/scene/content_hash.hpp"

#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"

namespace lightloom::scene {
namespace {

constexpr size_t kLongestPath = 4096;

std::string percent_decoded(const std::string& uri) {
  std::string decoded;
  for (size_t i = 0; i < uri.size(); ++i) {
    const bool escape = uri[i] == '%' && i + 2 < uri.size() && std::isxdigit(static_cast<unsigned char>(uri[i + 1])) &&
                        std::isxdigit(static_cast<unsigned char>(uri[i + 2]));
    decoded += escape ? static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16)) : uri[i];
    if (escape) i += 2;
  }
  return decoded;
}

/// The JSON of a scene file, a glTF file or a GLB container; empty for other files.
std::string_view json_of(std::string_view bytes) {
  constexpr size_t kGlbHeader = 20;
  if (bytes.starts_with("glTF") && bytes.size() > kGlbHeader) {
    size_t length = 0;
    for (size_t i = 0; i < 4; ++i) length |= size_t{static_cast<unsigned char>(bytes[12 + i])} << (8 * i);
    return bytes.substr(kGlbHeader, length);
  }
  const size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && bytes[first] == '{' ? bytes : std::string_view();
}

class ContentHasher {
 public:
  /// With `files`, they are hashed one by one instead of together.
  explicit ContentHasher(FileContents* files = nullptr) : files_(files) {}

  void add(const std::filesystem::path& file) {
    if (!seen_.insert(file.lexically_normal()).second) return;
    const std::string bytes = read_text_file(file);
    if (files_ != nullptr)
      files_->insert_or_assign(file, hash_text(bytes));
    else
      hasher_.text(bytes);
    add_named(nlohmann::ordered_json::parse(json_of(bytes), nullptr, false), file.parent_path());
  }
  [[nodiscard]] uint64_t value() const { return hasher_.value(); }

 private:
  /// A string that is the path of a file is taken for the name of one, but for the schema, which editors read.
  void add_named(const nlohmann::ordered_json& node, const std::filesystem::path& folder) {
    if (node.is_structured())
      for (const auto& [key, child] : node.items())
        if (key != "$schema") add_named(child, folder);
    if (!node.is_string()) return;
    const auto& text = node.get_ref<const std::string&>();
    if (text.empty() || text.size() > kLongestPath) return;
    for (const std::string& name : {text, percent_decoded(text)}) {
      std::error_code ignored;
      if (!std::filesystem::is_regular_file(folder / name, ignored)) continue;
      add(folder / name);
      return;
    }
  }

  FileContents* files_;
  Hasher hasher_;
  std::set<std::filesystem::path> seen_;
};

}  // namespace

uint64_t content_hash(const std::filesystem::path& scene_file) {
  ContentHasher hasher;
  hasher.add(scene_file);
  return hasher.value();
}

FileContents content_files(const std::filesystem::path& scene_file) {
  FileContents files{{scene_file, std::nullopt}};
  try {
    ContentHasher(&files).add(scene_file);
  } catch (const Error&) {
    // What cannot be read is there as empty, or not at all.
  }
  return files;
}

}  // namespace lightloom::scene
