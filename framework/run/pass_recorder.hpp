#pragma once

#include <string>
#include <vector>

#include "framework/gpu/descriptors.hpp"
#include "framework/gpu/pipeline.hpp"
#include "framework/graph/graph.hpp"
#include "framework/graph/pass_context.hpp"
#include "framework/run/command_hazards.hpp"
#include "framework/run/declared_access.hpp"
#include "framework/run/placeholders.hpp"
#include "framework/run/scene_bindings.hpp"
#include "framework/run/shader_library.hpp"
#include "framework/run/value_images.hpp"

namespace lightloom::run {

/// All that recording a pass needs and that is the same for every pass of a frame.
struct RecordingEnvironment {
  VkCommandBuffer commands = VK_NULL_HANDLE;
  const ValueImages* images = nullptr;
  uint64_t frame_count = 0;  ///< frames since the start: selects ring layers
  const SceneBindings* scene = nullptr;
  const Placeholders* placeholders = nullptr;
  ShaderLibrary* shaders = nullptr;
  gpu::DescriptorAllocator* descriptors = nullptr;
  AccessWatch* watch = nullptr;
};

/// The context that a pass records through: finds shaders, binds ports and scene by name, fills constants by name, and
/// puts barriers between commands where they need them.
class PassRecorder final : public PassContext {
 public:
  PassRecorder(const RecordingEnvironment& environment, const Graph& graph, const GraphPass& pass);

  [[nodiscard]] const ParamSet& params() const override { return pass_.params; }
  [[nodiscard]] Extent3 input_extent(std::string_view port) const override;
  [[nodiscard]] Extent3 output_extent(std::string_view port) const override;
  [[nodiscard]] bool connected(std::string_view input_port) const override;
  [[nodiscard]] TriangleRange static_triangles() const override { return environment_.scene->static_triangles; }
  [[nodiscard]] TriangleRange dynamic_triangles() const override { return environment_.scene->dynamic_triangles; }
  [[nodiscard]] std::vector<TriangleRange> triangles(TriangleKind kind) const override {
    return kind == TriangleKind::masked ? environment_.scene->masked_triangles : environment_.scene->opaque_triangles;
  }
  [[nodiscard]] bool kept(std::string_view port) const override;
  [[nodiscard]] bool wanted(std::string_view output_port) const override;
  [[nodiscard]] std::vector<VoxelBox> moved_boxes(const Extent3& grid) const override;
  void clear(std::string_view port, const ClearColor& color) override;
  void dispatch(const Dispatch& dispatch) override;
  void draw(const Draw& draw) override;
  /// After the pass has recorded its last command.
  void finish();

 private:
  /// The program of these files, held against what the pass type declares.
  [[nodiscard]] const gpu::ShaderProgram& watched_program(const std::vector<std::string>& files) const;
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
  CommandHazards hazards_;
};

}  // namespace lightloom::run
