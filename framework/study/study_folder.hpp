#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/folder_lock.hpp"
#include "framework/image/host_image.hpp"
#include "framework/study/render_cell.hpp"
#include "framework/study/tonemap.hpp"

namespace lightloom::study {

/// What is kept of a rendered cell.
struct CellRecord {
  CellTimes times;
  std::vector<uint32_t> frame_numbers;  ///< kept frames
  uint32_t jobs = 1;                    ///< cells that ran at the same time
  double seconds = 0;                   ///< all of it
  std::vector<std::string> warnings;
};

/// A reference for one view: linear radiance of the judged frames.
struct ReferenceRecord {
  std::vector<uint32_t> frame_numbers;
  double relmse = 0;  ///< its own noise, by its standard error; 0 where unknown
  bool noise_known = false;
  std::string note;
};

/// By the names of metric_names().
using MetricValues = std::map<std::string, double>;

/// The folder of a study: finished cells and references. Each appears whole or not at all, whenever the program is
/// killed: it is written aside and renamed. One program at a time has the folder; a second is refused.
class StudyFolder {
 public:
  /// Makes the folder. Throws Error(run_failed) where that cannot be, or where another program has it.
  explicit StudyFolder(std::filesystem::path folder);
  StudyFolder(const StudyFolder&) = delete;
  StudyFolder& operator=(const StudyFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

  [[nodiscard]] bool has_cell(const std::string& key) const;
  void save_cell(const std::string& key, const Rendering& rendering, const CellRecord& record,
                 const ToneMap& how) const;
  /// Empty where there is none, or it cannot be read: then it is to be rendered again.
  [[nodiscard]] std::optional<CellRecord> load_cell(const std::string& key) const;
  [[nodiscard]] image::HostImage load_radiance(const std::string& key, uint32_t frame) const;
  [[nodiscard]] std::filesystem::path picture(const std::string& key) const;
  [[nodiscard]] std::filesystem::path heat_map(const std::string& key, const std::string& reference) const;
  /// Forgets every cell and reference.
  void clear() const;

  /// Errors of a cell against a reference.
  void save_metrics(const std::string& key, const std::string& reference, const MetricValues& values) const;
  [[nodiscard]] std::optional<MetricValues> load_metrics(const std::string& key, const std::string& reference) const;

  void save_reference(const std::string& key, const std::vector<image::HostImage>& radiance,
                      const ReferenceRecord& record) const;
  [[nodiscard]] std::optional<ReferenceRecord> load_reference(const std::string& key) const;
  [[nodiscard]] image::HostImage load_reference_radiance(const std::string& key, uint32_t frame) const;

 private:
  void remove_leftovers() const;

  std::filesystem::path folder_;
  FolderLock lock_;
};

/// An EXR file of colours as rgba32_sfloat. Throws Error(invalid_input).
[[nodiscard]] image::HostImage read_radiance(const std::filesystem::path& file);

}  // namespace lightloom::study
