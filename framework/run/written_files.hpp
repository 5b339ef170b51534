#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "framework/run/frame_ranges.hpp"

namespace lightloom::run {

/// Names of the files of a run, relative to its folder. Those of frames are kept as what stands before and behind the
/// frame's number, with the frames as ranges, so that long runs take no more memory than short ones.
class WrittenFiles {
 public:
  /// A file of the whole run; once, however often it is added.
  void add(const std::filesystem::path& file);
  /// BEFOREffffAFTER; frames of a name in ascending order.
  void add(const std::string& before, uint32_t frame, const std::string& after);

  /// Every name.
  [[nodiscard]] std::vector<std::filesystem::path> all() const;
  /// The last file of a frame that ends so; empty if there is none.
  [[nodiscard]] std::filesystem::path last_of_frames(const std::string& ending) const;

  [[nodiscard]] nlohmann::ordered_json json() const;
  /// Throws nlohmann::json::exception for what `json` did not make.
  explicit WrittenFiles(const nlohmann::ordered_json& json);
  WrittenFiles() = default;

 private:
  struct OfFrames {
    std::string before, after;
    FrameRanges frames;
  };
  std::vector<std::filesystem::path> single_;
  std::vector<OfFrames> of_frames_;
};

/// Frame number in file names: four digits or more.
[[nodiscard]] std::string frame_text(uint32_t frame);

}  // namespace lightloom::run
