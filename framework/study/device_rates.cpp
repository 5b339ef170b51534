#include "framework/study/device_rates.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "framework/gpu/format.hpp"
#include "framework/gpu/image.hpp"
#include "framework/gpu/memory.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/study/rate_meter.hpp"

namespace lightloom::study {
namespace {

constexpr uint64_t kCached = 256 << 10, kLarge = 48 << 20;  ///< bytes of one buffer of a copy
constexpr uint32_t kFetches = 64;                           ///< of each invocation
constexpr std::array<uint32_t, 2> kRays = {160, 120};       ///< invocations of a layer of fetches
constexpr uint32_t kLeastPicture = 64;

gpu::Image ready_image(gpu::Device& device, const gpu::ImageSpec& spec, const ClearColor& color) {
  gpu::Image image(device, spec);
  device.run_commands([&](VkCommandBuffer commands) {
    gpu::record_layout_change(commands, image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    VkClearColorValue value{};  // for integers, the bits of floats are as good as any
    std::copy(color.begin(), color.end(), std::begin(value.float32));
    const VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdClearColorImage(commands, image.get(), VK_IMAGE_LAYOUT_GENERAL, &value, 1, &range);
    gpu::record_full_barrier(commands);
  });
  return image;
}

gpu::ImageSpec picture_spec(Format format, const Extent3& extent) {
  constexpr VkImageUsageFlags kUsage =
      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return {.format = gpu::vulkan_format(format), .extent = extent, .usage = kUsage, .name = "rate of a format"};
}

bool can_store(const gpu::Device& device, Format format) {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(device.physical(), gpu::vulkan_format(format), &properties);
  return (properties.optimalTilingFeatures & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) != 0;
}

double copy_rate(RateMeter& meter, uint64_t bytes, bool by_shader) {
  const auto buffer = [&](const char* name) {
    return gpu::Buffer(meter.device(), bytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, gpu::MemoryKind::device, name);
  };
  const gpu::Buffer from = buffer("copied from"), to = buffer("copied to");
  meter.device().run_commands(
      [&](VkCommandBuffer commands) { vkCmdFillBuffer(commands, from.get(), 0, VK_WHOLE_SIZE, 1); });
  const double moved = 2.0 * static_cast<double>(bytes);
  if (!by_shader) {
    const VkBufferCopy copy{0, 0, bytes};
    return moved * meter.per_second(
                       [&](VkCommandBuffer commands) { vkCmdCopyBuffer(commands, from.get(), to.get(), 1, &copy); });
  }
  const auto count = static_cast<uint32_t>(bytes / 16);
  return moved * meter.per_second({.shader = "copy.comp",
                                   .constants = {},
                                   .params = {{"count", count}},
                                   .resources = {{"Source", gpu::resource(from)}, {"Target", gpu::resource(to)}},
                                   .invocations = {count, 1}});
}

/// Loads from images of a format and stores to them, one kernel for both.
double texel_rate(RateMeter& meter, const char* shader, Format format, const Extent3& extent) {
  constexpr uint32_t kTexels = 8;  // of an invocation, as in the shaders
  const bool is_unsigned = format_info(format).numeric == NumericClass::unsigned_integer;
  const gpu::Image image = ready_image(meter.device(), picture_spec(format, extent), {0.25f, 0.5f, 0.75f, 1});
  const gpu::Image other =
      ready_image(meter.device(), picture_spec(is_unsigned ? Format::rgba8_unorm : Format::r32_uint, {}), {});
  const uint32_t rows = extent.height / kTexels;
  return static_cast<double>(extent.width) * rows * kTexels *
         meter.per_second({.shader = shader,
                           .constants = {{"unsigned_texels", is_unsigned}},
                           .params = {},
                           .resources = {{"texels", gpu::resource(is_unsigned ? other : image)},
                                         {"unsigned_image", gpu::resource(is_unsigned ? image : other)}},
                           .invocations = {extent.width, rows}});
}

FetchRates fetch_rates(RateMeter& meter, uint32_t side) {
  const gpu::Image volume = ready_image(meter.device(),
                                        {.format = VK_FORMAT_R8_UNORM,
                                         .dimension = Dimension::d3,
                                         .extent = {side, side, side},
                                         .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT,
                                         .name = "volume of " + std::to_string(side)},
                                        {2.0f / 255, 0, 0, 0});  // a middling clearance
  const auto rate = [&](bool scattered) {
    return static_cast<double>(kRays[0]) * kRays[1] * kFetches *
           meter.per_second({.shader = "fetch.comp",
                             .constants = {{"scattered", scattered}},
                             .params = {{"fetches", kFetches}},
                             .resources = {{"volume", gpu::resource(volume)}},
                             .invocations = kRays});
  };
  return {.side = side, .marching = rate(false), .scattered = rate(true)};
}

bool has_room(const gpu::Device& device, uint32_t side) {
  const uint64_t bytes = uint64_t{side} * side * side;
  const uint64_t limit = device.info().max_allocation_bytes;
  return side <= device.info().limits.maxImageDimension3D && (limit == 0 || bytes <= limit) &&
         bytes < gpu::available_bytes(device) / 2;
}

double arithmetic_rate(RateMeter& meter) {
  constexpr uint32_t kRounds = 256, kOperations = 64, kInvocations = 4096;
  return static_cast<double>(kRounds) * kOperations * kInvocations *
         meter.per_second({.shader = "arithmetic.comp",
                           .constants = {},
                           .params = {{"rounds", kRounds}, {"factor", 0.999f}, {"term", 0.001f}},
                           .resources = {},
                           .invocations = {kInvocations, 1}});
}

RateKernel nothing(std::array<uint32_t, 2> invocations) {
  return {.shader = "nothing.comp",
          .constants = {},
          .params = {{"never", UINT32_MAX}},
          .resources = {},
          .invocations = invocations};
}

}  // namespace

double CopyRates::best() const {
  return std::max(in_memory, transfer);
}

DeviceRates measure_rates(gpu::Device& device, run::ShaderLibrary& library, const Extent3& picture,
                          const std::set<Format>& formats) {
  RateMeter meter(device, library);
  const Extent3 extent{std::max(picture.width, kLeastPicture), std::max(picture.height, kLeastPicture), 1};
  DeviceRates rates;
  rates.copy = {.in_cache = copy_rate(meter, kCached, true),
                .in_memory = copy_rate(meter, kLarge, true),
                .transfer = copy_rate(meter, kLarge, false)};
  for (const Format format : formats) {
    if (format_info(format).depth || !can_store(device, format)) continue;
    rates.loads[format] = texel_rate(meter, "load.comp", format, extent);
    rates.stores[format] = texel_rate(meter, "store.comp", format, extent);
  }
  for (const uint32_t side : {64u, 128u, 256u, 512u})
    if (has_room(device, side)) rates.fetches.push_back(fetch_rates(meter, side));
  rates.flops = arithmetic_rate(meter);
  const std::array<uint32_t, 2> size = {extent.width, extent.height};
  rates.invocations = static_cast<double>(size[0]) * size[1] * meter.per_second(nothing(size));
  rates.dispatch = meter.seconds_of_one_group(nothing({1, 1}));
  return rates;
}

nlohmann::ordered_json rates_json(const DeviceRates& rates) {
  using Json = nlohmann::ordered_json;
  const auto texels = [](const std::map<Format, double>& by_format) {
    Json json = Json::object();
    for (const auto& [format, rate] : by_format) json[std::string(format_info(format).name)] = rate;
    return json;
  };
  Json fetches = Json::object();
  for (const FetchRates& rate : rates.fetches)
    fetches[std::to_string(rate.side)] = {{"marching", rate.marching}, {"scattered", rate.scattered}};
  return {{"copy_bytes_per_second",
           {{"in_cache", rates.copy.in_cache}, {"in_memory", rates.copy.in_memory}, {"transfer", rates.copy.transfer}}},
          {"load_texels_per_second", texels(rates.loads)},
          {"store_texels_per_second", texels(rates.stores)},
          {"volume_fetches_per_second", std::move(fetches)},
          {"float_operations_per_second", rates.flops},
          {"invocations_per_second", rates.invocations},
          {"dispatch_ms", rates.dispatch * 1e3}};
}

}  // namespace lightloom::study
