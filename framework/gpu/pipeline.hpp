#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/gpu/pipeline_file.hpp"
#include "framework/gpu/reflection.hpp"
#include "framework/gpu/shader_values.hpp"

namespace lightloom::gpu {

/// The compiled shaders of one pipeline with their interface.
struct ShaderProgram {
  std::vector<SpirvModule> modules;
  Reflection reflection;
  uint64_t identity = 0;  ///< hash of the SPIR-V of all stages
  [[nodiscard]] bool compute() const { return modules.size() == 1 && modules.front().stage == Stage::compute; }
};
[[nodiscard]] ShaderProgram make_program(std::vector<SpirvModule> modules);

/// What a graphics pipeline draws into; `colors[i]` is the fragment output of location i.
struct AttachmentFormats {
  std::vector<VkFormat> colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;  ///< VK_FORMAT_UNDEFINED: no depth test
  bool operator==(const AttachmentFormats&) const = default;
};

/// A compute or graphics pipeline with its layouts (one descriptor set, number 0).
/// Graphics: triangle list without vertex input, dynamic rendering, dynamic viewport and scissor, no culling, counter-
/// clockwise front faces, depth test less-or-equal with write where there is a depth format, no blending.
class Pipeline {
 public:
  /// Compute. `constants` gives specialization constants by name; those not named keep the shader's default, a name
  /// that the shader does not have is an Error(invalid_input). `cache` is the driver's, which may be none.
  Pipeline(const Device& device, const ShaderProgram& program, std::span<const ShaderValue> constants,
           VkPipelineCache cache = VK_NULL_HANDLE);
  /// Graphics: a vertex and a fragment stage.
  Pipeline(const Device& device, const ShaderProgram& program, std::span<const ShaderValue> constants,
           const AttachmentFormats& formats, VkPipelineCache cache = VK_NULL_HANDLE);

  [[nodiscard]] VkPipeline get() const { return pipeline_.get(); }
  [[nodiscard]] VkPipelineLayout layout() const { return layout_.get(); }
  [[nodiscard]] VkDescriptorSetLayout set_layout() const { return set_layout_.get(); }
  [[nodiscard]] VkPipelineBindPoint bind_point() const { return bind_point_; }
  [[nodiscard]] const Reflection& reflection() const { return reflection_; }

  /// Binds pipeline, descriptor set (if the shaders have bindings) and push constants (all of them, see
  /// encode_push_constants; empty if there are none).
  void bind(VkCommandBuffer commands, VkDescriptorSet set, std::span<const std::byte> push_constants) const;

 private:
  void create_layouts(const Device& device);

  Reflection reflection_;
  VkPipelineBindPoint bind_point_ = VK_PIPELINE_BIND_POINT_COMPUTE;
  DescriptorSetLayoutHandle set_layout_;
  PipelineLayoutHandle layout_;
  PipelineHandle pipeline_;
};

/// Makes each pipeline once, told apart by SPIR-V, specialization values and attachment formats. References stay valid
/// as long as the cache lives.
class PipelineCache {
 public:
  /// `directory`: where the driver's compiled pipelines are kept on disk; empty: nowhere.
  explicit PipelineCache(const Device& device, const std::filesystem::path& directory = {})
      : device_(device), file_(device, directory) {}
  /// Saves.
  ~PipelineCache() { save(); }
  PipelineCache(const PipelineCache&) = delete;
  PipelineCache& operator=(const PipelineCache&) = delete;
  const Pipeline& compute(const ShaderProgram& program, std::span<const ShaderValue> constants);
  const Pipeline& graphics(const ShaderProgram& program, std::span<const ShaderValue> constants,
                           const AttachmentFormats& formats);
  [[nodiscard]] size_t size() const { return pipelines_.size(); }
  /// What making them took so far. A driver may put a part off to their first use.
  [[nodiscard]] double milliseconds() const { return milliseconds_; }
  /// Writes to disk what was made since the last time; after a failure, in vain: PipelineFile::statistics has why.
  void save() noexcept;
  [[nodiscard]] const PipelineFile& file() const { return file_; }

 private:
  const Pipeline& make(const std::string& key, const std::function<std::unique_ptr<Pipeline>()>& pipeline);

  const Device& device_;
  PipelineFile file_;
  size_t saved_ = 0;  ///< pipelines when last saved
  double milliseconds_ = 0;
  std::map<std::string, std::unique_ptr<Pipeline>> pipelines_;
};

}  // namespace lightloom::gpu
