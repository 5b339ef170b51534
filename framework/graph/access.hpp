#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <string_view>

namespace lightloom {

/// How a pass, an observer or the host touches a value. One table (access.cpp) is the only place that knows what each
/// means in Vulkan; nothing else in the framework names a pipeline stage or an access bit.
enum class Access : uint8_t {
  none,                  ///< never touched yet
  compute_sampled_read,  ///< texelFetch / texture in a compute shader
  compute_storage_read,
  compute_storage_write,
  compute_storage_read_write,  ///< atomics, read-modify-write
  fragment_sampled_read,
  fragment_storage_read_write,  ///< atomics from a draw
  color_attachment_write,
  depth_attachment_write,
  transfer_read,   ///< copy to a read-back buffer, input of a host pass
  transfer_write,  ///< clear, upload, output of a host pass
  host_read,
  frame_input_read,  ///< scene and frame buffers, read by any shader stage
  anything,          ///< whatever the device does; the two ends of a full barrier
};

struct AccessInfo {
  std::string_view name;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
  /// GENERAL throughout: history rings are sampled as one array image while their newest layer is being written.
  VkImageLayout layout;
  bool reads;
  bool writes;
};

[[nodiscard]] const AccessInfo& access_info(Access access);

}  // namespace lightloom
