#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "framework/graph/link.hpp"

// Working data of the linker, private to framework/graph/link*.cpp.
namespace lightloom::linking {

/// Diagnostics that drop what was already said, so that checks may run again on a changed copy of the graph.
class Report {
 public:
  explicit Report(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  void error(std::string_view code, const SourceLocation& where, const std::string& message,
             const std::string& hint = {});
  void warning(std::string_view code, const SourceLocation& where, const std::string& message,
               const std::string& hint = {});
  [[nodiscard]] bool has_errors() const { return diagnostics_.has_errors(); }

 private:
  [[nodiscard]] bool is_new(std::string_view code, const SourceLocation& where, const std::string& message);
  Diagnostics& diagnostics_;
  std::set<std::tuple<SourceLocation, std::string, std::string>> said_;  ///< places, codes, messages
};

/// A pass of the file as variants and options have left it.
struct Node {
  const PassSpec* spec = nullptr;
  const PassType* type = nullptr;  ///< null: unknown, and reported
  std::optional<std::string> swapped_by;
  std::string disabled;  ///< why; empty: enabled
  SourceLocation disabled_where;
  std::vector<ScalarSpec> params;
  std::vector<std::string> swapped_params;  ///< names of params that were given before a swap …
  std::vector<std::string> dropped_inputs;  ///< … and of inputs that the new type cannot take
  ParamSet resolved;
  std::vector<std::pair<const PortPart*, Format>> formats;  ///< of images that are not stored as the type says
  [[nodiscard]] bool enabled() const { return disabled.empty(); }
  [[nodiscard]] Format format_of(const PortPart& image) const {
    for (const auto& [part, format] : formats)
      if (part == &image) return format;
    return image.format;
  }
};

/// A wish for a format, by whom and where.
struct FormatWish {
  std::optional<uint32_t> node;  ///< `values` names its port or "port.part"; else it is a glob over the names of all
  FormatSpec spec;
};

/// What variants and options can change.
struct Nodes {
  std::vector<Node> list;
  std::vector<ScalarSpec> graph_params;
  std::vector<FormatWish> formats;                         ///< in the order in which they apply
  std::unordered_map<std::string_view, uint32_t> by_name;  ///< the file's names, which outlive the linking
  [[nodiscard]] std::vector<std::string> names() const;
};

struct Input {
  const GraphSpec& spec;
  const PassRegistry& registry;
  const LinkOptions& options;
  const LinkEnvironment& environment;
};

constexpr uint32_t kNoNode = 0xffffffffU;

/// One image that a node writes, or would write if it were not disabled.
struct ImageRef {
  uint32_t node = kNoNode;
  const Port* port = nullptr;
  uint32_t part = 0;
  bool operator==(const ImageRef&) const = default;
};

struct ImageHash {
  std::size_t operator()(const ImageRef& image) const {
    return std::hash<const Port*>()(image.port) ^
           (((std::size_t{image.node} << 8U) + image.part) * 0x9e3779b97f4a7c15U);
  }
};
/// To be looked up, never to be gone through: the order in it means nothing.
template <class T>
using ByImage = std::unordered_map<ImageRef, T, ImageHash>;

/// Where one part of an input comes from, after bypasses.
struct Source {
  ImageRef image;
  bool constant = false;  ///< the image's cleared stand-in
  uint32_t first_age = 0;
  uint32_t last_age = 0;
};

enum class Connection : uint8_t {
  connected,
  absent,     ///< no edge
  unneeded,   ///< the edge is sound, but with these params the pass does not read it (Port::needed_with)
  no_bypass,  ///< the edge leads to a disabled pass that has nothing in place of its output
  broken,     ///< reported
};

struct ResolvedInput {
  const Port* port = nullptr;
  const EdgeSpec* edge = nullptr;
  Connection state = Connection::absent;
  std::vector<Source> sources;  ///< one a part if connected
  std::vector<Source> ignored;  ///< the same if unneeded
  ImageRef culprit;             ///< no_bypass: what is missing
};

struct ResolvedOutput {
  const ConnectionSpec* spec = nullptr;
  Connection state = Connection::broken;
  Source source;
  ImageRef culprit;
};

/// Everything about wiring, by node index.
struct Wiring {
  std::vector<std::vector<ResolvedInput>> inputs;  ///< [node][input port in declared order]; disabled nodes: empty
  std::vector<ResolvedOutput> outputs;
};

/// The type that the file gives a pass, swaps aside; null if there is none of that name, or its shader is broken.
[[nodiscard]] inline const PassType* type_in_file(const PassSpec& pass, const PassRegistry& registry) {
  return pass.compute ? pass.own_type.get() : registry.find(pass.type.text);
}

/// link_variants.cpp: nodes from the file, with its variants checked and the chosen ones and the options applied.
[[nodiscard]] Nodes make_nodes(const Input& input, Report& report, std::vector<std::string>& notes);

/// link_swap.cpp: a swapped type keeps those of its predecessor's params and inputs that have the same name and kind;
/// the others are taken from the node, with a note each.
void drop_misfits(Node& node, const Nodes& nodes, const PassRegistry& registry, std::vector<std::string>& notes);

/// link_params.cpp: fills Node::resolved.
void resolve_params(Nodes& nodes, Report& report);
void warn_unused_params(const Nodes& nodes, const Input& input, Report& report);

/// link_formats.cpp: fills Node::formats.
void resolve_formats(Nodes& nodes, Report& report, std::vector<std::string>& notes);

/// link_edges.cpp: one value per declared input, bypasses followed.
class EdgeResolver {
 public:
  EdgeResolver(const Nodes& nodes, Report& report) : nodes_(nodes), report_(report) {}
  [[nodiscard]] Wiring resolve(const GraphSpec& spec);
  [[nodiscard]] ResolvedInput resolve_input(uint32_t node, const Port& port);

 private:
  /// Who takes what an edge brings.
  struct Consumer {
    const std::string& name;            ///< of the input, or of the graph's output
    const std::string* pass = nullptr;  ///< null: the graph
    [[nodiscard]] std::string text() const;
  };
  struct Target {
    uint32_t node = kNoNode;
    const Port* port = nullptr;
    std::optional<uint32_t> part;  ///< if the edge names one
  };
  struct Found {
    Connection state = Connection::broken;
    Source source;
    ImageRef culprit;
  };
  /// What stands in the end for an output, through the bypasses of disabled passes.
  struct Ending {
    Connection state = Connection::broken;
    ImageRef image;         ///< what stands there if connected; no_bypass: what is missing
    bool constant = false;  ///< its cleared stand-in
    uint32_t age = 0;       ///< of all edges on the way
    bool endless = false;   ///< the way leads back to `image`
  };
  [[nodiscard]] std::optional<Target> find_target(const EdgeSpec& edge, bool consumer_enabled);
  [[nodiscard]] std::optional<Target> find_port(const EdgeSpec& edge, uint32_t node);
  [[nodiscard]] bool check_kind(const Consumer& consumer, const Port& input, const EdgeSpec& edge,
                                const Target& target);
  [[nodiscard]] bool check_bundle(const Consumer& consumer, const Port& input, const EdgeSpec& edge,
                                  const Target& target);
  /// Through the bypasses of disabled passes to what stands in the end.
  [[nodiscard]] Found follow(const ImageRef& image, const EdgeSpec& edge);
  [[nodiscard]] Ending ending_of(const ImageRef& start);
  /// From an output of a disabled pass to what feeds the input that replaces it.
  [[nodiscard]] Found through_bypass(const ImageRef& image);
  [[nodiscard]] ResolvedOutput resolve_output(const ConnectionSpec& output);
  void check_node(uint32_t node, const std::vector<ResolvedInput>& inputs);
  const Nodes& nodes_;
  Report& report_;
  ByImage<Ending> endings_;  ///< of outputs of disabled passes
};

/// link_cycles.cpp: reports cycles over edges without '@'. True if there are none.
[[nodiscard]] bool check_cycles(const Nodes& nodes, const Wiring& wiring, Report& report);

/// link_shapes.cpp: the size that an option asks for, if there can be such an image; else the graph's own.
[[nodiscard]] Extent3 wanted_size(const SizeSpec& own, const std::optional<std::pair<uint32_t, uint32_t>>& wanted);

/// link_shapes.cpp: extents by rule, and whether connected images fit.
class ShapeResolver {
 public:
  ShapeResolver(const Nodes& nodes, const Wiring& wiring, EdgeResolver& edges, const Input& input, Report& report);
  /// Empty if it cannot be known; then that was reported.
  [[nodiscard]] std::optional<Extent3> extent_of(const ImageRef& image);
  void check_inputs(uint32_t node, const std::vector<ResolvedInput>& inputs);
  [[nodiscard]] Extent3 view() const { return view_; }
  [[nodiscard]] Extent3 trace() const { return trace_; }

 private:
  struct Known {
    bool in_progress = true;
    std::optional<Extent3> extent;
  };
  /// What a port's rule says: an extent, or that it is like an image; neither if nobody can know.
  struct Rule {
    std::optional<Extent3> extent;
    std::optional<ImageRef> like;
    Extent3 times = {};  ///< how often as large as that one
  };
  [[nodiscard]] Rule rule_of(uint32_t node, const Port& port);
  [[nodiscard]] Rule like_input(uint32_t node, const Port& port);
  [[nodiscard]] ResolvedInput input_of(uint32_t node, const Port& port);
  [[nodiscard]] Extent3 grid(const Node& node) const;
  const Nodes& nodes_;
  const Wiring& wiring_;
  EdgeResolver& edges_;
  const Input& input_;
  Report& report_;
  Extent3 view_;
  Extent3 trace_;
  ByImage<Known> known_;  ///< by the first part of a port
};

/// link_needs.cpp: which nodes run, and what is captured.
struct Needs {
  std::vector<bool> live;
  std::vector<std::string> culled;  ///< why a node that is not live is not needed; empty for others
  std::vector<ImageRef> captures;
};
[[nodiscard]] Needs find_needs(const Nodes& nodes, const Wiring& wiring, const LinkOptions& options, Report& report,
                               std::vector<std::string>& notes);
/// Reports outputs of disabled passes that a live consumer needs and that have no bypass.
void check_bypasses(const Nodes& nodes, const Wiring& wiring, const Needs& needs, Report& report);

/// link_assemble.cpp: the graph from checked parts. Empty if a shape is unknown.
[[nodiscard]] std::optional<Graph> assemble(const Nodes& nodes, const Wiring& wiring, const Needs& needs,
                                            ShapeResolver& shapes);

/// "pass.port" or "pass.port.part".
[[nodiscard]] std::string image_name(const Nodes& nodes, const ImageRef& image);

}  // namespace lightloom::linking
