#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/gpu/shader_compiler.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// Compiled shader programs by file names, and their pipelines.
class ShaderLibrary {
 public:
  ShaderLibrary(const gpu::Device& device, gpu::ShaderCompilerOptions options)
      : compiler_(std::move(options)), pipelines_(device) {}
  const gpu::ShaderProgram& program(const std::vector<std::string>& files);
  [[nodiscard]] gpu::PipelineCache& pipelines() { return pipelines_; }

 private:
  gpu::ShaderCompiler compiler_;
  gpu::PipelineCache pipelines_;
  std::map<std::vector<std::string>, gpu::ShaderProgram> programs_;
};

/// What scene and frame offer to shaders.
struct SceneBindings {
  gpu::ResourceMap resources;       ///< by the names of shaders/lib/scene.glsl and textures.glsl
  std::vector<ShaderValue> values;  ///< `has_<feature>`, and which textures there are (shaders/lib/features.glsl)
  TriangleRange static_triangles;
  TriangleRange dynamic_triangles;
};

/// Stands in for an optional input that is not connected, by the shape and numeric class that the shader declares.
class Placeholders {
 public:
  explicit Placeholders(gpu::Device& device);
  [[nodiscard]] gpu::ImageView view(const gpu::Binding& binding) const;

 private:
  std::vector<gpu::Image> images_;  ///< 2D and 3D, floating and unsigned
};

/// All that recording a pass needs and that is the same for every pass of a frame.
struct RecordingEnvironment {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const ValueImages* images = nullptr;
  uint64_t frame_count = 0;  ///< frames since the start: selects ring layers
  const SceneBindings* scene = nullptr;
  const Placeholders* placeholders = nullptr;
  ShaderLibrary* shaders = nullptr;
  gpu::DescriptorAllocator* descriptors = nullptr;
};

/// The context that a pass records through: finds shaders, binds ports and scene by name, fills constants by name, and
/// separates one command from the next.
class PassRecorder final : public PassContext {
 public:
  PassRecorder(const RecordingEnvironment& environment, const Graph& graph, const GraphPass& pass);

  [[nodiscard]] const ParamSet& params() const override { return pass_.params; }
  [[nodiscard]] Extent3 input_extent(std::string_view port) const override;
  [[nodiscard]] Extent3 output_extent(std::string_view port) const override;
  [[nodiscard]] bool connected(std::string_view input_port) const override;
  [[nodiscard]] TriangleRange static_triangles() const override { return environment_.scene->static_triangles; }
  [[nodiscard]] TriangleRange dynamic_triangles() const override { return environment_.scene->dynamic_triangles; }
  void clear(std::string_view port, const ClearColor& color) override;
  void dispatch(const Dispatch& dispatch) override;
  void draw(const Draw& draw) override;

 private:
  void separate_commands();
  [[nodiscard]] const Use& written_use(std::string_view shader_name) const;
  [[nodiscard]] gpu::ImageView written_view(const Use& use) const;
  [[nodiscard]] std::vector<ShaderValue> values_for(const gpu::Reflection& reflection,
                                                    const std::vector<ShaderValue>& own) const;
  [[nodiscard]] VkDescriptorSet bind_resources(const gpu::Pipeline& pipeline) const;

  RecordingEnvironment environment_;
  const Graph& graph_;
  const GraphPass& pass_;
  gpu::ResourceMap resources_;
  std::vector<ShaderValue> known_values_;
  bool recorded_ = false;
};

}  // namespace lightloom::run
