#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/image.hpp"
#include "framework/gpu/pipeline.hpp"

namespace lightloom::gpu {

/// An image for a shader; `sampler` only for combined samplers.
struct ImageResource {
  ImageView view;
  VkSampler sampler = VK_NULL_HANDLE;
  VkImageLayout layout = VK_IMAGE_LAYOUT_GENERAL;
};
struct BufferResource {
  VkBuffer buffer = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;
  VkDeviceSize range = VK_WHOLE_SIZE;
};
struct SamplerResource {
  VkSampler sampler = VK_NULL_HANDLE;
};

/// The scene of ray queries.
struct AccelerationResource {
  VkAccelerationStructureKHR structure = VK_NULL_HANDLE;
};

/// What a name of a shader is bound to. A list is for an array of textures or blocks and has its length.
using Resource = std::variant<BufferResource, std::vector<BufferResource>, ImageResource, std::vector<ImageResource>,
                              SamplerResource, AccelerationResource>;
using ResourceMap = std::map<std::string, Resource, std::less<>>;

[[nodiscard]] Resource resource(const Buffer& buffer);
[[nodiscard]] Resource resource(const Image& image, VkSampler sampler = VK_NULL_HANDLE);
[[nodiscard]] Resource resource(const ImageView& view, VkSampler sampler = VK_NULL_HANDLE);

/// Gives the resource of a binding, or nullptr if there is none of that name.
using ResourceLookup = std::function<const Resource*(const Binding&)>;

/// Allocates and fills descriptor sets; its pools grow as needed.
class DescriptorAllocator {
 public:
  explicit DescriptorAllocator(const Device& device) : device_(device) {}

  /// The set of a pipeline, or VK_NULL_HANDLE if its shaders bind nothing. Valid until `reset`. Names in `resources`
  /// that the shader does not use are ignored. Throws Error(invalid_input), naming shader and binding, for a name
  /// without resource and for a resource that does not fit the shader (kind, dimension, numeric class, array length).
  [[nodiscard]] VkDescriptorSet allocate(const Pipeline& pipeline, const ResourceMap& resources);
  [[nodiscard]] VkDescriptorSet allocate(const Pipeline& pipeline, const ResourceLookup& lookup);
  /// Frees all sets; none may be in use by the device.
  void reset();

 private:
  static constexpr size_t kKinds = 7;  ///< of BindingKind
  using Counts = std::array<uint32_t, kKinds>;
  struct Pool {
    DescriptorPoolHandle handle;
    uint32_t free_sets = 0;
    Counts free{};
  };

  [[nodiscard]] VkDescriptorSet allocate_set(const Pipeline& pipeline);
  [[nodiscard]] Pool make_pool(const Counts& at_least) const;

  const Device& device_;
  std::vector<Pool> pools_;  ///< sets come from the last one
};

}  // namespace lightloom::gpu
