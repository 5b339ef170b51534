#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/base/diagnostics.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"

namespace lightloom::toy {

/// Pass types made up for the tests, small enough to be seen at a glance; inputs -> outputs:
///   source () -> a [view]                       params level 0..1, count 1..8, mode one|two, flag
///   small () -> a [trace]                       these and ids, raster, volume: another in each frame
///   ids () -> a [view, uint]
///   still () -> a [view]                        the same in each frame
///   body () -> a [view]                         param geometry static|dynamic
///   patch (x) -> a, bypass x                    a and its scratch memo are persistent
///   filter (x, y?) -> a, bypass x               param strength
///   choosy (x, y?) -> a, bypass x               param reading one|both: with one it does not need y
///   strange (x, y? {u, v}) -> a, bypass x       params strength weak|strong and taps, a real
///   blur (x) -> a, bypass x                     params strength, taps
///   mix (x, y like x) -> a                      scratch tmp
///   black (x) -> a, bypass constant
///   trail (x, past[]) -> a, bypass x
///   accumulate (x, last like x) -> a, bypass x
///   raster () -> p {u, v} [view]                attachments, scratch depth
///   pairs (p) -> p, bypass p
///   pick (p) -> a
///   shade (x) -> a                              read and written by the fragment stage
///   volume () -> v [grid]                       param resolution
///   carve (v) -> v, bypass v
///   sink (x) -> nothing, side effect
[[nodiscard]] const PassRegistry& registry();

struct Result {
  Diagnostics diagnostics;
  std::optional<Graph> graph;
  [[nodiscard]] std::vector<std::string> codes() const;  ///< of the sorted diagnostics
  [[nodiscard]] std::string text() const;                ///< for failure messages
};

[[nodiscard]] LinkEnvironment environment(bool dynamic = true);

/// Links a whole graph file.
[[nodiscard]] Result link_text(const std::string& text, const LinkOptions& options = {},
                               const PassRegistry& types = registry(), const LinkEnvironment& against = environment());

/// `passes` are the members of "passes", `outputs` those of "outputs", `rest` further members of the graph, each with a
/// comma at its end.
[[nodiscard]] std::string file(const std::string& passes, const std::string& outputs, const std::string& rest = {});

/// The graph of a file that must link; a test failure and an empty graph otherwise.
[[nodiscard]] Graph graph_of(const std::string& text, const LinkOptions& options = {},
                             const PassRegistry& types = registry(), const LinkEnvironment& against = environment());
[[nodiscard]] Plan plan_of(const std::string& text, const LinkOptions& options = {});

[[nodiscard]] std::vector<std::string> order(const Plan& plan);  ///< names of passes
[[nodiscard]] const GraphPass& pass(const Graph& graph, const std::string& name);
/// "pass.port[.part]" with "@a" or "@a..b" of what is bound to an input; "" if nothing is.
[[nodiscard]] std::string source(const Graph& graph, const std::string& pass_name, const std::string& port,
                                 const std::string& part = {});

}  // namespace lightloom::toy
