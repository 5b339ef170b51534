#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/descriptors.hpp"
#include "framework/graph/plan.hpp"
#include "framework/run/poison.hpp"
#include "framework/run/scanned_value.hpp"
#include "framework/run/shader_library.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// Carries out the scans of a plan (Observer::scan): each value is copied piece by piece, and a shader searches the raw
/// texels for NaN, infinity and poison. It needs a few MiB and 48 bytes a value, whatever the size of the values.
class ValueScan {
 public:
  /// `poison` is what stands where nobody wrote, if anything.
  ValueScan(const gpu::Device& device, const Plan& plan, ShaderLibrary& shaders, std::optional<PoisonTone> poison);

  /// Before the first scan of a frame.
  void record_begin(VkCommandBuffer commands) const;
  /// Records the scan behind the plan's barriers. Values that nobody reads are left out: they need not be written.
  void record(VkCommandBuffer commands, const Observation& observation, const ValueImages& images,
              uint64_t frame_count);
  /// Brings what was found to the host; before Readback::record_end.
  void record_end(VkCommandBuffer commands) const;
  /// What the last frame's scans found, in execution order; valid once the device is done.
  [[nodiscard]] std::vector<ScannedValue> found() const;

 private:
  struct Kernel {
    const gpu::Pipeline* pipeline = nullptr;
    VkDescriptorSet set = VK_NULL_HANDLE;
  };
  enum class Stage : uint32_t { search, fetch };

  const Kernel& kernel(Format format, Stage stage);
  void record_kernel(VkCommandBuffer commands, const Kernel& kernel, std::span<const ShaderValue> params,
                     uint32_t groups) const;

  const Graph& graph_;  ///< of the plan
  ShaderLibrary& shaders_;
  std::optional<PoisonTone> poison_;
  std::vector<ValueId> scanned_;  ///< in execution order; a record each
  std::map<ValueId, uint32_t> record_of_;
  gpu::Buffer texels_;
  gpu::Buffer records_;
  gpu::Buffer host_records_;
  gpu::DescriptorAllocator descriptors_;
  std::map<std::pair<uint32_t, Stage>, Kernel> kernels_;
};

}  // namespace lightloom::run
