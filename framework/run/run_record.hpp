#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/graph/link.hpp"
#include "framework/run/shader_folders.hpp"

namespace lightloom::run {

/// LinkOptions as run.json keeps them.
[[nodiscard]] nlohmann::ordered_json link_record(const LinkOptions& options);
/// What link_record wrote. Throws nlohmann::json::exception for anything else.
[[nodiscard]] LinkOptions link_options_of(const nlohmann::ordered_json& record);

/// Hash of names and bytes of all files in the shader folders.
[[nodiscard]] uint64_t shaders_hash(const ShaderFolders& folders);

/// Where the values of a run's frames were dumped to.
class Dumps {
 public:
  Dumps() = default;
  /// `index` is dumps/index.json of a run folder.
  Dumps(std::filesystem::path folder, const nlohmann::ordered_json& index);

  [[nodiscard]] const std::vector<uint32_t>& frames() const { return frames_; }  ///< in which something was dumped
  /// File of a value, "pass.port[.part]", in a frame; empty if it was not dumped.
  [[nodiscard]] std::optional<std::filesystem::path> file(uint32_t frame, const std::string& value) const;
  /// frame.json of a frame.
  [[nodiscard]] nlohmann::ordered_json conditions(uint32_t frame) const;

 private:
  std::filesystem::path folder_;
  nlohmann::ordered_json index_;
  std::vector<uint32_t> frames_;
};

/// A run folder as `render` left it: what it was made from, to make a part of it again.
struct RecordedRun {
  std::filesystem::path folder;
  std::filesystem::path graph;  ///< file, as it was given
  std::string graph_text;       ///< of that file at the time of the run
  LinkOptions link;
  std::filesystem::path scene;  ///< file
  std::string scene_hash;       ///< scene::content_hash, in hex
  std::string camera;
  std::filesystem::path camera_path;  ///< file; empty for none
  nlohmann::ordered_json camera_path_record;
  uint32_t seed = 0;
  uint32_t first_frame = 0;
  double frames_per_second = 30;
  std::optional<double> frozen_time;
  std::string dump_format;
  std::string device;   ///< name, driver and id
  std::string program;  ///< version and commit
  std::string shaders;  ///< shaders_hash, in hex
  Dumps dumps;
};

/// Reads run.json and dumps/index.json. Paths that are relative, and not there from where the program runs now, are
/// those from where it ran. Throws Error(invalid_input) for a folder that is no finished run, or of a Lightloom that
/// did not record enough.
[[nodiscard]] RecordedRun read_run(const std::filesystem::path& folder);

}  // namespace lightloom::run
