#include "framework/run/host_passes.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/gpu/transfer.hpp"
#include "framework/run/readback.hpp"

namespace lightloom::run {
namespace {

std::string port_name(std::string_view port, std::string_view part) {
  return "'" + std::string(port) + (part.empty() ? "" : "." + std::string(part)) + "'";
}

/// Only what the type declares to read is there; the rest is the same in every frame, so that a pass which is hoisted
/// cannot depend on it.
class DeclaredScene {
 public:
  DeclaredScene(const scene::FrameScene& frame, FrameState reads) : shown_(frame) {
    const auto any = [&](FrameState state) { return (reads & state) != FrameState::none; };
    if (!any(FrameState::camera)) shown_.camera = frame.scene->cameras.front();
    if (!any(FrameState::time)) shown_.time = 0;
    if (!any(FrameState::seed)) shown_.seed = 0;
    if (!any(FrameState::time | FrameState::seed)) shown_.frame = 0;
    if (any(FrameState::dynamic_geometry) && any(FrameState::lights) && any(FrameState::camera)) return;
    const std::vector<scene::Vertex>& all = frame.scene->vertices;
    pose_.dynamic_vertices =
        any(FrameState::dynamic_geometry)
            ? frame.pose->dynamic_vertices
            : std::vector<scene::Vertex>(all.begin() + frame.scene->static_vertex_count, all.end());
    pose_.punctual = any(FrameState::lights) ? frame.pose->punctual : frame.scene->punctual;
    pose_.cameras = any(FrameState::camera) ? frame.pose->cameras : frame.scene->cameras;
    shown_.pose = &pose_;
  }
  DeclaredScene(const DeclaredScene&) = delete;
  DeclaredScene& operator=(const DeclaredScene&) = delete;

  [[nodiscard]] const scene::FrameScene& shown() const { return shown_; }

 private:
  scene::FrameScene shown_;
  scene::Pose pose_;
};

class Context final : public HostContext {
 public:
  using Buffers = std::map<std::pair<ValueId, uint32_t>, gpu::Buffer>;

  Context(const Graph& graph, const GraphPass& pass, const HostFrame& frame, const Buffers& inputs)
      : graph_(graph), pass_(pass), frame_(frame), inputs_(inputs) {
    if (const FrameState reads = pass.type->reads_of(pass.params); reads != FrameState::none)
      scene_.emplace(*frame.scene, reads);
    for (const Use& use : pass.outputs) written_.emplace_back(byte_size(graph.values[use.value].desc));
  }

  [[nodiscard]] const ParamSet& params() const override { return pass_.params; }

  [[nodiscard]] bool connected(std::string_view input_port) const override {
    return std::any_of(pass_.inputs.begin(), pass_.inputs.end(),
                       [&](const Use& use) { return use.port == input_port; });
  }

  [[nodiscard]] bool wanted(std::string_view output_port) const override {
    return std::any_of(pass_.outputs.begin(), pass_.outputs.end(),
                       [&](const Use& use) { return use.port == output_port && graph_.values[use.value].read; });
  }

  [[nodiscard]] HostInput input(std::string_view port, std::string_view part) const override {
    for (const Use& use : pass_.inputs) {
      if (use.port != port || use.part != part) continue;
      const ImageDesc& desc = graph_.values[use.value].desc;
      return {desc.format, desc.extent, inputs_.at({use.value, use.first_age}).mapped()};
    }
    fail("has no connected input " + port_name(port, part));
  }

  [[nodiscard]] HostOutput output(std::string_view port, std::string_view part) override {
    for (size_t i = 0; i < pass_.outputs.size(); ++i) {
      const Use& use = pass_.outputs[i];
      if (use.port != port || use.part != part) continue;
      const ImageDesc& desc = graph_.values[use.value].desc;
      return {desc.format, desc.extent, written_[i]};
    }
    fail("has no output " + port_name(port, part));
  }

  [[nodiscard]] const scene::FrameScene& scene() const override {
    if (!scene_) fail("reads the scene, which its type does not declare");
    return scene_->shown();
  }

  /// In the order of the pass's outputs.
  [[nodiscard]] const std::vector<std::vector<std::byte>>& written() const { return written_; }

 protected:
  const std::shared_ptr<const void>& derived_slot(std::type_index type,
                                                  const std::function<std::shared_ptr<const void>()>& make) override {
    return frame_.memo->get(type, make);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(ExitCode::run_failed, "pass '" + pass_.name + "' (" + pass_.type->name + ") " + what);
  }

  const Graph& graph_;
  const GraphPass& pass_;
  HostFrame frame_;
  const Buffers& inputs_;
  std::optional<DeclaredScene> scene_;
  std::vector<std::vector<std::byte>> written_;
};

}  // namespace

HostPasses::HostPasses(const gpu::Device& device, const Plan& plan) {
  const Graph& graph = plan.graph;
  for (const GraphPass& pass : graph.passes) {
    if (!pass.type->host) continue;
    const auto name = [&](const Use& use) {
      return pass.name + " on the host: " + value_name(graph.values[use.value]);
    };
    for (const Use& use : pass.inputs)
      inputs_.try_emplace({use.value, use.first_age}, device, byte_size(graph.values[use.value].desc), 0,
                          gpu::MemoryKind::readback, name(use));
    for (const Use& use : pass.outputs)
      if (graph.values[use.value].read)
        outputs_.try_emplace(use.value, device, byte_size(graph.values[use.value].desc), 0, gpu::MemoryKind::upload,
                             name(use));
  }
}

void HostPasses::record_inputs(VkCommandBuffer commands, const GraphPass& pass, const ValueImages& images,
                               uint64_t frame_count) const {
  for (const Use& use : pass.inputs) {
    const ValueLayer layer = images.layer(use.value, use.first_age, frame_count);
    gpu::record_image_to_buffer(commands, *layer.image, gpu::whole_level(*layer.image, layer.layer),
                                VK_IMAGE_LAYOUT_GENERAL, inputs_.at({use.value, use.first_age}).get(), 0);
  }
  if (!pass.inputs.empty()) Readback::record_end(commands);
}

double HostPasses::run(const Graph& graph, const GraphPass& pass, const HostFrame& frame) const {
  using Clock = std::chrono::steady_clock;
  Context context(graph, pass, frame, inputs_);
  const Clock::time_point start = Clock::now();
  pass.type->host(context);
  const std::chrono::duration<double, std::milli> elapsed = Clock::now() - start;
  for (size_t i = 0; i < pass.outputs.size(); ++i) {
    const auto target = outputs_.find(pass.outputs[i].value);
    if (target == outputs_.end()) continue;
    const std::vector<std::byte>& texels = context.written()[i];
    std::memcpy(target->second.mapped().data(), texels.data(), texels.size());
  }
  return elapsed.count();
}

void HostPasses::record_outputs(VkCommandBuffer commands, const Graph& graph, const GraphPass& pass,
                                const ValueImages& images, uint64_t frame_count) const {
  for (const Use& use : pass.outputs) {
    if (!graph.values[use.value].read) continue;
    const ValueLayer layer = images.layer(use.value, 0, frame_count);
    gpu::record_buffer_to_image(commands, outputs_.at(use.value).get(), 0, *layer.image,
                                gpu::whole_level(*layer.image, layer.layer), VK_IMAGE_LAYOUT_GENERAL);
  }
}

}  // namespace lightloom::run
