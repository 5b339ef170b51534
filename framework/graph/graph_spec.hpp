#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/desc.hpp"
#include "framework/graph/param.hpp"
#include "framework/graph/pass_type.hpp"

namespace lightloom {

/// The graph file as written: every value with its place, nothing resolved. All lists are in file order.

struct TextSpec {
  std::string text;
  SourceLocation where;
};

/// A scalar under `params` or `set`. A string that begins with `$` names a graph param where a pass param stands.
struct ScalarSpec {
  std::string name;
  SourceLocation name_where;
  ParamValue value;
  SourceLocation where;
  bool broken = false;  ///< was reported; its value means nothing
};

/// "pass.port", "pass.port.part", each with an optional "@k" (k frames ago) or "@a..b".
struct EdgeSpec {
  std::string pass;
  std::string port;
  std::string part;  ///< empty: the whole port
  uint32_t first_age = 0;
  uint32_t last_age = 0;
  std::string text;
  SourceLocation where;
};

/// `name` is an input port of the pass, or the name of an output of the graph.
struct ConnectionSpec {
  std::string name;
  SourceLocation name_where;
  EdgeSpec edge;
};

/// In which format values are stored: those of a node ("port" or "port.part"), or those that match a pattern over
/// "pass.port" and "pass.port.part".
struct FormatSpec {
  std::string values;
  SourceLocation values_where;
  TextSpec format;  ///< "rgba16_sfloat"
};

/// What a node of type `compute` says of an output of its shader; what is left out follows from the shader.
struct ComputeOutputSpec {
  std::string name;
  SourceLocation name_where;
  std::optional<TextSpec> format;             ///< "rgba16_sfloat"
  std::optional<TextSpec> size;               ///< "view", "trace", "grid", "like INPUT", "640x480", "64x64x64"
  std::optional<TextSpec> bypass;             ///< the input that replaces it …
  std::optional<ClearColor> bypass_constant;  ///< … or the constant
};

/// The type of a node of type `compute`.
constexpr std::string_view kComputeType = "compute";

/// The condition of `when` that the trace has another size than the view.
constexpr std::string_view kSizesDiffer = "sizes.differ";

struct ComputeSpec {
  TextSpec shader;  ///< file, as written
  std::vector<ComputeOutputSpec> outputs;
  std::optional<TextSpec> threads;  ///< name of the output that has a thread for each texel
};

struct PassSpec {
  std::string name;
  SourceLocation where;  ///< of the key
  TextSpec type;
  std::vector<ConnectionSpec> inputs;
  std::vector<ScalarSpec> params;
  std::vector<FormatSpec> formats;
  bool enabled = true;
  SourceLocation enabled_where;
  std::optional<TextSpec> when;
  std::string doc;
  std::optional<ComputeSpec> compute;  ///< exactly if the type is `compute`
  /// The pass type of this node alone, made from its shader by who can compile it (framework/run/compute_types.hpp).
  std::shared_ptr<const PassType> own_type;
};

struct SwapSpec {
  TextSpec pass;  ///< name or glob
  TextSpec type;
};

struct VariantSpec {
  std::string name;
  SourceLocation where;
  std::string doc;
  std::vector<TextSpec> disable;
  std::vector<ScalarSpec> set;  ///< names are "PARAM" or "PASS.PARAM", PASS may be a glob
  std::vector<SwapSpec> swap;
  std::vector<FormatSpec> formats;
};

struct SizeSpec {
  uint32_t width = 0;
  uint32_t height = 0;
  SourceLocation where;
};

constexpr uint32_t kMaximumAge = 15;
constexpr uint32_t kMaximumImageSize = 16384;

struct GraphSpec {
  std::string file;
  std::string name;
  SizeSpec view{1280, 960, {}};
  SizeSpec trace{640, 480, {}};
  std::vector<ScalarSpec> params;
  std::vector<PassSpec> passes;
  std::vector<ConnectionSpec> outputs;
  std::vector<VariantSpec> variants;
};

/// Reads a graph file's text, reporting every problem. What is wrong is left out or empty (an edge without `pass`, a
/// type without `text`), so that `link` can go on looking for more; the result is empty only where the text is no JSON
/// object, or one of another version. Ask `diagnostics.has_errors()`. Never throws.
[[nodiscard]] std::optional<GraphSpec> parse_graph(std::string_view text, const std::string& file_name,
                                                   Diagnostics& diagnostics);

/// Parses the text of an edge. On failure returns a sentence that says what is wrong.
struct EdgeParse {
  std::optional<EdgeSpec> edge;
  std::string problem;
};
[[nodiscard]] EdgeParse parse_edge(std::string_view text);

/// [a-z][a-z0-9_]*
[[nodiscard]] bool is_name(std::string_view text);

}  // namespace lightloom
