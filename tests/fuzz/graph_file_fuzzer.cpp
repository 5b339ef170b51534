// Graph files through every phase from the text to the verified plan: refused with a diagnostic, or a plan without a
// violation.
#include <cstdlib>
#include <string_view>

#include "framework/base/error.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/plan.hpp"
#include "framework/graph/verify.hpp"
#include "passes/registry.hpp"

namespace {

using namespace lightloom;

const PassRegistry& types() {
  static const PassRegistry registry = [] {
    PassRegistry result;
    passes::register_builtin_passes(result);
    return result;
  }();
  return registry;
}

LinkEnvironment environment() {
  LinkEnvironment result;
  for (const char* feature : {"emissive", "sun", "punctual", "environment", "environment_image", "textured", "alpha",
                              "normal_mapped", "specular", "anisotropic", "metallic", "dynamic"})
    result.scene_features.emplace_back(feature, true);
  return result;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const LinkEnvironment surroundings = environment();
  Diagnostics diagnostics;
  try {
    const auto spec =
        parse_graph(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz.json", diagnostics);
    if (!spec) {
      if (!diagnostics.has_errors()) std::abort();
      return 0;
    }
    const auto graph = link(*spec, types(), {}, surroundings, diagnostics);
    if (!graph) {
      if (!diagnostics.has_errors()) std::abort();
      return 0;
    }
    const Plan plan = compile(*graph, {});
    if (!verify(plan).violations.empty()) std::abort();
  } catch (const Error&) {
    return 0;
  }
  return 0;
}
