#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/buffer.hpp"

namespace lightloom::gpu {

/// What the buffers of triangles and instances need among their usages.
constexpr VkBufferUsageFlags kBuildInputUsage =
    VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

/// Triangles that make up one geometry of a bottom-level structure. The buffers are read at each build.
struct TriangleGeometry {
  const Buffer* vertices = nullptr;  ///< a vertex starts with its position, three floats
  VkDeviceSize vertex_stride = 0;    ///< [bytes]
  uint32_t vertex_count = 0;
  const Buffer* indices = nullptr;  ///< three uint32 a triangle
  uint32_t first_triangle = 0;      ///< in `indices`
  uint32_t triangle_count = 0;
  bool opaque = true;  ///< if not, the shader decides for each triangle that a ray meets
};

/// How often a structure is built: once, so that rays are fast, or again and again, so that building is.
enum class Rebuilding : uint8_t { never, often };

/// A bottom- or top-level acceleration structure with its memory (VK_KHR_acceleration_structure).
class AccelerationStructure {
 public:
  /// A bottom-level structure. Throws Error(invalid_input) for more triangles than the device takes.
  AccelerationStructure(const Device& device, std::span<const TriangleGeometry> geometries, Rebuilding rebuilding,
                        const std::string& name);
  /// A top-level structure over `count` VkAccelerationStructureInstanceKHR in `instances`; there may be none.
  AccelerationStructure(const Device& device, const Buffer& instances, uint32_t count, Rebuilding rebuilding,
                        const std::string& name);
  ~AccelerationStructure();
  AccelerationStructure(const AccelerationStructure&) = delete;
  AccelerationStructure& operator=(const AccelerationStructure&) = delete;

  [[nodiscard]] VkAccelerationStructureKHR get() const { return structure_; }
  /// What an instance refers to.
  [[nodiscard]] VkDeviceAddress address() const;
  [[nodiscard]] VkDeviceSize bytes() const;  ///< device memory, that for building included

  /// Records a build from what the buffers hold then; barriers are the caller's.
  void record_build(VkCommandBuffer commands) const;
  /// Frees the memory for building, when no build is under way and none will follow.
  void release_scratch() { scratch_.reset(); }

 private:
  void create(const Device& device, const std::string& name);
  [[nodiscard]] VkAccelerationStructureBuildGeometryInfoKHR build_info() const;

  VkDevice device_ = VK_NULL_HANDLE;
  const bool* hangs_ = nullptr;  ///< DeviceRef::hangs
  VkAccelerationStructureTypeKHR type_ = VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR;
  Rebuilding rebuilding_ = Rebuilding::never;
  std::vector<VkAccelerationStructureGeometryKHR> geometries_;
  std::vector<VkAccelerationStructureBuildRangeInfoKHR> ranges_;
  std::optional<Buffer> storage_;
  std::optional<Buffer> scratch_;
  VkDeviceAddress scratch_address_ = 0;
  VkAccelerationStructureKHR structure_ = VK_NULL_HANDLE;
};

/// An untransformed instance of a bottom-level structure; `custom_index` has 24 bits.
[[nodiscard]] VkAccelerationStructureInstanceKHR make_instance(const AccelerationStructure& structure,
                                                               uint32_t custom_index);

}  // namespace lightloom::gpu
