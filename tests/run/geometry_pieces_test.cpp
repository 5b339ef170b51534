// Vertices and triangles that shaders see in pieces, as on a device that binds less of a buffer at once.
#include <gtest/gtest.h>

#include "framework/gpu/buffer_pieces.hpp"
#include "framework/run/compile_graph.hpp"
#include "framework/run/executor.hpp"
#include "passes/registry.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::run {
namespace {

class GeometryPieces : public test::DeviceTest {
 protected:
  GeometryPieces() { passes::register_builtin_passes(registry_); }

  [[nodiscard]] FrameResult frame(const std::optional<uint64_t>& piece_bytes) const {
    LinkOptions link;
    link.view = {{80, 60}};
    link.trace = {{40, 30}};
    link.sets = {{"resolution", "24"}};
    Diagnostics diagnostics;
    const std::optional<Plan> plan =
        compile_graph(source_dir() / "graphs/paper.json", registry_, link, &scene_, diagnostics);
    ExecutorOptions options;
    options.shaders = default_shader_folders();
    options.geometry_piece_bytes = piece_bytes;
    Executor executor(device(), plan.value(), scene_, options);
    return executor.run_frame(0, {.outputs = true, .captures = false});
  }

  PassRegistry registry_;
  scene::Scene scene_ = scene::load_scene(source_dir() / "samples/scenes/atrium.scene.json");
};

TEST_F(GeometryPieces, GiveTheSameBits) {
  constexpr uint64_t kBytes = 8192 * sizeof(scene::Vertex);
  ASSERT_EQ(gpu::pieces_of(scene_.vertices.size(), sizeof(scene::Vertex), kBytes).count, 3u);
  ASSERT_EQ(gpu::pieces_of(scene_.triangles.size(), sizeof(scene::Triangle), kBytes).count, 2u);
  const FrameResult whole = frame(std::nullopt);
  const FrameResult pieces = frame(kBytes);
  ASSERT_EQ(whole.outputs.size(), pieces.outputs.size());
  for (size_t i = 0; i < whole.outputs.size(); ++i)
    EXPECT_TRUE(whole.outputs[i].image.texels == pieces.outputs[i].image.texels) << whole.outputs[i].name;
}

TEST_F(GeometryPieces, AreRefusedBeyondTheNumberThatShadersKnow) {
  try {
    (void)frame(64);
    FAIL() << "so small a piece is made large enough";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("that shaders can reach on this device"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace lightloom::run
