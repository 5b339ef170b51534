#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/graph/link.hpp"
#include "framework/graph/pass_type.hpp"
#include "framework/graph/plan.hpp"
#include "framework/image/host_image.hpp"
#include "framework/run/shader_folders.hpp"
#include "framework/scene/scene.hpp"

namespace lightloom::stability {

struct RunOptions {
  uint32_t first_frame = 0;
  uint32_t frames = 1;  ///< rendered one after another
  uint32_t seed = 0;
  bool share_memory = true;
  std::optional<double> frozen_time;  ///< [s]
  std::string camera;                 ///< empty: the scene's first
  std::vector<std::string> capture;   ///< globs over "pass.port" / "pass.port.part"
  LinkOptions link;
};

/// Outputs by name and captures by "pass.port[.part]".
using Images = std::map<std::string, image::HostImage>;

/// Called with each frame's images.
using FrameVisitor = std::function<void(uint32_t frame, Images images)>;

/// Renders graphs and scenes that are made in memory, without a run folder.
class Lab {
 public:
  /// `device` and `registry` outlive it.
  Lab(gpu::Device& device, const PassRegistry& registry, run::ShaderFolders shaders);
  Lab(const Lab&) = delete;
  Lab& operator=(const Lab&) = delete;
  /// Removes the folder.
  ~Lab();

  /// Shows every frame's images. Throws Error with all diagnostics of the graph, or what rendering throws.
  void visit(std::string_view graph_json, const scene::Scene& scene, const RunOptions& options,
             const FrameVisitor& visitor);
  /// The images of every frame, in order.
  [[nodiscard]] std::vector<Images> frames(std::string_view graph_json, const scene::Scene& scene,
                                           const RunOptions& options = {});
  /// Those of the last frame alone.
  [[nodiscard]] Images last_frame(std::string_view graph_json, const scene::Scene& scene,
                                  const RunOptions& options = {});
  /// What `visit` would execute.
  [[nodiscard]] Plan plan(std::string_view graph_json, const scene::Scene& scene,
                          const LinkOptions& options = {}) const;

  /// Text of one of the graphs that ship, by its name: "lightloom", "paper". Throws Error where it cannot be read.
  [[nodiscard]] std::string shipped_graph(const std::string& name) const;
  /// An empty folder of this lab's own, for scene files that a check writes; made at the first call.
  [[nodiscard]] const std::filesystem::path& folder();

  [[nodiscard]] gpu::Device& device() { return device_; }
  [[nodiscard]] const PassRegistry& registry() const { return registry_; }
  [[nodiscard]] const run::ShaderFolders& shaders() const { return shaders_; }

 private:
  gpu::Device& device_;
  const PassRegistry& registry_;
  run::ShaderFolders shaders_;
  std::filesystem::path folder_;
};

}  // namespace lightloom::stability
