#pragma once

#include <vulkan/vulkan_core.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "framework/gpu/shader_compiler.hpp"
#include "framework/graph/format.hpp"

namespace lightloom::gpu {

enum class BindingKind : uint8_t {
  uniform_buffer,
  storage_buffer,
  sampled_image,     ///< texture2D, utexture3D, …: read by texelFetch
  combined_sampler,  ///< sampler2D, …
  storage_image,
  sampler,
  acceleration_structure,
};
[[nodiscard]] std::string_view to_string(BindingKind kind);  ///< "storage image"

enum class ScalarType : uint8_t { boolean, int32, uint32, float32, other };
[[nodiscard]] std::string_view to_string(ScalarType type);  ///< as in GLSL

enum class ImageShape : uint8_t { d2, d2_array, d3, other };

/// A member of a uniform, storage or push constant block; `bool` members appear as uint32, as SPIR-V stores them.
struct BlockMember {
  std::string name;
  uint32_t offset = 0;  ///< from the start of the enclosing struct [bytes]
  uint32_t size = 0;    ///< whole array included; 0 for a runtime array [bytes]
  ScalarType type = ScalarType::other;
  uint32_t components = 1;  ///< of a vector, or of one column of a matrix
  uint32_t columns = 1;
  bool array = false;
  uint32_t array_count = 1;          ///< 0: runtime array
  uint32_t array_stride = 0;         ///< [bytes], arrays only
  std::vector<BlockMember> members;  ///< of a struct
  /// Members of a uniform or storage block, not those of structs in it: the code names it, in whatever branch. True for
  /// all members of an array of blocks.
  bool used = true;
};

struct Binding {
  std::string name;  ///< of the block's type for buffers ("FrameBlock"), of the variable for all else
  uint32_t set = 0;
  uint32_t binding = 0;
  BindingKind kind = BindingKind::uniform_buffer;
  uint32_t count = 1;  ///< elements of an array of resources
  VkShaderStageFlags stages = 0;
  // images and samplers
  ImageShape shape = ImageShape::other;
  NumericClass numeric = NumericClass::floating;
  // storage images and storage buffers
  bool readable = true;   ///< not declared `writeonly`
  bool writable = false;  ///< not declared `readonly`
  // images: what the code does, in whatever branch
  bool reads = false;
  bool writes = false;
  std::optional<Format> format;  ///< storage images: that the shader names, as in `layout(rgba16f)`
  // buffers
  uint32_t block_size = 0;  ///< without a runtime array [bytes]
  std::vector<BlockMember> members;
};

struct SpecializationConstant {
  std::string name;
  uint32_t id = 0;
  ScalarType type = ScalarType::other;
  VkShaderStageFlags stages = 0;  ///< those that know the name by this id
  uint32_t default_bits = 0;      ///< the value that the shader gives it; a bool is 0 or 1
};

struct FragmentOutput {
  std::string name;
  uint32_t location = 0;
  NumericClass numeric = NumericClass::floating;
};

/// The interface of one pipeline's shaders together. Resources that no stage uses are left out.
struct Reflection {
  std::string name;                         ///< of the shaders, for messages: "gather.vert + gather.frag"
  std::vector<Binding> bindings;            ///< by binding
  std::vector<BlockMember> push_constants;  ///< of all stages, by offset
  uint32_t push_constant_size = 0;          ///< [bytes]
  VkShaderStageFlags push_constant_stages = 0;
  std::vector<SpecializationConstant> constants;  ///< by id
  std::array<uint32_t, 3> local_size{1, 1, 1};    ///< compute
  std::vector<FragmentOutput> outputs;            ///< by location

  [[nodiscard]] const Binding* find_binding(std::string_view name) const;
  [[nodiscard]] const SpecializationConstant* find_constant(std::string_view name) const;
  [[nodiscard]] const BlockMember* find_push_constant(std::string_view name) const;
};

/// Throws Error(invalid_input) if the stages contradict each other or use what the framework does not support.
[[nodiscard]] Reflection reflect(std::span<const SpirvModule> modules);

}  // namespace lightloom::gpu
