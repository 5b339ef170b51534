#include "framework/gpu/reflection.hpp"

#include <algorithm>
#include <array>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"
#include "framework/gpu/descriptor_type.hpp"
#include "framework/gpu/image_use.hpp"
#include "framework/gpu/reflection_types.hpp"

namespace lightloom::gpu {
namespace {

struct ResourceRow {
  spvc_resource_type type;
  BindingKind kind;
};
constexpr std::array<ResourceRow, 7> kBound{{
    {SPVC_RESOURCE_TYPE_UNIFORM_BUFFER, BindingKind::uniform_buffer},
    {SPVC_RESOURCE_TYPE_STORAGE_BUFFER, BindingKind::storage_buffer},
    {SPVC_RESOURCE_TYPE_SEPARATE_IMAGE, BindingKind::sampled_image},
    {SPVC_RESOURCE_TYPE_SAMPLED_IMAGE, BindingKind::combined_sampler},
    {SPVC_RESOURCE_TYPE_STORAGE_IMAGE, BindingKind::storage_image},
    {SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS, BindingKind::sampler},
    {SPVC_RESOURCE_TYPE_ACCELERATION_STRUCTURE, BindingKind::acceleration_structure},
}};
constexpr std::array kUnsupported{SPVC_RESOURCE_TYPE_SUBPASS_INPUT, SPVC_RESOURCE_TYPE_ATOMIC_COUNTER};

[[noreturn]] void fail(const Reflection& reflection, const std::string& sentence, const std::string& hint = {}) {
  throw Error(ExitCode::invalid_input, "shader " + reflection.name + ": " + sentence, hint);
}

ImageShape image_shape(spvc_type type) {
  const bool arrayed = spvc_type_get_image_arrayed(type) == SPVC_TRUE;
  if (spvc_type_get_image_multisampled(type) == SPVC_TRUE) return ImageShape::other;
  switch (spvc_type_get_image_dimension(type)) {
    case SpvDim2D:
      return arrayed ? ImageShape::d2_array : ImageShape::d2;
    case SpvDim3D:
      return ImageShape::d3;
    default:
      return ImageShape::other;
  }
}

struct FormatRow {
  SpvImageFormat shader;
  Format format;
};
constexpr std::array<FormatRow, 12> kFormats{{
    {SpvImageFormatR8, Format::r8_unorm},
    {SpvImageFormatRgba8, Format::rgba8_unorm},
    {SpvImageFormatRgba16, Format::rgba16_unorm},
    {SpvImageFormatR16f, Format::r16_sfloat},
    {SpvImageFormatRg16f, Format::rg16_sfloat},
    {SpvImageFormatRgba16f, Format::rgba16_sfloat},
    {SpvImageFormatR32f, Format::r32_sfloat},
    {SpvImageFormatRg32f, Format::rg32_sfloat},
    {SpvImageFormatRgba32f, Format::rgba32_sfloat},
    {SpvImageFormatR32ui, Format::r32_uint},
    {SpvImageFormatRg32ui, Format::rg32_uint},
    {SpvImageFormatRgba32ui, Format::rgba32_uint},
}};

/// Throws Error(invalid_input) for one that no value can have.
std::optional<Format> image_format(SpvImageFormat format, const std::string& image, const std::string& shader) {
  if (format == SpvImageFormatUnknown) return std::nullopt;
  const auto* const found =
      std::find_if(kFormats.begin(), kFormats.end(), [format](const FormatRow& row) { return row.shader == format; });
  if (found != kFormats.end()) return found->format;
  throw Error(ExitCode::invalid_input,
              "shader " + shader + ": the image " + in_quotes(image) + " has a format that no value can have",
              "r8, rgba8, r16f, rg16f, rgba16f, r32f, rg32f, rgba32f, r32ui, rg32ui or rgba32ui");
}

/// What only images have.
void read_image(const SpirvReader& reader, const spvc_reflected_resource& resource, Binding& binding) {
  const spvc_type type = spvc_compiler_get_type_handle(reader.get(), resource.type_id);
  binding.shape = image_shape(type);
  const spvc_type sampled = spvc_compiler_get_type_handle(reader.get(), spvc_type_get_image_sampled_type(type));
  binding.numeric =
      spvc_type_get_basetype(sampled) == SPVC_BASETYPE_UINT32 ? NumericClass::unsigned_integer : NumericClass::floating;
  if (binding.kind != BindingKind::storage_image) return;
  binding.format = image_format(spvc_type_get_image_storage_format(type), binding.name, reader.name());
  binding.readable = spvc_compiler_has_decoration(reader.get(), resource.id, SpvDecorationNonReadable) == SPVC_FALSE;
  binding.writable = spvc_compiler_has_decoration(reader.get(), resource.id, SpvDecorationNonWritable) == SPVC_FALSE;
}

void mark_used(const SpirvReader& reader, const spvc_reflected_resource& resource, std::vector<BlockMember>& members) {
  const spvc_buffer_range* ranges = nullptr;
  size_t count = 0;
  reader.check(spvc_compiler_get_active_buffer_ranges(reader.get(), resource.id, &ranges, &count));
  for (size_t i = 0; i < members.size(); ++i)
    members[i].used =
        std::any_of(ranges, ranges + count, [i](const spvc_buffer_range& range) { return range.index == i; });
}

/// What only buffers have.
void read_block(const SpirvReader& reader, const spvc_reflected_resource& resource, Binding& binding) {
  binding.name = spvc_compiler_get_name(reader.get(), resource.base_type_id);
  const spvc_type type = spvc_compiler_get_type_handle(reader.get(), resource.base_type_id);
  binding.members = struct_members(reader, type);
  // Of an array of blocks the library takes the number of the block for that of a member.
  const spvc_type whole = spvc_compiler_get_type_handle(reader.get(), resource.type_id);
  if (spvc_type_get_num_array_dimensions(whole) == 0) mark_used(reader, resource, binding.members);
  size_t size = 0;
  reader.check(spvc_compiler_get_declared_struct_size(reader.get(), type, &size));
  binding.block_size = static_cast<uint32_t>(size);
  if (binding.kind != BindingKind::storage_buffer) return;
  const SpvDecoration* decorations = nullptr;
  size_t count = 0;
  reader.check(spvc_compiler_get_buffer_block_decorations(reader.get(), resource.id, &decorations, &count));
  const auto has = [&](SpvDecoration wanted) {
    return std::find(decorations, decorations + count, wanted) != decorations + count;
  };
  binding.readable = !has(SpvDecorationNonReadable);
  binding.writable = !has(SpvDecorationNonWritable);
}

Binding read_binding(const SpirvReader& reader, const spvc_reflected_resource& resource, BindingKind kind) {
  Binding binding;
  binding.name = resource.name;
  binding.kind = kind;
  binding.set = spvc_compiler_get_decoration(reader.get(), resource.id, SpvDecorationDescriptorSet);
  binding.binding = spvc_compiler_get_decoration(reader.get(), resource.id, SpvDecorationBinding);
  const spvc_type type = spvc_compiler_get_type_handle(reader.get(), resource.type_id);
  for (unsigned i = 0; i < spvc_type_get_num_array_dimensions(type); ++i) {
    // 0: a length that is not a constant of the source, or none at all.
    binding.count *=
        spvc_type_array_dimension_is_literal(type, i) == SPVC_TRUE ? spvc_type_get_array_dimension(type, i) : 0;
  }
  const bool buffer = kind == BindingKind::uniform_buffer || kind == BindingKind::storage_buffer;
  if (buffer) read_block(reader, resource, binding);
  const bool image = !buffer && kind != BindingKind::sampler && kind != BindingKind::acceleration_structure;
  if (image) read_image(reader, resource, binding);
  return binding;
}

void merge_binding(Reflection& reflection, Binding binding, VkShaderStageFlags stage) {
  if (binding.set != 0) fail(reflection, in_quotes(binding.name) + " is in a descriptor set other than 0");
  if (binding.count == 0) {
    fail(reflection, "the array " + in_quotes(binding.name) + " has no constant length",
         "give its length by a literal or a const, not by a specialization constant");
  }
  for (Binding& other : reflection.bindings) {
    const bool same_name = other.name == binding.name;
    if (!same_name && other.binding != binding.binding) continue;
    if (!same_name || other.binding != binding.binding) {
      fail(reflection, "its stages were not compiled together, so that " + in_quotes(binding.name) + " and " +
                           in_quotes(other.name) + " have clashing bindings");
    }
    if (other.kind != binding.kind || other.count != binding.count || other.shape != binding.shape ||
        other.numeric != binding.numeric || other.block_size != binding.block_size) {
      fail(reflection, "its stages declare " + in_quotes(binding.name) + " differently");
    }
    other.stages |= stage;
    other.readable = other.readable || binding.readable;
    other.writable = other.writable || binding.writable;
    other.reads = other.reads || binding.reads;
    other.writes = other.writes || binding.writes;
    if (!other.format) other.format = binding.format;
    for (size_t i = 0; i < other.members.size(); ++i)
      other.members[i].used = other.members[i].used || binding.members.at(i).used;
    return;
  }
  binding.stages = stage;
  reflection.bindings.push_back(std::move(binding));
}

void merge_push_constants(Reflection& reflection, const SpirvReader& reader, VkShaderStageFlags stage) {
  for (const auto& resource : reader.resources(SPVC_RESOURCE_TYPE_PUSH_CONSTANT)) {
    const spvc_type type = spvc_compiler_get_type_handle(reader.get(), resource.base_type_id);
    reflection.push_constant_stages |= stage;
    for (BlockMember& member : struct_members(reader, type)) {
      reflection.push_constant_size = std::max(reflection.push_constant_size, member.offset + member.size);
      const BlockMember* known = reflection.find_push_constant(member.name);
      if (known == nullptr) {
        reflection.push_constants.push_back(std::move(member));
      } else if (known->offset != member.offset || known->size != member.size || known->type != member.type) {
        fail(reflection, "its stages have the push constant " + in_quotes(member.name) + " at different places");
      }
    }
  }
}

void check_push_constant_overlap(Reflection& reflection) {
  auto& members = reflection.push_constants;
  std::sort(members.begin(), members.end(), [](const auto& a, const auto& b) { return a.offset < b.offset; });
  for (size_t i = 1; i < members.size(); ++i) {
    if (members[i - 1].offset + members[i - 1].size <= members[i].offset) continue;
    fail(reflection,
         "the push constants " + in_quotes(members[i - 1].name) + " and " + in_quotes(members[i].name) +
             " of its stages lie on each other",
         "declare one push constant block, the same in both stages");
  }
}

void merge_constants(Reflection& reflection, const SpirvReader& reader, VkShaderStageFlags stage) {
  const spvc_specialization_constant* list = nullptr;
  size_t count = 0;
  reader.check(spvc_compiler_get_specialization_constants(reader.get(), &list, &count));
  for (size_t i = 0; i < count; ++i) {
    const spvc_constant handle = spvc_compiler_get_constant_handle(reader.get(), list[i].id);
    const spvc_type type = spvc_compiler_get_type_handle(reader.get(), spvc_constant_get_type(handle));
    SpecializationConstant constant{.name = spvc_compiler_get_name(reader.get(), list[i].id),
                                    .id = list[i].constant_id,
                                    .type = scalar_type(spvc_type_get_basetype(type)),
                                    .stages = stage};
    const SpecializationConstant* known = reflection.find_constant(constant.name);
    constant.default_bits = spvc_constant_get_scalar_u32(handle, 0, 0);
    if (known != nullptr && known->type != constant.type) {
      fail(reflection, "its stages declare the constant " + in_quotes(constant.name) + " with different types");
    }
    const auto same = std::find_if(
        reflection.constants.begin(), reflection.constants.end(),
        [&](const SpecializationConstant& other) { return other.name == constant.name && other.id == constant.id; });
    if (same != reflection.constants.end()) {
      same->stages |= stage;
    } else {
      reflection.constants.push_back(std::move(constant));
    }
  }
}

void read_outputs(Reflection& reflection, const SpirvReader& reader) {
  for (const auto& resource : reader.resources(SPVC_RESOURCE_TYPE_STAGE_OUTPUT)) {
    const spvc_type type = spvc_compiler_get_type_handle(reader.get(), resource.type_id);
    reflection.outputs.push_back(
        {.name = resource.name,
         .location = spvc_compiler_get_decoration(reader.get(), resource.id, SpvDecorationLocation),
         .numeric = spvc_type_get_basetype(type) == SPVC_BASETYPE_UINT32 ? NumericClass::unsigned_integer
                                                                         : NumericClass::floating});
  }
}

void add_module(Reflection& reflection, const SpirvModule& module) {
  const SpirvReader reader(module);
  const VkShaderStageFlags stage = stage_flag(module.stage);
  for (spvc_resource_type type : kUnsupported) {
    const auto resources = reader.resources(type);
    if (!resources.empty()) {
      fail(reflection, in_quotes(resources[0].name) + " is of a kind that the framework does not bind");
    }
  }
  const std::map<uint32_t, ImageUse> uses = image_uses(module.words);
  for (const ResourceRow& row : kBound) {
    for (const auto& resource : reader.resources(row.type)) {
      Binding binding = read_binding(reader, resource, row.kind);
      if (const auto use = uses.find(resource.id); use != uses.end()) {
        binding.reads = use->second.read;
        binding.writes = use->second.written;
      }
      merge_binding(reflection, std::move(binding), stage);
    }
  }
  merge_push_constants(reflection, reader, stage);
  merge_constants(reflection, reader, stage);
  if (module.stage == Stage::fragment) read_outputs(reflection, reader);
  if (module.stage != Stage::compute) return;
  for (unsigned i = 0; i < 3; ++i) {
    reflection.local_size[i] =
        spvc_compiler_get_execution_mode_argument_by_index(reader.get(), SpvExecutionModeLocalSize, i);
  }
}

template <class T>
const T* find_named(const std::vector<T>& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const T& element) { return element.name == name; });
  return found == list.end() ? nullptr : &*found;
}

}  // namespace

std::string_view to_string(BindingKind kind) {
  switch (kind) {
    case BindingKind::uniform_buffer:
      return "uniform buffer";
    case BindingKind::storage_buffer:
      return "storage buffer";
    case BindingKind::sampled_image:
      return "sampled image";
    case BindingKind::combined_sampler:
      return "image with sampler";
    case BindingKind::storage_image:
      return "storage image";
    case BindingKind::acceleration_structure:
      return "acceleration structure";
    case BindingKind::sampler:
      break;
  }
  return "sampler";
}

std::string_view to_string(ScalarType type) {
  switch (type) {
    case ScalarType::boolean:
      return "bool";
    case ScalarType::int32:
      return "int";
    case ScalarType::uint32:
      return "uint";
    case ScalarType::float32:
      return "float";
    case ScalarType::other:
      break;
  }
  return "other";
}

const Binding* Reflection::find_binding(std::string_view wanted) const {
  return find_named(bindings, wanted);
}
const SpecializationConstant* Reflection::find_constant(std::string_view wanted) const {
  return find_named(constants, wanted);
}
const BlockMember* Reflection::find_push_constant(std::string_view wanted) const {
  return find_named(push_constants, wanted);
}

Reflection reflect(std::span<const SpirvModule> modules) {
  Reflection reflection;
  for (const SpirvModule& module : modules) {
    reflection.name += (reflection.name.empty() ? "" : " + ") + module.name;
  }
  for (const SpirvModule& module : modules) add_module(reflection, module);
  check_push_constant_overlap(reflection);
  const auto by = [](auto member) { return [member](const auto& a, const auto& b) { return a.*member < b.*member; }; };
  std::sort(reflection.bindings.begin(), reflection.bindings.end(), by(&Binding::binding));
  std::stable_sort(reflection.constants.begin(), reflection.constants.end(), by(&SpecializationConstant::id));
  std::sort(reflection.outputs.begin(), reflection.outputs.end(), by(&FragmentOutput::location));
  return reflection;
}

}  // namespace lightloom::gpu
