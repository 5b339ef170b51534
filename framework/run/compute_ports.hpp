#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/graph/port.hpp"
#include "framework/run/compute_type.hpp"

namespace lightloom::run {

/// The ports of a compute type. Private to framework/run/compute_*.cpp.
class ComputePorts {
 public:
  ComputePorts(const ComputeNode& node, const ComputeShader& shader, Diagnostics& diagnostics)
      : node_(node), shader_(shader), diagnostics_(diagnostics) {}
  [[nodiscard]] std::vector<Port> run();

 private:
  [[nodiscard]] bool usable(const gpu::Binding& binding);
  void add_input(const gpu::Binding& binding);
  void add_output(const gpu::Binding& binding);
  [[nodiscard]] std::optional<Format> output_format(const gpu::Binding& binding, const ComputeOutputSpec* spec);
  void set_size(Port& port, const ComputeOutputSpec* spec);
  void set_default_size(Port& port);
  [[nodiscard]] bool set_fixed_size(Port& port, const std::string& text);
  void set_bypass(Port& port, const ComputeOutputSpec& spec);
  void check_outputs();
  void error(std::string_view code, const SourceLocation& where, const std::string& what, const std::string& hint = {});
  void shader_error(const gpu::Binding& binding, const std::string& what, const std::string& hint);
  [[nodiscard]] Port* find_input(std::string_view name);
  [[nodiscard]] std::vector<std::string> names(Direction direction) const;

  const ComputeNode& node_;
  const ComputeShader& shader_;
  Diagnostics& diagnostics_;
  std::vector<Port> ports_;
};

/// What the shader calls an output starts with this.
constexpr std::string_view kOutputPrefix = "out_";

}  // namespace lightloom::run
