// The pass types of integer_graph.hpp.
#include <cstring>

#include "tests/run/integer_graph.hpp"

namespace lightloom::run::toy {
namespace {

constexpr Extent3 kVolume{4, 3, 2};

Port port(const std::string& name, Direction direction, Access access) {
  Port made;
  made.name = name;
  made.direction = direction;
  made.parts = {{"", Format::r32_uint, ""}};
  made.extent = direction == Direction::in ? ExtentRule::any : ExtentRule::view;
  made.access = access;
  return made;
}

Port input(const std::string& name, Access access = Access::compute_sampled_read) {
  return port(name, Direction::in, access);
}

Port output(Access access = Access::compute_storage_write) {
  return port("a", Direction::out, access);
}

Port scratch(const std::string& name) {
  return port(name, Direction::scratch, Access::compute_storage_read_write);
}

Port volume(Port made) {
  made.dimension = Dimension::d3;
  if (made.direction == Direction::in) return made;
  made.extent = ExtentRule::fixed;
  made.fixed_extent = kVolume;
  return made;
}

Port pair(Port made) {
  made.name = "p";
  made.bundle = "pair";
  made.parts = {{"u", Format::r32_uint, ""}, {"v", Format::r32_uint, ""}};
  return made;
}

Port bypassed(Port made, const std::string& source, float constant = 0) {
  made.bypass = Bypass{source, {constant, 0, 0, 0}};
  return made;
}

Port optional(Port made) {
  made.optional = true;
  return made;
}

Port array(Port made) {
  made.array = true;
  return made;
}

Port persistent(Port made) {
  made.persistent = true;
  return made;
}

PassType type(const std::string& name, std::vector<Port> ports, std::function<void(PassContext&)> record) {
  PassType made;
  made.name = "integer_" + name;
  made.doc = "For tests.";
  made.ports = std::move(ports);
  made.params = {{"salt", ParamType::integer, int64_t{0}, 0, 1000000, {}, "", ""}};
  made.record = std::move(record);
  return made;
}

/// One dispatch over output `a`.
std::function<void(PassContext&)> dispatch(const std::string& shader) {
  return [shader](PassContext& context) {
    context.dispatch({"integer_" + shader + ".comp", context.output_extent("a"), {}});
  };
}

void record_mix(PassContext& context) {
  dispatch("first")(context);
  dispatch("second")(context);
}

void record_frontier(PassContext& context) {
  const bool rest = context.kept("a") && context.kept("memo");
  for (const char* shader : {"integer_memo.comp", "integer_frontier.comp"})
    context.dispatch({shader, context.output_extent("a"), {{"rest", rest}}});
}

void record_stamp(PassContext& context) {
  context.clear("a", {7, 0, 0, 0});
  dispatch("stamp")(context);
}

void record_blank(PassContext& context) {
  context.clear("a", {static_cast<float>(context.params().integer("salt") % 1000), 0, 0, 0});
}

Draw cover(const std::string& shader, const Extent3& area) {
  return {.vertex_shader = "integer_cover.vert",
          .fragment_shader = "integer_" + shader + ".frag",
          .triangles = {{0, 1}},
          .depth_port = {},
          .area = area,
          .values = {}};
}

void record_paint(PassContext& context) {
  context.draw(cover("paint", context.output_extent("a")));
}

void record_splat(PassContext& context) {
  context.clear("hits", {0, 0, 0, 0});
  context.draw(cover("hit", context.output_extent("a")));
  dispatch("splat")(context);
}

std::function<void(PassContext&)> dispatch_volume(const std::string& shader) {
  return [shader](PassContext& context) { context.dispatch({"integer_" + shader + ".comp", kVolume, {}}); };
}

void record_split(PassContext& context) {
  context.dispatch({"integer_split.comp", context.output_extent("p"), {}});
}

uint32_t hash(uint32_t salt, uint32_t value) {
  uint32_t mix = salt ^ (value + 0x9e3779b9U + (salt << 6U) + (salt >> 2U));
  mix *= 0x85ebca6bU;
  return mix ^ (mix >> 13U);
}

void run_on_host(HostContext& context) {
  const HostInput source = context.input("x", "");
  const HostOutput target = context.output("a", "");
  for (size_t offset = 0; offset < source.texels.size(); offset += sizeof(uint32_t)) {
    uint32_t texel = 0;
    std::memcpy(&texel, &source.texels[offset], sizeof texel);
    texel = hash(static_cast<uint32_t>(context.params().integer("salt")), texel);
    std::memcpy(&target.texels[offset], &texel, sizeof texel);
  }
}

std::vector<PassType> make_types() {
  std::vector<PassType> types;
  const auto add = [&](const std::string& name, std::vector<Port> ports, std::function<void(PassContext&)> record) {
    types.push_back(type(name, std::move(ports), std::move(record)));
  };
  const Port passed_on = bypassed(output(), "x");
  Port v = output();
  v.name = "v";
  add("noise", {output()}, dispatch("noise"));
  types.back().reads = FrameState::time;
  add("still", {output()}, dispatch("still"));
  add("mix", {input("x"), optional(input("y")), passed_on, scratch("tmp")}, record_mix);
  add("trail", {input("x"), array(input("past")), passed_on}, dispatch("trail"));
  add("echo", {input("x"), input("last"), passed_on}, dispatch("echo"));
  add("frontier", {persistent(output()), persistent(scratch("memo"))}, record_frontier);
  types.back().reads = FrameState::time;
  add("stamp", {input("x"), bypassed(output(), "", 5)}, record_stamp);
  add("blank", {output()}, record_blank);
  add("paint", {input("x", Access::fragment_sampled_read), bypassed(output(Access::color_attachment_write), "x")},
      record_paint);
  add("splat", {input("x", Access::fragment_sampled_read), output(), scratch("hits")}, record_splat);
  add("grow", {input("x"), volume(v)}, dispatch_volume("grow"));
  add("carve", {volume(input("v")), volume(input("old")), bypassed(volume(v), "v")}, dispatch_volume("carve"));
  add("fold", {volume(input("v")), output()}, dispatch("fold"));
  add("split", {input("x"), bypassed(pair(output()), "", 3)}, record_split);
  add("join", {pair(input("p")), output()}, dispatch("join"));
  add("host", {input("x", Access::transfer_read), output(Access::transfer_write)}, {});
  types.back().host = run_on_host;
  return types;
}

}  // namespace

const std::vector<PassType>& integer_types() {
  static const std::vector<PassType> types = make_types();
  return types;
}

}  // namespace lightloom::run::toy
