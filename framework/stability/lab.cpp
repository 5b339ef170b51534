#include "framework/stability/lab.hpp"

#include <stdlib.h>

#include <system_error>
#include <utility>

#include "framework/base/diagnostics.hpp"
#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/graph/graph_spec.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/compute_types.hpp"
#include "framework/run/executor.hpp"

namespace lightloom::stability {
namespace {

[[noreturn]] void fail(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.sorted())
    text += (text.empty() ? "" : "\n") + format_diagnostic(diagnostic);
  throw Error(ExitCode::invalid_input, text);
}

std::filesystem::path make_temporary_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "lightloom_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw Error(ExitCode::run_failed, "cannot make a temporary folder " + name);
  return name;
}

}  // namespace

Lab::Lab(gpu::Device& device, const PassRegistry& registry, run::ShaderFolders shaders)
    : device_(device), registry_(registry), shaders_(std::move(shaders)) {}

Lab::~Lab() {
  std::error_code ignored;
  if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
}

const std::filesystem::path& Lab::folder() {
  if (folder_.empty()) folder_ = make_temporary_folder();
  return folder_;
}

Plan Lab::plan(std::string_view graph_json, const scene::Scene& scene, const LinkOptions& options) const {
  Diagnostics diagnostics;
  std::optional<GraphSpec> spec = parse_graph(graph_json, "stability.json", diagnostics);
  if (!spec) fail(diagnostics);
  run::make_compute_types(*spec, registry_, shaders_, diagnostics);
  const std::optional<Graph> graph = link(*spec, registry_, options, run::link_environment(&scene), diagnostics);
  if (!graph) fail(diagnostics);
  return compile(*graph);
}

void Lab::visit(std::string_view graph_json, const scene::Scene& scene, const RunOptions& options,
                const FrameVisitor& visitor) {
  LinkOptions link_options = options.link;
  link_options.captures.insert(link_options.captures.end(), options.capture.begin(), options.capture.end());
  run::Executor executor(device_, plan(graph_json, scene, link_options), scene,
                         {.shaders = shaders_,
                          .camera = options.camera,
                          .seed = options.seed,
                          .frames_per_second = 30,
                          .frozen_time = options.frozen_time,
                          .share_memory = options.share_memory});
  for (uint32_t frame = options.first_frame; frame - options.first_frame < options.frames; ++frame) {
    run::FrameResult result = executor.run_frame(frame);
    Images images;
    for (run::NamedImage& output : result.outputs) images.insert_or_assign(output.name, std::move(output.image));
    for (run::NamedImage& capture : result.captures) images.insert_or_assign(capture.name, std::move(capture.image));
    visitor(frame, std::move(images));
  }
}

std::vector<Images> Lab::frames(std::string_view graph_json, const scene::Scene& scene, const RunOptions& options) {
  std::vector<Images> all;
  visit(graph_json, scene, options, [&](uint32_t, Images images) { all.push_back(std::move(images)); });
  return all;
}

Images Lab::last_frame(std::string_view graph_json, const scene::Scene& scene, const RunOptions& options) {
  Images last;
  visit(graph_json, scene, options, [&](uint32_t, Images images) { last = std::move(images); });
  return last;
}

std::string Lab::shipped_graph(const std::string& name) const {
  // Graphs lie beside the shaders, in the source tree as in an installation.
  for (const std::filesystem::path& sources : shaders_.sources) {
    const std::filesystem::path file = sources.parent_path() / "graphs" / (name + ".json");
    if (std::filesystem::is_regular_file(file)) return read_text_file(file);
  }
  throw Error(ExitCode::run_failed, "the graph '" + name + "' is not found beside the shaders");
}

}  // namespace lightloom::stability
