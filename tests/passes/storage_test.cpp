// Values stored in other formats than their passes name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <set>

#include "framework/base/file.hpp"
#include "passes/registry.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {
namespace {

using Storage = DeviceTest;
using Formats = std::vector<std::pair<std::string, std::string>>;

constexpr uint32_t kSize = 24;
constexpr double kHalfMax = 65504;
/// One rounding to half floats: relative error of normal numbers.
constexpr double kHalfRounding = 1.0 / 2048;

/// A pattern of light through every kind of pass that writes light.
std::string passes_over(const std::string& pattern, double scale) {
  return R"("gather": { "type": "gather" },
    "pattern": { "type": "pattern", "in": { "surface": "gather.surface" }, "params": { "pattern": ")" +
         pattern + R"(", "scale": )" + std::to_string(scale) + R"( } },
    "temporal": { "type": "temporal_accumulate", "in": { "radiance": "pattern.radiance", "surface": "gather.surface",
      "trail": "pattern.radiance@1..9", "trail_position": "gather.surface.position@1..9",
      "trail_normal": "gather.surface.normal@1..9" } },
    "radial": { "type": "denoise_radial", "in": { "radiance": "pattern.radiance", "surface": "gather.surface" } },
    "box": { "type": "box_blur", "in": { "radiance": "pattern.radiance", "surface": "gather.surface" } },
    "upsample": { "type": "upsample", "in": { "radiance": "pattern.radiance", "trace_surface": "gather.surface",
      "surface": "gather.surface" } },
    "modulate": { "type": "modulate", "in": { "radiance": "pattern.radiance", "surface": "gather.surface" } },
    "mean": { "type": "accumulate", "in": { "radiance": "pattern.radiance", "past": "mean.accumulation@1" } })";
}

const std::vector<std::string> kLight = {"temporal", "radial", "box", "upsample", "modulate", "mean"};

std::string outputs_of(const std::vector<std::string>& passes) {
  std::string text;
  for (const std::string& pass : passes)
    text += (text.empty() ? "\"" : ", \"") + pass + "\": \"" + pass + ".radiance\"";
  return text;
}

/// White, facing the viewer, `half` wide to each side, seen from `distance` [m].
scene::Scene wall(float half, float distance) {
  return make_quad_scene({{{-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}}}, {lambertian(glm::vec3(1))},
                         look_at({0, 0, distance}, {0, 0, 0}, 0.5f));
}

Images last_frame(const std::string& passes, const std::string& outputs, const scene::Scene& scene,
                  const Formats& formats, uint32_t frames = 1, std::vector<std::string> capture = {}) {
  GraphRunOptions options;
  options.extra_types = {make_pattern()};
  options.link.formats = formats;
  options.frames = frames;
  options.capture = std::move(capture);
  return run_graph(graph_text(kSize, kSize, kSize, kSize, passes, outputs), scene, options).back();
}

TEST_F(Storage, WhatIsTooBrightForAHalfIsStoredAsItsLargest) {
  const std::string passes = passes_over("constant", 1e6);
  const Images wide = last_frame(passes, outputs_of(kLight), wall(1, 3), {}, 2);
  const Images narrow = last_frame(passes, outputs_of(kLight), wall(1, 3), {{"*.radiance", "rgba16_sfloat"}}, 2);
  const Images only_stored = last_frame(passes, outputs_of(kLight), wall(1, 3),
                                        {{"*.radiance", "rgba16_sfloat"}, {"pattern.radiance", "rgba32_sfloat"}}, 2);
  for (const std::string& pass : kLight) {
    EXPECT_EQ(narrow.at(pass).desc.format, Format::rgba16_sfloat);
    for (uint32_t channel = 0; channel < 3; ++channel) {
      EXPECT_GT(wide.at(pass).at(kSize / 2, kSize / 2, 0, channel), kHalfMax) << pass;
      EXPECT_EQ(only_stored.at(pass).at(kSize / 2, kSize / 2, 0, channel), kHalfMax) << pass;
    }
  }
}

TEST_F(Storage, AnInfinityIsStoredAsTheLargestHalf) {
  const std::string passes = passes_over("constant", 3e38);  // twice that in the blue channel
  const std::string output = R"("light": "modulate.radiance")";
  EXPECT_TRUE(std::isinf(last_frame(passes, output, wall(1, 3), {}).at("light").at(kSize / 2, kSize / 2, 0, 2)));
  const Images narrow = last_frame(passes, output, wall(1, 3), {{"modulate.radiance", "rgba16_sfloat"}});
  EXPECT_EQ(narrow.at("light").at(kSize / 2, kSize / 2, 0, 2), kHalfMax);
}

/// Shader names of outputs of shipped passes whose formats hold numbers that another may not.
std::set<std::string> bounded_outputs() {
  PassRegistry types;
  passes::register_builtin_passes(types);
  std::set<std::string> names;
  for (const std::string& name : types.names())
    for (const Port& port : types.find(name)->ports)
      for (const PortPart& part : port.parts)
        if (port.direction == Direction::out && port.exact_format.empty() &&
            format_info(part.format).encoding == Encoding::sfloat)
          names.insert("out_" + port.name + (part.name.empty() ? "" : "_" + part.name));
  return names;
}

TEST_F(Storage, EveryShaderBoundsWhatItStores) {
  // Some devices, as the one that tests run on, clamp finite numbers by themselves, so the text is what can be checked.
  const std::set<std::string> outputs = bounded_outputs();
  std::set<std::string> stored;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(source_dir() / "shaders")) {
    // Those of stability checks are no passes, and some of them store what is no number on purpose.
    if (!entry.is_regular_file() || entry.path().parent_path().filename() == "stability") continue;
    const std::string text = read_text_file(entry.path());
    for (const std::string& name : outputs)
      for (const std::string& start : {"imageStore(" + name + ",", "  " + name + " = storable("})
        for (size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1)) {
          const std::string statement = text.substr(at, text.find(';', at) - at);
          if (statement.find("vec4(0.0)") != std::string::npos) continue;
          // Images of another pass's shader may have the name of a port with whole numbers or fractions.
          if (text.find("uniform writeonly image3D " + name) != std::string::npos) continue;
          EXPECT_NE(statement.find("storable("), std::string::npos) << entry.path() << ": " << statement;
          EXPECT_NE(statement.find(name + "_largest"), std::string::npos) << entry.path() << ": " << statement;
          stored.insert(name);
        }
  }
  // Those of reference_path_trace are written on the host.
  for (const std::string& name : outputs)
    EXPECT_TRUE(stored.contains(name) || name == "out_outgoing") << name << " is stored by no shader";
}

TEST_F(Storage, AGBufferOfHalvesHoldsNoInfinity) {
  scene::Scene scene = wall(4e5f, 1e6f);
  scene.materials.front().emission = {1e6f, 2e6f, 3e6f};
  scene.features.emissive = true;
  const std::string passes = R"("gather": { "type": "gather" },
    "half": { "type": "resample_surface", "in": { "surface": "gather.surface" } })";
  const Formats narrow = {{"gather.surface", "rgba16_sfloat"}, {"half.surface", "rgba16_sfloat"}};
  const std::vector<std::string> captures = {"*.surface.position", "*.surface.emission"};
  const Images images = last_frame(passes, R"("out": "half.surface.emission")", scene, narrow, 1, captures);
  for (const std::string pass : {"gather", "half"}) {
    EXPECT_EQ(images.at(pass + ".surface.position").at(kSize / 2, kSize / 2, 0, 3), kHalfMax) << pass;
    EXPECT_EQ(images.at(pass + ".surface.emission").at(kSize / 2, kSize / 2, 0, 1), kHalfMax) << pass;
  }
  // And by the copy alone.
  const Images copied =
      last_frame(passes, R"("out": "half.surface.emission")", scene, {{"half.surface", "rgba16_sfloat"}}, 1, captures);
  EXPECT_GT(copied.at("gather.surface.position").at(kSize / 2, kSize / 2, 0, 3), 9e5);
  EXPECT_EQ(copied.at("half.surface.position").at(kSize / 2, kSize / 2, 0, 3), kHalfMax);
}

TEST_F(Storage, AMeanOfEqualHalvesIsThatHalf) {
  // The trail holds frames, not means: nothing is fed back that could stall or stop short.
  const std::vector<std::string> light = {"pattern", "temporal"};
  const Images images =
      last_frame(passes_over("constant", 0.3), outputs_of(light), wall(1, 3), {{"*.radiance", "rgba16_sfloat"}}, 14);
  for (uint32_t channel = 0; channel < 3; ++channel)
    EXPECT_EQ(images.at("temporal").at(kSize / 2, kSize / 2, 0, channel),
              images.at("pattern").at(kSize / 2, kSize / 2, 0, channel));
  EXPECT_GT(images.at("temporal").at(kSize / 2, kSize / 2, 0, 3), 7) << "the mean of ten frames";
}

/// A floor and a lamp above it that the viewer does not see, `k` times as bright.
scene::Scene lit_floor(float k) {
  scene::Material lamp = lambertian(glm::vec3(0));
  lamp.emission = glm::vec3(4, 3, 2) * k;
  lamp.double_sided = true;
  scene::Scene scene =
      make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 0}, {{-0.4f, 1, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, 1}},
                      {lambertian({0.8f, 0.5f, 0.2f}), lamp}, look_at({0, 0.9f, 1.8f}, {0, 0, 0}, 0.5f));
  scene.features.emissive = true;
  return scene;
}

/// Root of the mean squared relative difference of `image` / k from `expected`, and the largest.
std::pair<double, double> relative_difference(const image::HostImage& image, double k,
                                              const image::HostImage& expected) {
  double sum = 0, worst = 0;
  size_t count = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      for (uint32_t channel = 0; channel < 3; ++channel) {
        const double wanted = expected.at(x, y, 0, channel);
        if (wanted < 1e-2) continue;
        const double error = std::abs(image.at(x, y, 0, channel) / k / wanted - 1);
        sum += error * error;
        worst = std::max(worst, error);
        ++count;
      }
  EXPECT_GT(count, 300u);
  return {std::sqrt(sum / static_cast<double>(count)), worst};
}

TEST_F(Storage, LightIsLinearToTheRoundingOfAHalf) {
  const std::string passes = trace_passes(24, R"("paths": 2, "bounces": 2)") + R"(,
    "denoise": { "type": "denoise_radial", "in": { "radiance": "trace.radiance", "surface": "gather.surface" } },
    "box": { "type": "box_blur", "in": { "radiance": "denoise.radiance", "surface": "gather.surface" } },
    "modulate": { "type": "modulate", "in": { "radiance": "box.radiance", "surface": "gather.surface" } })";
  const std::string output = R"("light": "modulate.radiance")";
  // Stored once as a half: one rounding here, one there. Stored so at each of five steps: roundings are as often up as
  // down. And as 32-bit floats.
  const Formats once = {{"modulate.radiance", "rgba16_sfloat"}};
  const Formats always = {{"*", "rgba16_sfloat"}, {"gather.surface.position", "rgba32_sfloat"}};
  const auto render = [&](float k, const Formats& formats) {
    return last_frame(passes, output, lit_floor(k), formats).at("light");
  };
  const image::HostImage one_once = render(1, once), one_always = render(1, always), one = render(1, {});
  for (const float k : {1.0f / 3, 1000.0f}) {
    EXPECT_LE(relative_difference(render(k, once), k, one_once).second, 2 * kHalfRounding * (1 + 1e-3)) << k;
    EXPECT_LE(relative_difference(render(k, always), k, one_always).first, 2 * kHalfRounding) << k;
    EXPECT_LE(relative_difference(render(k, {}), k, one).second, 1e-5) << k;
  }
}

/// What the bytes of a normal image say (shaders/lib/voxel_encoding.glsl), in double precision.
struct Directions {
  glm::dvec3 normal, tangent;
};
Directions directions(const image::HostImage& image, uint32_t x, uint32_t y, uint32_t z) {
  const double azimuth = image.at(x, y, z, 0) * 255 * 2 * glm::pi<double>() / 256;
  const double polar = image.at(x, y, z, 1) * 255 * glm::pi<double>() / 254;
  const auto code = static_cast<uint32_t>(std::lround(image.at(x, y, z, 2) * 255));
  const glm::dvec3 along(std::cos(azimuth), 0, -std::sin(azimuth));
  const glm::dvec3 normal(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
  const double shadow = (code & 63u) * 2.0 / 63 - 1;
  const double across = std::sqrt(1 - shadow * shadow) * ((code & 64u) != 0 ? -1 : 1);
  return {normal, shadow * along + across * glm::cross(normal, along)};
}

TEST_F(Storage, VoxelsOfAnyWidthHoldTheSameVoxels) {
  const std::string passes = trace_passes(24, R"("paths": 2, "bounces": 2)") + R"(,
    "empty": { "type": "voxelize", "params": { "geometry": "dynamic", "resolution": 24 } },
    "merge": { "type": "voxel_merge", "in": { "static": "voxelize.voxels", "dynamic": "empty.voxels" } })";
  const std::vector<std::string> captures = {"voxelize.voxels", "merge.voxels"};
  const auto voxels = [&](const Formats& formats) {
    return last_frame(passes, R"("light": "trace.radiance")", lit_floor(1), formats, 1, captures);
  };
  const Images narrow = voxels({});
  const Images wide = voxels({{"voxelize.voxels", "rgba16_unorm"}});
  const Images back = voxels({{"voxelize.voxels", "rgba16_unorm"}, {"merge.voxels", "rgba8_unorm"}});
  const auto& bytes = narrow.at("voxelize.voxels.albedo");
  size_t occupied = 0;
  for (uint32_t z = 0; z < bytes.desc.extent.depth; ++z)
    for (uint32_t y = 0; y < bytes.desc.extent.height; ++y)
      for (uint32_t x = 0; x < bytes.desc.extent.width; ++x) {
        occupied += bytes.at(x, y, z, 3) > 0.5 ? 1 : 0;
        for (const char* part : {"albedo", "material"})
          for (uint32_t channel = 0; channel < 4; ++channel) {
            const std::string name = std::string("voxels.") + part;
            const double value = narrow.at("voxelize." + name).at(x, y, z, channel);
            EXPECT_NEAR(wide.at("voxelize." + name).at(x, y, z, channel), value, 0.51 / 255);
            EXPECT_NEAR(back.at("merge." + name).at(x, y, z, channel), value, 1.01 / 255);
          }
        const Directions first = directions(narrow.at("voxelize.voxels.normal"), x, y, z);
        const Directions second = directions(back.at("merge.voxels.normal"), x, y, z);
        if (bytes.at(x, y, z, 3) > 0.5) {
          EXPECT_GT(glm::dot(first.normal, second.normal), std::cos(glm::radians(1.6))) << x << " " << y << " " << z;
          EXPECT_GT(glm::dot(first.tangent, second.tangent), std::cos(glm::radians(21.0))) << x << " " << y << " " << z;
        } else {
          for (uint32_t channel = 0; channel < 4; ++channel)
            EXPECT_EQ(back.at("merge.voxels.normal").at(x, y, z, channel), 0);
        }
      }
  EXPECT_GT(occupied, 300u);
}

TEST_F(Storage, ReadersOfVoxelsFollowTheirWidth) {
  const std::string passes = R"("voxelize": { "type": "voxelize", "params": { "resolution": 16 } },
    "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
    "view": { "type": "view_voxels", "in": { "voxels": "voxelize.voxels", "distance": "distance.distance" },
              "params": { "show": "tangent", "shade_faces": false } })";
  const std::string output = R"("view": "view.image")";
  const image::HostImage narrow = last_frame(passes, output, lit_floor(1), {}).at("view");
  const image::HostImage wide =
      last_frame(passes, output, lit_floor(1), {{"voxelize.voxels", "rgba16_unorm"}}).at("view");
  size_t seen = 0;
  for (uint32_t y = 0; y < kSize; ++y)
    for (uint32_t x = 0; x < kSize; ++x)
      for (uint32_t channel = 0; channel < 3; ++channel) {
        // Ten degrees, as coarse as the paper's tangents may be.
        EXPECT_NEAR(wide.at(x, y, 0, channel), narrow.at(x, y, 0, channel), 0.1) << x << " " << y;
        seen += std::abs(narrow.at(x, y, 0, channel) - 0.35) > 0.1 ? 1 : 0;
      }
  EXPECT_GT(seen, 200u);
}

}  // namespace
}  // namespace lightloom::test
