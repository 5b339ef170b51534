#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/graph/access.hpp"
#include "framework/graph/desc.hpp"
#include "framework/graph/param.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom {

/// Index into Graph::values.
using ValueId = uint32_t;

/// One image: written by exactly one pass a frame, or a constant that is cleared once.
struct Value {
  std::string pass;
  std::string port;
  std::string part;  ///< empty for a port with a single image
  ImageDesc desc;
  std::optional<ClearColor> constant;  ///< no producer: stands for an output of a disabled pass
  uint32_t history = 0;                ///< largest age that is read; the image is a ring of history + 1 layers
  bool scratch = false;                ///< used by its pass alone, within a frame
  bool persistent = false;             ///< its pass rewrites a part of it and keeps the rest of the frame before
  bool read = false;                   ///< by a pass, an output of the graph or a capture (mark_reads)
  bool operator==(const Value&) const = default;
};

[[nodiscard]] std::string value_name(const Value& value);  ///< "pass.port" or "pass.port.part"
[[nodiscard]] inline uint32_t ring_layers(const Value& value) {
  return value.history + 1;
}
[[nodiscard]] uint64_t byte_size(const Value& value);  ///< all layers [bytes]

/// How a pass uses a value through one part of one port.
struct Use {
  std::string port;
  std::string part;         ///< part of the pass's own port, empty for a single image
  std::string shader_name;  ///< binding name, rules in port.hpp
  Access access = Access::none;
  ValueId value = 0;
  uint32_t first_age = 0;  ///< 0: this frame's
  uint32_t last_age = 0;
  bool array = false;  ///< bound as an array over the whole ring
  bool operator==(const Use&) const = default;
};

struct GraphPass {
  std::string name;
  const PassType* type = nullptr;  ///< owned by the registry, which outlives the graph, or by Graph::own_types
  ParamSet params;                 ///< one entry a declared param, in declared order
  std::vector<Use> inputs;         ///< in the order of the type's ports and parts
  std::vector<Use> outputs;
  std::vector<Use> scratch;
  std::vector<std::string> unconnected;  ///< optional inputs that have no source
  std::string once;                      ///< why it runs in the first frame alone; empty: it runs in every frame
  bool looks_back = false;  ///< it, or one that it depends on within the frame, reads an earlier frame (mark_reads)
};

/// `age` is 0 unless a bypassed pass stood between, whose source is a history edge.
struct GraphOutput {
  std::string name;
  ValueId value = 0;
  uint32_t age = 0;
};

struct PassRemark {
  std::string pass;
  std::string reason;
};

/// A linked and typed graph: plain data, swaps and bypasses applied, what nothing needs left out.
struct Graph {
  std::string name;
  Extent3 view;
  Extent3 trace;
  std::vector<std::pair<std::string, ParamValue>> params;  ///< graph params after variants and options
  std::vector<Value> values;                               ///< by pass in declared order; constants last
  std::vector<GraphPass> passes;                           ///< in declared order
  std::vector<GraphOutput> outputs;
  std::vector<ValueId> captures;     ///< ascending, unique; no constants
  std::vector<PassRemark> culled;    ///< enabled, but neither an output, a capture nor a side effect needs it
  std::vector<PassRemark> bypassed;  ///< disabled; consumers, if any, see its bypass
  std::vector<std::string> notes;    ///< what a swap made fall away, …
  std::vector<std::shared_ptr<const PassType>> own_types;  ///< of passes of type `compute`
  bool general = false;  ///< LinkOptions::general: shaders are to have every scene feature
};

/// Fills Value::read and GraphPass::looks_back. `link` does; whoever changes passes, outputs or captures must do it
/// again.
void mark_reads(Graph& graph);

}  // namespace lightloom
