#include "framework/scene/content_hash.hpp"

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/scene/gltf_uri.hpp"
#include "framework/scene/input_context.hpp"
#include "framework/scene/json_scan.hpp"

namespace lightloom::scene {
namespace {

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

enum class Role : uint8_t { scene_file, gltf, data };

class ContentHasher {
 public:
  /// With `files`, they are hashed one by one instead of together.
  ContentHasher(const std::filesystem::path& main_file, const LoadOptions& options, FileContents* files = nullptr)
      : context_(main_file, options), limits_(options.limits), files_(files) {}

  void add(const std::filesystem::path& file, Role role) {
    if (!seen_.insert(file.lexically_normal()).second) return;
    const std::string bytes = read_text_file(file, limits_.file_bytes);
    if (files_ != nullptr)
      files_->insert_or_assign(file, hash_text(bytes));
    else
      hasher_.text(bytes);
    if (role == Role::data) return;
    const std::string_view text = json_of(bytes);
    require_json_within(text, limits_, file.string());
    add_named(nlohmann::ordered_json::parse(text, nullptr, false), file.parent_path(), role);
  }
  [[nodiscard]] uint64_t value() const { return hasher_.value(); }

 private:
  /// Files that the loader would read under these keys, and no others: any string may happen to be a path.
  void add_named(const nlohmann::ordered_json& node, const std::filesystem::path& folder, Role role) {
    if (!node.is_structured()) return;
    for (const auto& [key, child] : node.items()) {
      const bool scene_file = role == Role::scene_file;
      const bool names_file = scene_file ? key == "gltf" || key == "image" : key == "uri";
      if (names_file && child.is_string()) {
        const auto& name = child.get_ref<const std::string&>();
        add_file(scene_file ? folder / name : resolved(folder, name), key == "gltf" ? Role::gltf : Role::data);
      } else {
        add_named(child, folder, role);
      }
    }
  }

  void add_file(const std::filesystem::path& file, Role role) {
    std::error_code ignored;
    if (!file.empty() && std::filesystem::is_regular_file(file, ignored)) add(file, role);
  }

  /// Empty for data URIs and for what the loader refuses to read, if it ever comes to read it.
  [[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& folder, const std::string& uri) const {
    try {
      return is_data_uri(uri) ? std::filesystem::path() : context_.resolve(folder, uri, "");
    } catch (const Error&) {
      return {};
    }
  }

  InputContext context_;
  Limits limits_;
  FileContents* files_;
  Hasher hasher_;
  std::set<std::filesystem::path> seen_;
};

Role role_of(const std::filesystem::path& scene_file) {
  return scene_file.extension() == ".json" ? Role::scene_file : Role::gltf;
}

}  // namespace

uint64_t content_hash(const std::filesystem::path& scene_file, const LoadOptions& options) {
  ContentHasher hasher(scene_file, options);
  hasher.add(scene_file, role_of(scene_file));
  return hasher.value();
}

FileContents content_files(const std::filesystem::path& scene_file, const LoadOptions& options) {
  FileContents files{{scene_file, std::nullopt}};
  try {
    ContentHasher(scene_file, options, &files).add(scene_file, role_of(scene_file));
  } catch (const Error&) {
    // What cannot be read is there as empty, or not at all.
  }
  return files;
}

}  // namespace lightloom::scene
