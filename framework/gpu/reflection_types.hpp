#pragma once

#include <spirv_cross/spirv_cross_c.h>

#include <string>
#include <vector>

#include "framework/gpu/reflection.hpp"

namespace lightloom::gpu {

/// A SPIRV-Cross compiler over one module; frees all that it handed out when it dies.
class SpirvReader {
 public:
  /// Throws Error(invalid_input) if the module is not valid SPIR-V.
  explicit SpirvReader(const SpirvModule& module);
  ~SpirvReader();
  SpirvReader(const SpirvReader&) = delete;
  SpirvReader& operator=(const SpirvReader&) = delete;

  [[nodiscard]] spvc_compiler get() const { return compiler_; }
  [[nodiscard]] const std::string& name() const { return name_; }  ///< of the shader
  /// Throws Error(invalid_input) unless `result` is a success.
  void check(spvc_result result) const;
  /// Resources of one type that the entry point uses.
  [[nodiscard]] std::vector<spvc_reflected_resource> resources(spvc_resource_type type) const;

 private:
  std::string name_;
  spvc_context context_ = nullptr;
  spvc_compiler compiler_ = nullptr;
  spvc_resources resources_ = nullptr;
};

[[nodiscard]] ScalarType scalar_type(spvc_basetype type);
/// Members of a struct type, nested ones included.
[[nodiscard]] std::vector<BlockMember> struct_members(const SpirvReader& reader, spvc_type type);

}  // namespace lightloom::gpu
