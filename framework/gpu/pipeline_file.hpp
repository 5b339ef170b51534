#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "framework/gpu/device.hpp"
#include "framework/gpu/handle.hpp"

namespace lightloom::gpu {

/// Whose pipelines a file holds: no other driver, nor another version of it, may be given them.
struct PipelineFileOwner {
  uint32_t vendor = 0;
  uint32_t device = 0;
  uint32_t driver_version = 0;
  std::array<uint8_t, VK_UUID_SIZE> cache_uuid{};
  bool operator==(const PipelineFileOwner&) const = default;
};
[[nodiscard]] PipelineFileOwner pipeline_file_owner(const Device& device);

/// A file's bytes: magic, owner, size and hash, then `data` as vkGetPipelineCacheData gave it.
[[nodiscard]] std::string encode_pipeline_file(const PipelineFileOwner& owner, std::string_view data);
/// The driver's data in a file's bytes. Throws Error(invalid_input) that says what is wrong unless these are whole, of
/// this owner, and their data begins as Vulkan prescribes.
[[nodiscard]] std::string_view decode_pipeline_file(std::string_view bytes, const PipelineFileOwner& owner);

struct PipelineFileStatistics {
  size_t loaded_bytes = 0;    ///< that the driver was given; 0: none
  std::string rejected;       ///< why a file that was there was not used; empty if it was, or there was none
  uint32_t written = 0;       ///< how often the file was
  std::string write_failure;  ///< why it could not be written the last time; empty if it could
};

/// The driver's cache of compiled pipelines, kept in a folder from one process to the next: one file for each device
/// and version of its driver. What cannot be used is made anew; nothing about it ends a run. Of two processes that
/// write, the last one's file stays, whole. One thread at a time.
class PipelineFile {
 public:
  /// `directory` is made when first written to; empty: no file, and no cache.
  PipelineFile(const Device& device, const std::filesystem::path& directory);
  /// For vkCreate*Pipelines; VK_NULL_HANDLE where there is none.
  [[nodiscard]] VkPipelineCache get() const { return cache_.get(); }
  /// Writes what the driver has by now, if that is other than what is in the file.
  void save() noexcept;
  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const PipelineFileStatistics& statistics() const { return statistics_; }

 private:
  void create(std::string_view data);
  [[nodiscard]] std::string driver_data() const;

  DeviceRef device_;
  PipelineFileOwner owner_;
  std::filesystem::path file_;
  PipelineCacheHandle cache_;
  uint64_t hash_on_disk_ = 0;
  PipelineFileStatistics statistics_;
};

}  // namespace lightloom::gpu
