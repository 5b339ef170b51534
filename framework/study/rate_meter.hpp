#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/device.hpp"
#include "framework/gpu/timestamps.hpp"
#include "framework/run/shader_library.hpp"

namespace lightloom::study {

/// A compute shader whose work grows with the groups along z.
struct RateKernel {
  std::string shader;
  std::vector<ShaderValue> constants;  ///< specialization
  std::vector<ShaderValue> params;     ///< push constants
  gpu::ResourceMap resources;
  std::array<uint32_t, 2> invocations{1, 1};  ///< along x and y, at least
};

/// Times small pieces of work on a device, by its timestamps. Each is measured several times, and the shortest time
/// counts: what is asked for is what the device can do.
class RateMeter {
 public:
  /// `device` and `library` outlive it. Throws Error(run_failed) for a device without timestamps.
  RateMeter(gpu::Device& device, run::ShaderLibrary& library);

  /// How often a second the device does what one layer of groups of the kernel does.
  [[nodiscard]] double per_second(const RateKernel& kernel);
  /// How often a second it does what is recorded.
  [[nodiscard]] double per_second(const std::function<void(VkCommandBuffer)>& record);
  /// What one group of the kernel takes, with the barriers around it [s]; the median.
  [[nodiscard]] double seconds_of_one_group(const RateKernel& kernel);

  /// A word that kernels could write to and never do.
  [[nodiscard]] const gpu::Buffer& sink() const { return sink_; }
  [[nodiscard]] gpu::Device& device() { return device_; }

 private:
  struct Bound {
    const gpu::Pipeline* pipeline = nullptr;
    VkDescriptorSet set = VK_NULL_HANDLE;
    std::vector<std::byte> params;
    std::array<uint32_t, 2> groups{1, 1};
  };
  [[nodiscard]] Bound bind(const RateKernel& kernel);
  [[nodiscard]] double seconds(const std::function<void(VkCommandBuffer)>& record);
  /// `times` tells what to record how often it is to be done.
  [[nodiscard]] double best_rate(const std::function<void(VkCommandBuffer, uint32_t times)>& record);

  gpu::Device& device_;
  run::ShaderLibrary& library_;
  gpu::Buffer sink_;
  gpu::TimestampPool stamps_;
  gpu::DescriptorAllocator descriptors_;
};

}  // namespace lightloom::study
