// The reference tracer in a graph: what it sees is what the rasteriser sees, and its outputs fit the passes that
// follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/packing.hpp>

#include "framework/base/error.hpp"
#include "framework/base/file.hpp"
#include "framework/reference/first_hits.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

class ReferencePathTrace : public DeviceTest {};

scene::Scene glossy_scene() {
  scene::Material floor = white_lambertian();
  floor.base_color = {0.6f, 0.4f, 0.2f, 1};
  floor.specular_factor = 1;
  floor.roughness = 0.4f;
  scene::Material wall = white_lambertian();
  wall.metallic = 1;
  wall.roughness = 0.5f;
  wall.anisotropy_strength = 0.5f;
  scene::Material lamp = white_lambertian();
  lamp.emission = {4, 3, 2};
  lamp.base_color = {0, 0, 0, 1};
  scene::Scene scene = make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, 0},
                                        {{-2, 0, -2}, {4, 0, 0}, {0, 3, 0}, 1},
                                        {{-0.5f, 2, -0.5f}, {1, 0, 0}, {0, 0, 1}, 2}},
                                       {floor, wall, lamp}, look_at({0.5f, 1.6f, 4}, {0, 0.7f, 0}, 0.9f));
  scene.environment.radiance = {0.2f, 0.3f, 0.4f};
  scene.features.environment = true;
  return scene;
}

const std::string kTrace =
    R"("trace": { "type": "reference_path_trace", "in": { "surface": "gather.surface" }, "params": { "paths": 3 } })";

double difference(const image::HostImage& a, const image::HostImage& b, uint32_t x, uint32_t y, uint32_t channel) {
  return std::abs(a.at(x, y, 0, channel) - b.at(x, y, 0, channel));
}

TEST_F(ReferencePathTrace, ModulateGivesBackTheLight) {
  const std::string passes =
      R"("gather": { "type": "gather" }, )" + kTrace +
      R"(, "whole": { "type": "modulate", "in": { "radiance": "trace.radiance", "surface": "gather.surface" } },
         "lobes": { "type": "modulate", "in": { "radiance": "trace.diffuse", "specular": "trace.specular",
                                                "surface": "gather.surface" } })";
  const Images images =
      run_graph(graph_text(40, 30, 40, 30, passes,
                           R"("light": "trace.outgoing", "whole": "whole.radiance", "lobes": "lobes.radiance")"),
                glossy_scene())
          .front();
  double brightest = 0;
  for (uint32_t y = 0; y < 30; ++y)
    for (uint32_t x = 0; x < 40; ++x)
      for (uint32_t channel = 0; channel < 4; ++channel) {
        const double light = images.at("light").at(x, y, 0, channel);
        brightest = std::max(brightest, light);
        EXPECT_LE(difference(images.at("whole"), images.at("light"), x, y, channel), 2e-3 * light + 1e-5);
        EXPECT_LE(difference(images.at("lobes"), images.at("light"), x, y, channel), 2e-3 * light + 1e-5);
      }
  EXPECT_GT(brightest, 2);
}

TEST_F(ReferencePathTrace, FindsTheFirstHitsOfTheGBuffer) {
  const std::string passes = R"("gather": { "type": "gather" }, )" + kTrace +
                             R"(, "alone": { "type": "reference_path_trace", "params": { "paths": 3 } })";
  const Images images = run_graph(graph_text(40, 30, 20, 15, passes,
                                             R"("given": "trace.outgoing", "found": "alone.outgoing",
                                                "error": "alone.standard_error")"),
                                  glossy_scene())
                            .front();
  ASSERT_EQ(images.at("found").desc.extent, (Extent3{40, 30, 1}));
  uint32_t other = 0;
  double noise = 0;
  for (uint32_t y = 0; y < 30; ++y)
    for (uint32_t x = 0; x < 40; ++x) {
      const double light = images.at("given").at(x, y, 0, 1);
      other += difference(images.at("given"), images.at("found"), x, y, 1) > 1e-3 * light + 1e-5 ? 1 : 0;
      noise += images.at("error").at(x, y, 0, 1);
    }
  // Where the last bit of the first hit decides what a path meets, the rest of it is another.
  EXPECT_LE(other, 12U);
  EXPECT_GT(noise, 0);
}

TEST_F(ReferencePathTrace, IsTheSameInEachRunAndOtherInEachFrame) {
  const std::string passes = R"("trace": { "type": "reference_path_trace", "params": { "paths": 2 } })";
  GraphRunOptions options;
  options.frames = 2;
  const std::string text = graph_text(20, 15, 20, 15, passes, R"("light": "trace.outgoing")");
  const std::vector<Images> once = run_graph(text, glossy_scene(), options);
  const std::vector<Images> again = run_graph(text, glossy_scene(), options);
  EXPECT_EQ(once[0].at("light").texels, again[0].at("light").texels);
  EXPECT_EQ(once[1].at("light").texels, again[1].at("light").texels);
  EXPECT_NE(once[0].at("light").texels, once[1].at("light").texels);
  options.seed = 1;
  EXPECT_NE(once[0].at("light").texels, run_graph(text, glossy_scene(), options)[0].at("light").texels);
}

TEST_F(ReferencePathTrace, TheGraphsErrorFallsWithTheRootOfItsFrames) {
  GraphRunOptions options;
  options.frames = 16;
  options.link.view = {24, 18};
  options.link.sets = {{"paths", "200"}};
  const std::vector<Images> frames =
      run_graph(read_text_file(source_dir() / "graphs/reference.json"), glossy_scene(), options);
  const auto error = [&](size_t frame) { return mean_of(frames[frame].at("standard_error"), 1, 0, 0, 24, 18); };
  EXPECT_GT(error(0), 0);
  EXPECT_NEAR(error(0) / error(3), 2, 0.2);
  EXPECT_NEAR(error(3) / error(15), 2, 0.1);
  // The first frame is off by as much as it says, measured against the last.
  double squares = 0;
  uint32_t count = 0;
  for (uint32_t y = 0; y < 18; ++y)
    for (uint32_t x = 0; x < 24; ++x) {
      const double own = frames[0].at("standard_error").at(x, y, 0, 1);
      if (!(own > 0)) continue;
      squares += std::pow(difference(frames[0].at("radiance"), frames[15].at("radiance"), x, y, 1) / own, 2);
      ++count;
    }
  ASSERT_GT(count, 100U);
  // 15/16 of the variance of the first frame separates the two.
  EXPECT_NEAR(squares / count, 15.0 / 16, 0.4);
}

TEST_F(ReferencePathTrace, RefusesToMoveStartsThatAreGiven) {
  const std::string passes = R"("gather": { "type": "gather" },
    "trace": { "type": "reference_path_trace", "in": { "surface": "gather.surface" },
               "params": { "pixel_filter": "box" } })";
  EXPECT_THROW(run_graph(graph_text(8, 8, 8, 8, passes, R"("light": "trace.outgoing")"), glossy_scene()), Error);
}

struct SharedScene {
  const char* file;
  uint32_t width = 120;  ///< of the image [pixels]
  uint32_t frame = 0;    ///< which is looked at
};

/// Parts of the G-buffer beside what the library says is there.
class ReferenceSeesWhatGatherSees : public DeviceTest, public testing::WithParamInterface<SharedScene> {};

struct Comparison {
  uint32_t pixels = 0, other_surface = 0, compared = 0, other_material = 0;
  double normal = 0;                               ///< largest difference
  double mean_normal = 0, tangent = 0, color = 0;  ///< sums of differences; of the tangents' cosines
};

Comparison compare(const Images& images, const scene::Scene& scene, uint32_t width, uint32_t height, double time) {
  const scene::Pose pose = scene::pose(scene, time);
  scene::FrameScene frame;
  frame.scene = &scene;
  frame.pose = &pose;
  const reference::StaticScene fixed(scene);
  const reference::TriangleGeometry geometry(fixed, frame);
  const reference::PixelCamera camera(pose.cameras.front(), width, height, scene.bounds);
  const auto part = [&](const char* name, uint32_t x, uint32_t y) {
    const image::HostImage& image = images.at(std::string("gather.surface.") + name);
    return glm::dvec4(image.at(x, y, 0, 0), image.at(x, y, 0, 1), image.at(x, y, 0, 2), image.at(x, y, 0, 3));
  };
  Comparison result;
  for (uint32_t y = 0; y < height; ++y)
    for (uint32_t x = 0; x < width; ++x) {
      const bool covered = part("position", x, y).w > 0;
      const reference::ViewRay ray = camera.through(x + 0.5, y + 0.5);
      const auto seen = geometry.seen(camera, ray);
      if (covered || seen) ++result.pixels;
      if (covered != seen.has_value()) ++result.other_surface;
      if (!covered || !seen) continue;
      const reference::SeenSurface surface = geometry.seen_surface(camera, ray, *seen);
      const double apart = glm::length(glm::dvec3(surface.point.position) - glm::dvec3(part("position", x, y)));
      if (apart > 1e-3 * part("position", x, y).w) ++result.other_surface;
      // On an edge between two triangles either may be named.
      if (seen->triangle != static_cast<uint32_t>(part("id", x, y).z)) continue;
      ++result.compared;
      const reference::Reflectance& r = surface.point.reflectance;
      const glm::dvec4 albedo = part("albedo", x, y), material = part("material", x, y);
      const double bent = glm::length(glm::dvec3(surface.point.normal) - glm::dvec3(part("normal", x, y)));
      result.normal = std::max(result.normal, bent);
      result.mean_normal += bent;
      const double color = glm::length(glm::dvec3(r.base_color) - glm::dvec3(albedo));
      result.color += color;
      const glm::dvec4 own(r.alpha, r.f0, r.f90);
      const bool same = color < 0.03 && glm::length(own - material) < 0.03 &&
                        std::abs(static_cast<double>(r.metallic) - albedo.w) < 0.03 &&
                        glm::length(glm::dvec3(surface.emission) - glm::dvec3(part("emission", x, y))) <
                            0.03 * (1 + glm::length(glm::dvec3(surface.emission)));
      result.other_material += same ? 0 : 1;
      if (scene.features.anisotropic)
        result.tangent += std::abs(glm::dot(glm::dvec3(surface.point.tangent), glm::dvec3(part("tangent", x, y))));
    }
  return result;
}

TEST_P(ReferenceSeesWhatGatherSees, Scene) {
  const std::filesystem::path file = source_dir() / "../shared/scenes" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  const scene::Scene scene = scene::load_scene(file);
  const uint32_t width = GetParam().width, height = width * 3 / 4;
  GraphRunOptions options;
  options.frames = GetParam().frame + 1;
  options.capture = {"gather.surface"};
  const Images images = run_graph(graph_text(width, height, width, height, R"("gather": { "type": "gather" })",
                                             R"("id": "gather.surface.id")"),
                                  scene, options)
                            .back();
  const Comparison found = compare(images, scene, width, height, GetParam().frame / 30.0);
  ASSERT_GT(found.compared, 500U);
  EXPECT_GT(found.compared, found.pixels * 4 / 5);
  // At edges, and where surfaces lie within each other, rounding decides.
  EXPECT_LE(found.other_surface, found.pixels / 100);
  EXPECT_LE(found.other_material, found.compared / 50);
  EXPECT_LT(found.color / found.compared, 3e-3);
  EXPECT_LT(found.mean_normal / found.compared, 0.02);
  if (!scene.features.normal_mapped) {
    EXPECT_LT(found.normal, 5e-3);
  }
  if (scene.features.anisotropic) {
    EXPECT_GT(found.tangent / found.compared, 0.999);
  }
}

INSTANTIATE_TEST_SUITE_P(Shared, ReferenceSeesWhatGatherSees,
                         testing::Values(SharedScene{"cornell_box_original_emissive/scene.gltf"},
                                         SharedScene{"anisotropy_barn_lamp/AnisotropyBarnLamp.gltf"},
                                         // Shaders clamp coordinates half a texel of the coarser level from the rim,
                                         // which at coarse levels is farther in than the rim's own texels.
                                         SharedScene{"khronos/TextureSettingsTest/glTF/TextureSettingsTest.gltf", 480},
                                         SharedScene{"khronos/TextureCoordinateTest/glTF/TextureCoordinateTest.gltf"},
                                         SharedScene{"khronos/BoxVertexColors/glTF/BoxVertexColors.gltf"},
                                         SharedScene{"khronos/Fox/glTF/Fox.gltf", 120, 6},
                                         SharedScene{"khronos/BoxAnimated/glTF/BoxAnimated.gltf", 120, 20},
                                         SharedScene{"khronos/Cameras/glTF/Cameras.gltf"},
                                         SharedScene{"sponza.scene.json"}));

}  // namespace
}  // namespace lightloom::test
