#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "framework/run/executor_state.hpp"
#include "framework/run/run_progress.hpp"

namespace lightloom::run {

/// A run after some of its frames: what it takes to go on, bit for bit as if it had never stopped.
struct Checkpoint {
  nlohmann::ordered_json identity;  ///< name and text of each thing that the bits depend on
  nlohmann::ordered_json folder;    ///< RunFolder::state
  RunProgress progress;
  ExecutorState state;
};

/// Where a run folder keeps it, relative to the folder.
[[nodiscard]] std::filesystem::path checkpoint_file();

/// Writes it whole or not at all, over the one before. Throws Error(run_failed).
void write_checkpoint(const std::filesystem::path& run_folder, const Checkpoint& checkpoint);

/// The last one of a run folder; empty if it has none. Throws Error(invalid_input) for a file that is broken or of
/// another version.
[[nodiscard]] std::optional<Checkpoint> read_checkpoint(const std::filesystem::path& run_folder);

/// Throws Error(invalid_input) that names all that differs, with the text then and now.
void require_same_run(const std::filesystem::path& run_folder, const nlohmann::ordered_json& saved,
                      const nlohmann::ordered_json& current);

}  // namespace lightloom::run
