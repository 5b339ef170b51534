#include "framework/run/placeholders.hpp"

#include "framework/base/error.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

Placeholders::Placeholders(gpu::Device& device) {
  for (const Dimension dimension : {Dimension::d2, Dimension::d3})
    for (const VkFormat format : {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32_UINT})
      images_.emplace_back(device, gpu::ImageSpec{.format = format,
                                                  .dimension = dimension,
                                                  .extent = {1, 1, 1},
                                                  .layers = 1,
                                                  .mip_levels = 1,
                                                  .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                                  .name = "unconnected input"});
  device.run_commands([&](VkCommandBuffer commands) {
    for (const gpu::Image& image : images_) {
      gpu::record_layout_change(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
      record_clear(commands, image, VK_REMAINING_ARRAY_LAYERS, {});
    }
    gpu::record_full_barrier(commands);
  });
}

gpu::ImageView Placeholders::view(const gpu::Binding& binding) const {
  const size_t numeric = binding.numeric == NumericClass::unsigned_integer ? 1 : 0;
  switch (binding.shape) {
    case gpu::ImageShape::d2:
      return images_[numeric].layer_view(0);
    case gpu::ImageShape::d2_array:
      return images_[numeric].array_view();
    case gpu::ImageShape::d3:
      return images_[2 + numeric].view();
    case gpu::ImageShape::other:
      break;
  }
  throw Error(ExitCode::run_failed,
              "the optional input '" + binding.name + "' has a shape that cannot be left unconnected");
}

}  // namespace lightloom::run
