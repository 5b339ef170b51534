#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/scene/load_options.hpp"

namespace lightloom::scene {

/// Reads the files of one scene and keeps count of what they take. Used by one thread at a time.
class InputContext {
 public:
  explicit InputContext(const std::filesystem::path& main_file, const LoadOptions& options = {});

  [[nodiscard]] const Limits& limits() const { return options_.limits; }

  /// The whole of a regular file, or its first `count` bytes. Throws Error that begins with `wanted_by`, if given.
  [[nodiscard]] std::vector<uint8_t> read(const std::filesystem::path& file, const std::string& wanted_by,
                                          std::optional<uint64_t> count = std::nullopt);

  /// Where a glTF file in `folder` finds what a URI names: the file of that very name, else the one whose name is
  /// percent-encoded, as exporters disagree on that. Throws Error for URIs with a scheme, and for files that lie, with
  /// all symbolic links followed, neither below `folder` nor below that of the main file, unless that is allowed.
  [[nodiscard]] std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& uri,
                                              const std::string& wanted_by) const;

  /// Bytes of data URIs and of copies count as well.
  void spend_bytes(uint64_t count, const std::string& wanted_by);
  void spend_accessor_values(uint64_t count, const std::string& wanted_by);
  /// A new glTF file begins.
  void begin_asset() { accessor_values_ = 0; }
  /// Texels of textures, and one image more.
  void spend_image(uint64_t texels, const std::string& wanted_by);

 private:
  [[nodiscard]] bool is_inside(const std::filesystem::path& file, const std::filesystem::path& folder) const;

  LoadOptions options_;
  std::filesystem::path main_folder_;
  uint64_t bytes_ = 0;
  uint64_t accessor_values_ = 0;
  uint64_t images_ = 0;
  uint64_t texels_ = 0;
};

/// "%20" to " ".
[[nodiscard]] std::string percent_decode(const std::string& uri);

}  // namespace lightloom::scene
