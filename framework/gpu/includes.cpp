#include "framework/gpu/includes.hpp"

#include <algorithm>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/base/hash.hpp"
#include "framework/base/text.hpp"

namespace lightloom::gpu {
namespace {

constexpr std::string_view kSpace = " \t";
constexpr size_t kDeepest = 100;  ///< files, each included by the one before

std::string_view skip_space(std::string_view text) {
  const size_t start = text.find_first_not_of(kSpace);
  return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

/// The name in a line `#include "name"`, or empty.
std::string included_name(std::string_view line) {
  line = skip_space(line);
  if (!line.starts_with('#')) return {};
  line = skip_space(line.substr(1));
  constexpr std::string_view kDirective = "include";
  if (!line.starts_with(kDirective)) return {};
  line = skip_space(line.substr(kDirective.size()));
  if (!line.starts_with('"')) return {};
  line.remove_prefix(1);
  const size_t end = line.find('"');
  return end == std::string_view::npos ? std::string{} : std::string(line.substr(0, end));
}

class Collector {
 public:
  Collector(std::span<const std::filesystem::path> directories, FileContents& files)
      : directories_(directories), files_(files) {}

  void follow(const std::string& name, std::string_view text) {
    chain_.push_back(name);
    text = without_mark(text);
    while (!text.empty()) {
      const size_t end = std::min(text.find_first_of("\r\n"), text.size());
      const std::string included = included_name(text.substr(0, end));
      if (!included.empty()) enter(included);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    chain_.pop_back();
  }

  [[nodiscard]] IncludeTexts take() { return std::move(texts_); }

 private:
  void enter(const std::string& name) {
    const auto open = std::find(chain_.begin(), chain_.end(), name);
    if (open != chain_.end()) {
      std::vector<std::string> cycle(open, chain_.end());
      cycle.push_back(name);
      throw Error(ExitCode::invalid_input, "shader files include each other in a cycle: " + join(cycle, " -> "),
                  "move what both need into a file of its own");
    }
    if (texts_.contains(name)) return;
    if (chain_.size() > kDeepest) {
      throw Error(ExitCode::invalid_input, "shader " + in_quotes(chain_.front()) + " includes files nested more than " +
                                               std::to_string(kDeepest) + " deep, the last of them " + in_quotes(name));
    }
    const std::filesystem::path file = find_file(name, directories_);
    if (file.empty()) return note_file(name, directories_, std::nullopt, files_);
    const std::string& text = texts_.emplace(name, read_text_file(file, kMostShaderBytes)).first->second;
    note_file(name, directories_, text, files_);
    follow(name, text);
  }

  std::span<const std::filesystem::path> directories_;
  FileContents& files_;
  IncludeTexts texts_;
  std::vector<std::string> chain_;
};

}  // namespace

std::string_view without_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
  return text;
}

std::filesystem::path find_file(const std::string& name, std::span<const std::filesystem::path> directories) {
  std::error_code ignored;
  for (const std::filesystem::path& directory : directories) {
    std::filesystem::path file = directory / name;
    if (std::filesystem::is_regular_file(file, ignored)) return file;
  }
  return {};
}

void note_file(const std::string& name, std::span<const std::filesystem::path> directories,
               const std::optional<std::string>& text, FileContents& files) {
  const std::filesystem::path found = text ? find_file(name, directories) : std::filesystem::path();
  for (const std::filesystem::path& directory : directories) {
    std::filesystem::path file = directory / name;
    if (file == found) {
      files.insert_or_assign(std::move(file), hash_text(*text));
      return;
    }
    files.insert_or_assign(std::move(file), std::nullopt);
  }
}

IncludeTexts collect_includes(std::span<const ShaderSource> sources, std::span<const std::filesystem::path> directories,
                              FileContents& files) {
  Collector collector(directories, files);
  for (const ShaderSource& source : sources) collector.follow(source.name, source.text);
  return collector.take();
}

}  // namespace lightloom::gpu
