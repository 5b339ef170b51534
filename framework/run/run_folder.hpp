#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/graph/graph.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/write_journal.hpp"
#include "framework/run/written_files.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// How 2D dumps are written; volumes are NumPy arrays in either case.
enum class DumpFormat : uint8_t { exr, npy };
[[nodiscard]] std::string to_string(DumpFormat format);

/// The folder that a render leaves behind (design, section 5):
///   NAME.FFFF.png      2D outputs of 8 bits (display-ready), NAME.FFFF.exr other 2D outputs, .npy volumes
///   dumps/FFFF/VALUE.exr | .npy, dumps/FFFF/frame.json (camera and time), and dumps/index.json, which says what each
///   of them is (docs/buffers.md)
///   checkpoint/        what --resume goes on from
///   run.json           provenance and times, and the list of all files of the run
/// Each file appears whole or not at all, and so do the files of a frame when the run fails. Files of an earlier run in
/// the same folder, which its run.json lists, stay until the first frame is whole: a run that fails before that leaves
/// them as they were (WriteJournal), and no stale frame stays among new ones. A run that is killed before that leaves
/// no run.json.
class RunFolder {
 public:
  /// Throws Error(run_failed) where the folder cannot be made or written.
  explicit RunFolder(std::filesystem::path folder, DumpFormat dump_format = DumpFormat::exr);
  /// Goes on with a run that was interrupted; `state` is what `state()` gave. Removes what was left half-written.
  RunFolder(std::filesystem::path folder, DumpFormat dump_format, const nlohmann::ordered_json& state);

  /// Writes the triangles that move (scene::Scene says which) to dumps/moving_triangles.npy: shape (n, 5, 1), corners
  /// a, b, c as indices into the scene's vertices, material, object. Each frame's positions of their vertices go to
  /// dumps/FFFF/moving_positions.npy, shape (n, 3, 1) [m]. Only of use with captures.
  void write_moving_triangles(const scene::Scene& scene);
  /// What every frame executes, as plan_json has it: `plan.json`.
  void write_plan(const nlohmann::ordered_json& plan);
  /// Writes the outputs, and, if the frame has captures, these with `conditions` as frame.json beside them.
  void write_frame(const Graph& graph, const FrameResult& result, const nlohmann::ordered_json& conditions);
  /// Writes the index of the dumps and `record` as run.json, with the list of files added.
  void finish(nlohmann::ordered_json record);

  /// What was written so far, for a checkpoint.
  [[nodiscard]] nlohmann::ordered_json state() const;
  /// Lists a file that something else wrote into the folder.
  void add_file(const std::filesystem::path& relative) { files_.add(relative); }
  /// Files of a run that was broken off, relative to the folder: they go like those of an earlier run.
  void replace(const std::vector<std::filesystem::path>& broken_off);
  /// What this run would leave behind if it were broken off now.
  [[nodiscard]] std::vector<std::filesystem::path> leftovers() const;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }
  /// Files written so far, relative to the folder.
  [[nodiscard]] const WrittenFiles& files() const { return files_; }

 private:
  void find_earlier_run();
  void begin_writing();
  void remove_earlier_run();
  void remove_half_written() const;
  void write_dumps(const Graph& graph, const FrameResult& result, const nlohmann::ordered_json& conditions);
  void write_json(const std::filesystem::path& relative, const nlohmann::ordered_json& json);
  void write_image(const std::filesystem::path& relative, const image::HostImage& image,
                   const std::vector<std::string>& channel_names);
  void write_frame_image(const std::string& before, uint32_t frame, const std::string& after,
                         const image::HostImage& image, const std::vector<std::string>& channel_names);
  [[nodiscard]] nlohmann::ordered_json dump_index() const;

  std::filesystem::path folder_;
  WriteJournal journal_;  ///< of the frame that is being written
  WrittenFiles files_;
  std::vector<std::filesystem::path> earlier_;  ///< files of the run before that are still there
  bool replaces_run_ = false;                   ///< the run.json of the run before is still there
  DumpFormat dump_format_;
  nlohmann::ordered_json dumped_values_ = nlohmann::ordered_json::object();  ///< by name
  nlohmann::ordered_json moving_;                                            ///< null where nothing moves
  bool has_positions_ = false;                                               ///< of what moves, in each dumped frame
  FrameRanges dumped_frames_;                                                ///< each with all of dumped_values_
};

}  // namespace lightloom::run
