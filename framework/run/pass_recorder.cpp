#include "framework/run/pass_recorder.hpp"

#include <algorithm>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/gpu/rendering.hpp"
#include "framework/graph/voxel_box.hpp"
#include "framework/run/moved_boxes.hpp"
#include "framework/run/pass_bindings.hpp"
#include "framework/run/scene_reads.hpp"

namespace lightloom::run {
namespace {

std::string describe(const GraphPass& pass) {
  return "pass '" + pass.name + "' (" + pass.type->name + ")";
}

[[noreturn]] void fail(const GraphPass& pass, const std::string& what) {
  throw Error(ExitCode::run_failed, describe(pass) + ": " + what);
}

uint32_t groups(uint32_t threads, uint32_t local_size) {
  return (threads + local_size - 1) / local_size;
}

}  // namespace

PassRecorder::PassRecorder(const RecordingEnvironment& environment, const Graph& graph, const GraphPass& pass)
    : environment_(environment),
      graph_(graph),
      pass_(pass),
      resources_(port_resources(pass, *environment.images, environment.frame_count)),
      known_values_(known_shader_values(pass, *environment.images, environment.frame_count, environment.scene->values)),
      hazards_(pass) {}

Extent3 PassRecorder::input_extent(std::string_view port) const {
  for (const Use& use : pass_.inputs)
    if (use.port == port) return graph_.values[use.value].desc.extent;
  fail(pass_, "has no connected input '" + std::string(port) + "'");
}

Extent3 PassRecorder::output_extent(std::string_view port) const {
  for (const std::vector<Use>* uses : {&pass_.outputs, &pass_.scratch})
    for (const Use& use : *uses)
      if (use.port == port) return graph_.values[use.value].desc.extent;
  fail(pass_, "has no output '" + std::string(port) + "'");
}

bool PassRecorder::connected(std::string_view input_port) const {
  return std::any_of(pass_.inputs.begin(), pass_.inputs.end(), [&](const Use& use) { return use.port == input_port; });
}

bool PassRecorder::kept(std::string_view port) const {
  const auto persistent = std::find_if(pass_.type->ports.begin(), pass_.type->ports.end(), [&](const Port& candidate) {
    return candidate.persistent && candidate.name == port && candidate.direction != Direction::in;
  });
  if (persistent == pass_.type->ports.end())
    fail(pass_, "asks whether '" + std::string(port) + "' was kept, which is not a persistent port");
  for (const std::vector<Use>* uses : {&pass_.outputs, &pass_.scratch})
    for (const Use& use : *uses)
      if (use.port == port && !graph_.values[use.value].persistent) return false;
  return environment_.frame_count > 0;
}

bool PassRecorder::wanted(std::string_view output_port) const {
  return std::any_of(pass_.outputs.begin(), pass_.outputs.end(),
                     [&](const Use& use) { return use.port == output_port && graph_.values[use.value].read; });
}

std::vector<VoxelBox> PassRecorder::moved_boxes(const Extent3& grid) const {
  // What an older value differs in is where things moved in earlier frames, which nobody keeps.
  if (dynamic_triangles().count > 0 && pass_.looks_back) return {whole_grid(grid)};
  return run::moved_boxes(environment_.scene->bounds, grid, environment_.scene->moved);
}

void PassRecorder::finish() {
  record_dependencies(environment_.commands, hazards_.finish());
}

void PassRecorder::clear(std::string_view port, const ClearColor& color) {
  const std::vector<Touch> touches = port_touches(pass_, port, Access::transfer_write);
  if (touches.empty()) fail(pass_, "clears '" + std::string(port) + "', which is neither an output nor a scratch port");
  record_dependencies(environment_.commands, hazards_.before(touches));
  for (const std::vector<Use>* uses : {&pass_.outputs, &pass_.scratch}) {
    for (const Use& use : *uses) {
      if (use.port != port) continue;
      const ValueLayer layer = environment_.images->layer(use.value, 0, environment_.frame_count);
      record_clear(environment_.commands, *layer.image, layer.layer, color);
    }
  }
  environment_.watch->clears(pass_, port);
}

std::vector<ShaderValue> PassRecorder::values_for(const gpu::Reflection& reflection,
                                                  const std::vector<ShaderValue>& own) const {
  std::vector<ShaderValue> values;
  const auto resolve = [&](const std::string& name) {
    for (const std::vector<ShaderValue>* source : {&own, &known_values_})
      for (const ShaderValue& value : *source)
        if (value.name == name) return value;
    constexpr std::string_view kWanted = "_wanted";
    if (name.size() > kWanted.size() && name.compare(name.size() - kWanted.size(), kWanted.size(), kWanted) == 0)
      return ShaderValue{name, wanted(std::string_view(name).substr(0, name.size() - kWanted.size()))};
    if (auto stored = storage_value(pass_, graph_.values, name)) return *std::move(stored);
    fail(pass_, "shader '" + reflection.name + "' has a constant '" + name +
                    "', which is neither a param, nor a feature of scenes, nor given by the pass");
  };
  for (const gpu::SpecializationConstant& constant : reflection.constants) values.push_back(resolve(constant.name));
  for (const gpu::BlockMember& member : reflection.push_constants) values.push_back(resolve(member.name));
  return values;
}

VkDescriptorSet PassRecorder::bind_resources(const gpu::Pipeline& pipeline) const {
  gpu::ResourceMap stand_ins;
  const auto lookup = [&](const gpu::Binding& binding) -> const gpu::Resource* {
    if (const auto own = resources_.find(binding.name); own != resources_.end()) return &own->second;
    if (const auto shared = environment_.scene->resources.find(binding.name);
        shared != environment_.scene->resources.end()) {
      require_declared_read(pass_, binding, pipeline.reflection().name);
      return &shared->second;
    }
    if (!names_unconnected_input(pass_, binding.name)) return nullptr;
    return &stand_ins.emplace(binding.name, gpu::resource(environment_.placeholders->view(binding))).first->second;
  };
  return environment_.descriptors->allocate(pipeline, lookup);
}

const gpu::ShaderProgram& PassRecorder::watched_program(const std::vector<std::string>& files) const {
  const gpu::ShaderProgram& program = environment_.shaders->program(files);
  environment_.watch->runs(pass_, program.reflection,
                           [&](std::string_view name) { return environment_.shaders->declaration(files, name); });
  return program;
}

void PassRecorder::dispatch(const Dispatch& dispatch) {
  const gpu::ShaderProgram& program = watched_program({dispatch.shader});
  const std::vector<ShaderValue> values = values_for(program.reflection, dispatch.values);
  const std::vector<ShaderValue> constants = specialization_values(program.reflection, values);
  const gpu::Pipeline& pipeline = environment_.shaders->pipelines().compute(program, constants);
  record_dependencies(environment_.commands, hazards_.before(bound_touches(pass_, program.reflection)));
  pipeline.bind(environment_.commands, bind_resources(pipeline),
                gpu::encode_push_constants(pipeline.reflection(), values));
  const auto& local = program.reflection.local_size;
  vkCmdDispatch(environment_.commands, groups(dispatch.threads.width, local[0]),
                groups(dispatch.threads.height, local[1]), groups(dispatch.threads.depth, local[2]));
}

const Use& PassRecorder::written_use(std::string_view shader_name) const {
  for (const std::vector<Use>* uses : {&pass_.outputs, &pass_.scratch})
    for (const Use& use : *uses)
      if (use.shader_name == shader_name) return use;
  fail(pass_, "draws into '" + std::string(shader_name) + "', which is neither an output nor a scratch port");
}

gpu::ImageView PassRecorder::written_view(const Use& use) const {
  return environment_.images->view(use.value, 0, environment_.frame_count);
}

void PassRecorder::draw(const Draw& draw) {
  const gpu::ShaderProgram& program = watched_program({draw.vertex_shader, draw.fragment_shader});
  std::vector<Touch> touches = bound_touches(pass_, program.reflection);
  std::vector<gpu::ColorTarget> colors;
  gpu::AttachmentFormats formats;
  for (const gpu::FragmentOutput& output : program.reflection.outputs) {
    const Use& use = written_use(output.name);
    touches.push_back(written_touch(pass_, use, Access::color_attachment_write));
    const gpu::ImageView view = written_view(use);
    colors.push_back({view, {}});
    formats.colors.push_back(view.format);
  }
  Extent3 extent = draw.area;
  std::optional<gpu::DepthTarget> depth;
  if (!draw.depth_port.empty()) {
    const Use& use = written_use(draw.depth_port);
    touches.push_back(written_touch(pass_, use, Access::depth_attachment_write));
    depth = gpu::DepthTarget{written_view(use), draw.keep_depth ? std::nullopt : std::optional(1.0f)};
    formats.depth = depth->view.format;
    extent = graph_.values[use.value].desc.extent;
    if (!draw.keep_depth) environment_.watch->clears(pass_, use.port);
  }
  const std::vector<ShaderValue> values = values_for(program.reflection, draw.values);
  const gpu::Pipeline& pipeline =
      environment_.shaders->pipelines().graphics(program, specialization_values(program.reflection, values), formats);
  record_dependencies(environment_.commands, hazards_.before(touches));
  gpu::begin_rendering(environment_.commands, {extent.width, extent.height}, colors, depth);
  pipeline.bind(environment_.commands, bind_resources(pipeline),
                gpu::encode_push_constants(pipeline.reflection(), values));
  for (const TriangleRange& range : draw.triangles)
    vkCmdDraw(environment_.commands, range.count * 3, 1, range.first * 3, 0);
  vkCmdEndRendering(environment_.commands);
}

}  // namespace lightloom::run
