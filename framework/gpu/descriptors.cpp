#include "framework/gpu/descriptors.hpp"

#include <algorithm>
#include <deque>
#include <span>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/descriptor_type.hpp"
#include "framework/gpu/format.hpp"
#include "framework/gpu/result.hpp"

namespace lightloom::gpu {
namespace {

constexpr uint32_t kSetsPerPool = 64;
constexpr uint32_t kDescriptorsPerKind = 512;

[[noreturn]] void fail(const Reflection& reflection, const Binding& binding, const std::string& what) {
  throw Error(ExitCode::invalid_input, "shader " + reflection.name + ": " + std::string(to_string(binding.kind)) + " " +
                                           in_quotes(binding.name) + " " + what);
}

ImageShape shape_of(VkImageViewType type) {
  switch (type) {
    case VK_IMAGE_VIEW_TYPE_2D:
      return ImageShape::d2;
    case VK_IMAGE_VIEW_TYPE_2D_ARRAY:
      return ImageShape::d2_array;
    case VK_IMAGE_VIEW_TYPE_3D:
      return ImageShape::d3;
    default:
      return ImageShape::other;
  }
}

std::string_view shape_text(ImageShape shape) {
  switch (shape) {
    case ImageShape::d2:
      return "2D";
    case ImageShape::d2_array:
      return "2D array";
    case ImageShape::d3:
      return "3D";
    case ImageShape::other:
      break;
  }
  return "other";
}

bool is_image(BindingKind kind) {
  return kind == BindingKind::sampled_image || kind == BindingKind::combined_sampler ||
         kind == BindingKind::storage_image;
}

/// Turns resources into the writes of one set, checking that each fits its binding.
class SetWriter {
 public:
  SetWriter(const Reflection& reflection, VkDescriptorSet set) : reflection_(reflection), set_(set) {}

  void add(const Binding& binding, const Resource& resource) {
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = binding.binding;
    write.descriptorCount = binding.count;
    write.descriptorType = descriptor_type(binding.kind);
    if (const auto* buffer = std::get_if<BufferResource>(&resource)) {
      write.pBufferInfo = buffer_infos(binding, std::span(buffer, 1));
    } else if (const auto* buffers = std::get_if<std::vector<BufferResource>>(&resource)) {
      write.pBufferInfo = buffer_infos(binding, *buffers);
    } else if (const auto* image = std::get_if<ImageResource>(&resource)) {
      write.pImageInfo = image_infos(binding, std::span(image, 1));
    } else if (const auto* images = std::get_if<std::vector<ImageResource>>(&resource)) {
      write.pImageInfo = image_infos(binding, *images);
    } else if (const auto* acceleration = std::get_if<AccelerationResource>(&resource)) {
      write.pNext = acceleration_info(binding, *acceleration);
    } else {
      write.pImageInfo = sampler_info(binding, std::get<SamplerResource>(resource));
    }
    writes_.push_back(write);
  }

  void write(const Device& device) const {
    vkUpdateDescriptorSets(device.get(), static_cast<uint32_t>(writes_.size()), writes_.data(), 0, nullptr);
  }

 private:
  const VkDescriptorBufferInfo* buffer_infos(const Binding& binding, std::span<const BufferResource> buffers) {
    if (binding.kind != BindingKind::uniform_buffer && binding.kind != BindingKind::storage_buffer)
      fail(reflection_, binding, "is given a buffer");
    check_count(binding, buffers.size());
    std::vector<VkDescriptorBufferInfo>& infos = buffers_.emplace_back();
    for (const BufferResource& buffer : buffers) {
      if (buffer.range != VK_WHOLE_SIZE && buffer.range < binding.block_size) {
        fail(reflection_, binding,
             "needs " + std::to_string(binding.block_size) + " bytes and is given a buffer of " +
                 std::to_string(buffer.range));
      }
      infos.push_back({buffer.buffer, buffer.offset, buffer.range});
    }
    return infos.data();
  }

  void check_count(const Binding& binding, size_t given) const {
    if (given == binding.count) return;
    fail(reflection_, binding,
         "has " + std::to_string(binding.count) + " elements and is given " + std::to_string(given));
  }

  void check_image(const Binding& binding, const ImageResource& image) const {
    const ImageShape shape = shape_of(image.view.type);
    if (shape != binding.shape) {
      fail(reflection_, binding,
           "is " + std::string(shape_text(binding.shape)) + " and is given a " + std::string(shape_text(shape)) +
               " image");
    }
    if (numeric_class(image.view.format) != binding.numeric) {
      const bool wants_uint = binding.numeric == NumericClass::unsigned_integer;
      fail(reflection_, binding,
           wants_uint ? "reads unsigned integers and is given an image of floating point numbers"
                      : "reads floating point numbers and is given an image of unsigned integers");
    }
    if (binding.format && vulkan_format(*binding.format) != image.view.format)
      fail(reflection_, binding,
           "names the format " + std::string(format_info(*binding.format).name) + " and is given another");
    if (binding.kind == BindingKind::combined_sampler && image.sampler == VK_NULL_HANDLE) {
      fail(reflection_, binding, "is given an image without a sampler");
    }
  }

  const VkDescriptorImageInfo* image_infos(const Binding& binding, std::span<const ImageResource> images) {
    if (!is_image(binding.kind)) fail(reflection_, binding, "is given an image");
    check_count(binding, images.size());
    std::vector<VkDescriptorImageInfo>& infos = images_.emplace_back();
    for (const ImageResource& image : images) {
      check_image(binding, image);
      const bool combined = binding.kind == BindingKind::combined_sampler;
      infos.push_back({combined ? image.sampler : VK_NULL_HANDLE, image.view.view, image.layout});
    }
    return infos.data();
  }

  const VkWriteDescriptorSetAccelerationStructureKHR* acceleration_info(const Binding& binding,
                                                                        const AccelerationResource& acceleration) {
    if (binding.kind != BindingKind::acceleration_structure || binding.count != 1)
      fail(reflection_, binding, "is given an acceleration structure");
    VkWriteDescriptorSetAccelerationStructureKHR& info = accelerations_.emplace_back();
    info.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR;
    info.accelerationStructureCount = 1;
    info.pAccelerationStructures = &acceleration.structure;
    return &info;
  }

  const VkDescriptorImageInfo* sampler_info(const Binding& binding, const SamplerResource& sampler) {
    if (binding.kind != BindingKind::sampler || binding.count != 1) fail(reflection_, binding, "is given a sampler");
    return images_.emplace_back(1, VkDescriptorImageInfo{sampler.sampler, VK_NULL_HANDLE, VK_IMAGE_LAYOUT_UNDEFINED})
        .data();
  }

  const Reflection& reflection_;
  VkDescriptorSet set_;
  std::vector<VkWriteDescriptorSet> writes_;
  // The writes point into these; a deque does not move what it holds.
  std::deque<std::vector<VkDescriptorBufferInfo>> buffers_;
  std::deque<std::vector<VkDescriptorImageInfo>> images_;
  std::deque<VkWriteDescriptorSetAccelerationStructureKHR> accelerations_;
};

}  // namespace

Resource resource(const Buffer& buffer) {
  return BufferResource{buffer.get(), 0, buffer.size()};
}
Resource resource(const Image& image, VkSampler sampler) {
  return resource(image.view(), sampler);
}
Resource resource(const ImageView& view, VkSampler sampler) {
  return ImageResource{.view = view, .sampler = sampler};
}

VkDescriptorSet DescriptorAllocator::allocate(const Pipeline& pipeline, const ResourceMap& resources) {
  return allocate(pipeline, [&](const Binding& binding) -> const Resource* {
    const auto found = resources.find(binding.name);
    return found == resources.end() ? nullptr : &found->second;
  });
}

VkDescriptorSet DescriptorAllocator::allocate(const Pipeline& pipeline, const ResourceLookup& lookup) {
  const Reflection& reflection = pipeline.reflection();
  if (reflection.bindings.empty()) return VK_NULL_HANDLE;
  const VkDescriptorSet set = allocate_set(pipeline);
  SetWriter writer(reflection, set);
  for (const Binding& binding : reflection.bindings) {
    const Resource* found = lookup(binding);
    if (found == nullptr) fail(reflection, binding, "is not provided");
    writer.add(binding, *found);
  }
  writer.write(device_);
  return set;
}

VkDescriptorSet DescriptorAllocator::allocate_set(const Pipeline& pipeline) {
  Counts needed{};
  for (const Binding& binding : pipeline.reflection().bindings) {
    needed[static_cast<size_t>(binding.kind)] += binding.count;
  }
  const auto fits = [&](const Pool& pool) {
    return pool.free_sets > 0 && std::equal(needed.begin(), needed.end(), pool.free.begin(), std::less_equal<>());
  };
  if (pools_.empty() || !fits(pools_.back())) pools_.push_back(make_pool(needed));
  Pool& pool = pools_.back();
  const VkDescriptorSetLayout layout = pipeline.set_layout();
  VkDescriptorSetAllocateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
  info.descriptorPool = pool.handle.get();
  info.descriptorSetCount = 1;
  info.pSetLayouts = &layout;
  VkDescriptorSet set = VK_NULL_HANDLE;
  check(vkAllocateDescriptorSets(device_.get(), &info, &set),
        "vkAllocateDescriptorSets for " + pipeline.reflection().name);
  --pool.free_sets;
  for (size_t i = 0; i < kKinds; ++i) pool.free[i] -= needed[i];
  return set;
}

DescriptorAllocator::Pool DescriptorAllocator::make_pool(const Counts& at_least) const {
  Pool pool;
  pool.free_sets = kSetsPerPool;
  std::vector<VkDescriptorPoolSize> sizes;
  for (size_t i = 0; i < kKinds; ++i) {
    // A device without ray queries does not know this type.
    if (static_cast<BindingKind>(i) == BindingKind::acceleration_structure && at_least[i] == 0) continue;
    pool.free[i] = std::max(at_least[i], kDescriptorsPerKind);
    sizes.push_back({descriptor_type(static_cast<BindingKind>(i)), pool.free[i]});
  }
  VkDescriptorPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
  info.maxSets = kSetsPerPool;
  info.poolSizeCount = static_cast<uint32_t>(sizes.size());
  info.pPoolSizes = sizes.data();
  VkDescriptorPool handle = VK_NULL_HANDLE;
  check(vkCreateDescriptorPool(device_.get(), &info, nullptr, &handle), "vkCreateDescriptorPool");
  pool.handle = DescriptorPoolHandle(device_.ref(), handle);
  return pool;
}

void DescriptorAllocator::reset() {
  pools_.clear();
}

}  // namespace lightloom::gpu
