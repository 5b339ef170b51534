#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/run/frame_result.hpp"

namespace lightloom::run {

/// The folder that a render leaves behind (design, section 5):
///   NAME.FFFF.png      2D outputs of 8 bits (display-ready), NAME.FFFF.exr other 2D outputs, .npy volumes
///   dumps/FFFF/VALUE.exr | .npy, and dumps/index.json, which says what each of them is
///   run.json           provenance and times, and the list of all files of the run
/// Each file appears whole or not at all. Files of an earlier run in the same folder, which its run.json lists, are
/// removed first, so that no stale frame stays among new ones.
class RunFolder {
 public:
  /// Throws Error(run_failed) where the folder cannot be made or written.
  explicit RunFolder(std::filesystem::path folder);

  void write_frame(const Graph& graph, const FrameResult& result);
  /// Writes the index of the dumps and `record` as run.json, with the list of files added.
  void finish(nlohmann::ordered_json record);

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Files written so far, relative to the folder.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  void remove_earlier_run() const;
  void write_image(std::filesystem::path relative, const image::HostImage& image,
                   const std::vector<std::string>& channel_names);

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> files_;
  nlohmann::ordered_json dumps_ = nlohmann::ordered_json::array();
};

/// Frame number in file names: four digits or more.
[[nodiscard]] std::string frame_text(uint32_t frame);

}  // namespace lightloom::run
