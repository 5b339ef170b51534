#pragma once

#include <deque>
#include <optional>
#include <string>

#include "framework/gpu/buffer.hpp"
#include "framework/gpu/buffer_pieces.hpp"
#include "framework/gpu/image.hpp"
#include "framework/gpu/samplers.hpp"
#include "framework/run/frame_result.hpp"
#include "framework/run/frame_state.hpp"
#include "framework/run/moved_boxes.hpp"
#include "framework/run/scene_accelerator.hpp"
#include "framework/run/scene_bindings.hpp"
#include "framework/scene/camera_path.hpp"
#include "framework/scene/frame_scene.hpp"
#include "framework/scene/lights.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::run {

/// The camera of that name, or the first for an empty name. Throws Error(invalid_input) that lists the names.
[[nodiscard]] size_t find_camera(const scene::Scene& scene, const std::string& name);

struct SceneResourceOptions {
  std::string camera;
  std::optional<scene::CameraPath> camera_path = std::nullopt;  ///< moves the camera instead of what the scene says
  Extent3 view;
  uint32_t seed = 0;
  double frames_per_second = 30;
  std::optional<double> frozen_time = std::nullopt;  ///< every frame shows the scene at this time [s]
  bool general = false;                              ///< shaders see every feature, whatever the scene has
  bool ray_queries = false;                          ///< some pass asks what rays meet: builds acceleration structures
  std::optional<uint64_t> geometry_piece_bytes = std::nullopt;  ///< ExecutorOptions::geometry_piece_bytes
};

/// The scene on the device: uploaded once, but for what moves and the blocks of the frame, which are staged by
/// `prepare` and copied by `record_upload`.
class SceneResources {
 public:
  SceneResources(gpu::Device& device, const scene::Scene& scene, SceneResourceOptions options);
  SceneResources(const SceneResources&) = delete;
  SceneResources& operator=(const SceneResources&) = delete;

  [[nodiscard]] const SceneBindings& bindings() const { return bindings_; }
  /// Poses the scene, draws light samples and fills the staging buffer. The frames prepared before are its history.
  FrameConditions prepare(uint32_t frame);
  void record_upload(VkCommandBuffer commands) const;
  /// The scene as it was posed last.
  [[nodiscard]] const scene::FrameScene& frame_scene() const { return frame_scene_; }
  /// What had to be changed for the device, e.g. resampled textures.
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  void upload_geometry(gpu::Device& device);
  void upload_materials(gpu::Device& device);
  void upload_environment(gpu::Device& device);
  void bind();
  void stage_geometry(const std::vector<scene::Vertex>& moving);
  /// Returns the number of hints.
  uint32_t fill_light_block(LightBlock& block, const scene::Pose& pose, uint32_t frame);

  const scene::Scene& scene_;
  SceneResourceOptions options_;
  size_t camera_ = 0;
  scene::Pose pose_;
  scene::FrameScene frame_scene_;  ///< points at the scene and at pose_
  std::deque<View> views_;         ///< newest first
  uint32_t newest_slot_ = 0;       ///< of past_positions_
  MovingObjects moving_;
  scene::EmissionTable emission_;
  scene::EmitterSampler emitters_;
  std::vector<std::string> warnings_;
  gpu::Samplers samplers_;
  gpu::BufferPieces vertex_pieces_;
  gpu::BufferPieces triangle_pieces_;
  gpu::Buffer vertices_;
  gpu::Buffer triangles_;
  gpu::Buffer past_positions_;  ///< kHistoryLimit slots of a vec4 for each dynamic vertex
  gpu::Buffer frame_block_;
  gpu::Buffer light_block_;
  gpu::Buffer staging_;                    ///< FrameBlock, LightBlock, the dynamic vertices, their positions
  std::vector<gpu::Buffer> materials_;     ///< one
  std::vector<gpu::Image> texture_pages_;  ///< as many as shaders declare; white beyond those in use
  std::vector<ShaderValue> texture_values_;
  std::vector<gpu::Image> environment_;  ///< the image, and the table by which its light is sampled
  std::optional<SceneAccelerator> accelerator_;
  SceneBindings bindings_;
};

}  // namespace lightloom::run
