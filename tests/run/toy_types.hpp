#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/graph/pass_type.hpp"
#include "tests/support/graph_runner.hpp"

namespace lightloom::run::toy {

/// A single r32_sfloat image; outputs have the trace's size.
inline Port image_port(const std::string& name, Direction direction) {
  Port port;
  port.name = name;
  port.direction = direction;
  port.parts = {{"", Format::r32_sfloat, ""}};
  port.extent = direction == Direction::in ? ExtentRule::any : ExtentRule::trace;
  port.access = direction == Direction::in ? Access::compute_sampled_read : Access::compute_storage_write;
  return port;
}

/// A pass type that runs one shader over its output.
inline PassType one_shader_type(const std::string& name, std::vector<Port> ports, const std::string& shader,
                                const std::string& output) {
  PassType type;
  type.name = name;
  type.doc = "For tests.";
  type.ports = std::move(ports);
  type.record = [shader, output](PassContext& context) {
    context.dispatch({shader, context.output_extent(output), {}});
  };
  return type;
}

inline scene::Scene one_quad() {
  return test::make_quad_scene({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0}}, {},
                               test::look_at({0.5f, 0.5f, 2}, {0.5f, 0.5f, 0}, 0.8f));
}

}  // namespace lightloom::run::toy
