#include "framework/gpu/reflection_types.hpp"

#include "framework/base/error.hpp"

namespace lightloom::gpu {
namespace {

BlockMember struct_member(const SpirvReader& reader, spvc_type parent, uint32_t index) {
  const spvc_type type = spvc_compiler_get_type_handle(reader.get(), spvc_type_get_member_type(parent, index));
  BlockMember member;
  member.name = spvc_compiler_get_member_name(reader.get(), spvc_type_get_base_type_id(parent), index);
  unsigned value = 0;
  reader.check(spvc_compiler_type_struct_member_offset(reader.get(), parent, index, &value));
  member.offset = value;
  size_t size = 0;
  reader.check(spvc_compiler_get_declared_struct_member_size(reader.get(), parent, index, &size));
  member.size = static_cast<uint32_t>(size);
  member.type = scalar_type(spvc_type_get_basetype(type));
  member.components = spvc_type_get_vector_size(type);
  member.columns = spvc_type_get_columns(type);
  const unsigned dimensions = spvc_type_get_num_array_dimensions(type);
  if (dimensions > 0) {
    member.array = true;
    reader.check(spvc_compiler_type_struct_member_array_stride(reader.get(), parent, index, &value));
    member.array_stride = value;
    member.array_count = value == 0 ? 0 : member.size / value;
  }
  if (spvc_type_get_basetype(type) == SPVC_BASETYPE_STRUCT) member.members = struct_members(reader, type);
  return member;
}

}  // namespace

SpirvReader::SpirvReader(const SpirvModule& module) : name_(module.name) {
  if (spvc_context_create(&context_) != SPVC_SUCCESS) {
    throw Error(ExitCode::run_failed, "the reflection of shader " + name_ + " finds no memory");
  }
  try {
    spvc_parsed_ir ir = nullptr;
    check(spvc_context_parse_spirv(context_, module.words.data(), module.words.size(), &ir));
    check(spvc_context_create_compiler(context_, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP, &compiler_));
    spvc_set active = nullptr;
    check(spvc_compiler_get_active_interface_variables(compiler_, &active));
    check(spvc_compiler_create_shader_resources_for_active_variables(compiler_, &resources_, active));
  } catch (...) {
    spvc_context_destroy(context_);
    throw;
  }
}

SpirvReader::~SpirvReader() {
  spvc_context_destroy(context_);
}

void SpirvReader::check(spvc_result result) const {
  if (result == SPVC_SUCCESS) return;
  throw Error(ExitCode::invalid_input,
              "the SPIR-V of shader " + name_ + " cannot be read: " + spvc_context_get_last_error_string(context_));
}

std::vector<spvc_reflected_resource> SpirvReader::resources(spvc_resource_type type) const {
  const spvc_reflected_resource* list = nullptr;
  size_t count = 0;
  check(spvc_resources_get_resource_list_for_type(resources_, type, &list, &count));
  return {list, list + count};
}

ScalarType scalar_type(spvc_basetype type) {
  switch (type) {
    case SPVC_BASETYPE_BOOLEAN:
      return ScalarType::boolean;
    case SPVC_BASETYPE_INT32:
      return ScalarType::int32;
    case SPVC_BASETYPE_UINT32:
      return ScalarType::uint32;
    case SPVC_BASETYPE_FP32:
      return ScalarType::float32;
    default:
      return ScalarType::other;
  }
}

std::vector<BlockMember> struct_members(const SpirvReader& reader, spvc_type type) {
  std::vector<BlockMember> members;
  for (uint32_t i = 0; i < spvc_type_get_num_member_types(type); ++i) {
    members.push_back(struct_member(reader, type, i));
  }
  return members;
}

}  // namespace lightloom::gpu
