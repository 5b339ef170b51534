#include "framework/run/probe.hpp"

#include <algorithm>
#include <map>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/image/exr.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "framework/run/probe_places.hpp"
#include "framework/run/value_doc.hpp"

namespace lightloom::run {
namespace {

using Key = std::pair<ValueId, uint32_t>;  ///< and its age

std::string port_text(const std::string& port, const std::string& part) {
  return part.empty() ? port : port + "." + part;
}

std::vector<bool> watched_values(const Graph& graph) {
  std::vector<bool> watched(graph.values.size(), false);
  // What nobody reads is not asked for either: a pass may leave it out, and asking would change that.
  for (const GraphPass& pass : graph.passes) {
    for (const Use& use : pass.outputs) watched[use.value] = graph.values[use.value].read;
    for (const Use& use : pass.scratch) watched[use.value] = true;
  }
  return watched;
}

/// The graph with every value that is watched read back, and every history at each age at which a pass reads it.
Graph watched_graph(const Graph& graph, const std::vector<bool>& watched) {
  Graph result = graph;
  result.captures.clear();
  for (ValueId id = 0; id < graph.values.size(); ++id)
    if (watched[id]) result.captures.push_back(id);
  for (const GraphPass& pass : graph.passes)
    for (const Use& use : pass.inputs)
      for (uint32_t age = std::max(use.first_age, 1u); age <= use.last_age; ++age)
        if (!graph.values[use.value].constant)
          result.outputs.push_back({value_name(graph.values[use.value]) + "@" + std::to_string(age), use.value, age});
  mark_reads(result);
  return result;
}

class Prober {
 public:
  Prober(const ProbeRequest& request, const scene::Scene& scene, const Graph& graph, const std::vector<bool>& watched)
      : scene_(scene),
        graph_(graph),
        watched_(watched),
        position_(surface_position(graph, watched)),
        places_(graph.values.size()) {
    for (ValueId id = 0; id < graph.values.size(); ++id)
      if (!is_volume(id)) places_[id].texel = texel_at(graph.values[id].desc.extent, graph.view, request.x, request.y);
  }

  /// Where the executor is to look now.
  [[nodiscard]] std::vector<VkOffset3D> offsets() const {
    std::vector<VkOffset3D> result;
    for (const ProbePlace& place : places_)
      result.push_back({static_cast<int32_t>(place.texel[0]), static_cast<int32_t>(place.texel[1]),
                        static_cast<int32_t>(place.texel[2])});
    return result;
  }

  /// Finds the point that the pixel sees in a frame that has run, and the voxels that hold it. Are there any?
  bool find_voxels(const FrameResult& result) {
    take(result);
    point_.reset();
    point_source_ = find_point();
    bool any = false;
    for (ValueId id = 0; id < graph_.values.size(); ++id) {
      if (!is_volume(id)) continue;
      places_[id] = point_ ? voxel_at(graph_.values[id].desc.extent, scene_.bounds, *point_)
                           : ProbePlace{.missing = point_source_};
      any = any || places_[id].missing.empty();
    }
    return any;
  }

  ProbedFrame report(const FrameResult& result, const Plan& plan) {
    take(result);
    ProbedFrame frame{.frame = result.frame,
                      .time = result.conditions.time,
                      .history_length = result.conditions.history_length,
                      .point = point_,
                      .origin = scene_.origin,
                      .point_source = point_source_,
                      .passes = {}};
    for (const auto* steps : {&plan.once, &plan.steps})
      for (const PlanStep& step : *steps) frame.passes.push_back(report(graph_.passes[step.pass]));
    return frame;
  }

 private:
  [[nodiscard]] bool is_volume(ValueId id) const { return graph_.values[id].desc.dimension == Dimension::d3; }

  void take(const FrameResult& result) {
    texels_.clear();
    for (size_t i = 0; i < graph_.captures.size(); ++i)
      texels_.insert_or_assign(Key{graph_.captures[i], 0}, result.captures.at(i).image);
    for (size_t i = 0; i < graph_.outputs.size(); ++i)
      texels_.insert_or_assign(Key{graph_.outputs[i].value, graph_.outputs[i].age}, result.outputs.at(i).image);
  }

  /// Sets the point and returns the value it is from, or leaves it and returns why there is none.
  std::string find_point() {
    if (!position_) return "no value of the graph says which surface point a pixel sees";
    const image::HostImage& texel = texels_.at({*position_, 0});
    const auto number = [&](uint32_t channel) { return static_cast<float>(texel.at(0, 0, 0, channel)); };
    const std::string name = value_name(graph_.values[*position_]);
    if (number(3) == 0) return "the pixel sees the background, says " + name;
    point_ = glm::vec3(number(0), number(1), number(2));
    return name;
  }

  [[nodiscard]] ProbedPass report(const GraphPass& pass) const {
    ProbedPass probed{pass.name, pass.type->name, pass.once, {}, {}, {}, {}};
    for (const ParamSet::Entry& entry : pass.params.entries())
      probed.params.emplace_back(entry.param->name, entry.value);
    for (const Use& use : pass.inputs)
      for (uint32_t age = use.first_age; age <= use.last_age; ++age) probed.inputs.push_back(report(use, age));
    for (const Use& use : pass.outputs) probed.outputs.push_back(report(use, 0));
    for (const Use& use : pass.scratch) probed.scratch.push_back(report(use, 0));
    return probed;
  }

  [[nodiscard]] ProbedTexel report(const Use& use, uint32_t age) const {
    const Value& value = graph_.values[use.value];
    ProbedTexel probed;
    probed.port = port_text(use.port, use.part);
    probed.value = value_name(value);
    probed.age = age;
    probed.desc = value.desc;
    probed.channels = image::default_channel_names(value.desc, value.port, value.part);
    probed.doc = value_doc(graph_, value);
    probed.place = places_[use.value].texel;
    probed.missing = places_[use.value].missing;
    if (value.constant) {
      probed.missing = "the same everywhere: " + color_text(*value.constant, probed.channels.size());
    } else if (!watched_[use.value]) {
      probed.missing = "nobody reads it, so it need not be there";
    } else if (probed.missing.empty()) {
      probed.texel = texels_.at({use.value, age});
    }
    return probed;
  }

  static std::string color_text(const ClearColor& color, size_t channels) {
    std::string text = lightloom::to_string(ParamValue(double{color[0]}));
    for (size_t channel = 1; channel < channels; ++channel)
      text += ", " + lightloom::to_string(ParamValue(double{color[channel]}));
    return text;
  }

  const scene::Scene& scene_;
  const Graph& graph_;
  const std::vector<bool>& watched_;
  std::optional<ValueId> position_;
  std::vector<ProbePlace> places_;  ///< by value
  std::optional<glm::vec3> point_;
  std::string point_source_;
  std::map<Key, image::HostImage> texels_;
};

void require_pixel(const ProbeRequest& request, const Extent3& view) {
  if (request.x < view.width && request.y < view.height) return;
  throw Error(ExitCode::usage,
              "pixel " + std::to_string(request.x) + "," + std::to_string(request.y) + " lies outside the view of " +
                  std::to_string(view.width) + "x" + std::to_string(view.height) + " pixels",
              "the first is 0,0 at the top left, the last " + std::to_string(view.width - 1) + "," +
                  std::to_string(view.height - 1));
}

void probe_frames(const ProbeRequest& request, Prober& prober, Executor& executor, const FrameCallback& on_frame,
                  ProbeReport& report) {
  const RenderRequest& render = request.render;
  executor.look_at(prober.offsets());
  for (uint32_t frame = render.first_frame; frame <= render.last_frame; ++frame) {
    const bool reported = request.every || frame == render.last_frame;
    FrameResult result = executor.run_frame(frame, {.outputs = reported, .captures = reported});
    if (reported) {
      if (prober.find_voxels(result)) {
        executor.look_at(prober.offsets());
        result = executor.repeat_frame();
      }
      report.frames.push_back(prober.report(result, executor.plan()));
    }
    if (on_frame) on_frame(frame - render.first_frame + 1, render.last_frame - render.first_frame + 1);
  }
}

}  // namespace

bool probe(const ProbeRequest& request, const PassRegistry& registry, const FrameCallback& on_frame,
           Diagnostics& diagnostics, ProbeReport& report) {
  const RenderRequest& render = request.render;
  const scene::Scene scene = scene::load_scene(render.scene, render.load);
  std::optional<scene::CameraPath> path;
  if (!render.camera_path.empty()) path = scene::read_camera_path(render.camera_path, render.load.limits);
  const std::optional<Graph> graph =
      link_text(read_text_file(render.graph), render.graph, registry, render.link, &scene, diagnostics, render.shaders);
  if (!graph) return false;
  require_pixel(request, graph->view);
  const std::vector<bool> watched = watched_values(*graph);
  const Graph seen = watched_graph(*graph, watched);
  gpu::Device device(render.device);
  Executor executor(device, compile(seen, render.compile), scene,
                    {.shaders = render.shaders,
                     .camera = render.camera,
                     .camera_path = path,
                     .seed = render.seed,
                     .frames_per_second = render.frames_per_second,
                     .frozen_time = render.frozen_time,
                     .share_memory = render.share_memory,
                     .single_texels = true});
  Prober prober(request, scene, seen, watched);
  report = {.graph = graph->name,
            .view = graph->view,
            .frames = {},
            .culled = graph->culled,
            .bypassed = graph->bypassed,
            .warnings = scene.warnings};
  probe_frames(request, prober, executor, on_frame, report);
  const std::vector<std::string>& more = executor.scene_warnings();
  report.warnings.insert(report.warnings.end(), more.begin(), more.end());
  for (const gpu::ValidationMessage& message : device.validation_messages())
    report.warnings.push_back("validation: " + message.text);
  return true;
}

}  // namespace lightloom::run
