#include "framework/scene/lights.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"
#include "framework/scene/basis.hpp"
#include "framework/scene/color.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using test::GltfBuilder;

/// Three emitters of different area, power and sidedness, and one quad that does not emit.
GltfBuilder emitters() {
  GltfBuilder builder;
  builder.append("materials", {{"emissiveFactor", {1, 1, 1}}});
  builder.append("materials", {{"emissiveFactor", {0.5, 0, 0}}, {"doubleSided", true}});
  builder.append("materials", nlohmann::json::object());
  const int bright = builder.quad(0), red = builder.quad(1), dark = builder.quad(2);
  builder.node({{"mesh", bright}, {"translation", {0, 0, 10}}});
  builder.node({{"mesh", red}, {"scale", {3, 2, 1}}, {"translation", {0, 0, 20}}});
  builder.node({{"mesh", dark}, {"translation", {0, 0, 30}}});
  builder.node({{"mesh", bright}, {"scale", {0.5, 0.5, 1}}, {"translation", {0, 0, 40}}});
  return builder;
}

TEST(Lights, TableListsEmissiveMaterialsInOrder) {
  const Scene scene = emitters().load();
  const EmissionTable table = build_emission_table(scene);
  ASSERT_EQ(table.entries.size(), 3u);
  EXPECT_EQ(table.entries[1].radiance, glm::vec3(1));
  EXPECT_FALSE(table.entries[1].two_sided);
  EXPECT_TRUE(table.entries[2].two_sided);
  EXPECT_EQ(table.entry_of_material, (std::vector<uint32_t>{1, 2, 0}));
}

TEST(Lights, AreaDensityIntegratesToOne) {
  const Scene scene = emitters().load();
  const EmissionTable table = build_emission_table(scene);
  const EmitterSampler sampler(scene, table);
  EXPECT_EQ(sampler.area_density(0), 0);
  EXPECT_NEAR(sampler.area_density(1) * (1 + 0.25f) + sampler.area_density(2) * 6, 1, 1e-6);
  EXPECT_NEAR(sampler.area_density(2) / sampler.area_density(1), 0.5 * 0.2126 * 2, 1e-6);
}

TEST(Lights, EmittingAreaIsThatOfTheTriangles) {
  const Scene scene = emitters().load();
  const EmissionTable table = build_emission_table(scene);
  const EmitterSampler sampler(scene, table);
  EXPECT_EQ(sampler.emitting_area(0), 0);
  EXPECT_NEAR(sampler.emitting_area(1), 1 + 0.25f, 1e-6);
  EXPECT_NEAR(sampler.emitting_area(2), 6, 1e-6);
}

TEST(Lights, InverseDensitiesAverageToTheTotalArea) {
  const Scene scene = emitters().load();
  const EmissionTable table = build_emission_table(scene);
  const EmitterSampler sampler(scene, table);
  double sum = 0;
  constexpr uint32_t kCount = 20000;
  for (const Hint& hint : sampler.draw_hints(scene, 5, 0, kCount))
    sum += 1 / static_cast<double>(sampler.area_density(hint.entry));
  EXPECT_NEAR(sum / kCount, 7.25, 0.01);
}

// Chi-square of the points over cells of equal area on one quad, and of the quads among each other.
TEST(Lights, PointsAreUniformOnEmitters) {
  const Scene scene = emitters().load();
  const EmissionTable table = build_emission_table(scene);
  const EmitterSampler sampler(scene, table);
  constexpr int kCells = 8;
  std::vector<int> cells(kCells * kCells, 0);
  int on_red = 0, total = 0;
  for (uint32_t frame = 0; frame < 200; ++frame) {
    for (const Hint& hint : sampler.draw_hints(scene, 1, frame, 256)) {
      ++total;
      EXPECT_EQ(hint.normal, glm::vec3(0, 0, 1));
      if (hint.entry != 2) continue;
      ++on_red;
      EXPECT_NEAR(hint.position.z, 20, 1e-5);
      const int x = std::min(kCells - 1, static_cast<int>(hint.position.x / 3 * kCells)),
                y = std::min(kCells - 1, static_cast<int>(hint.position.y / 2 * kCells));
      ++cells[static_cast<size_t>(y * kCells + x)];
    }
  }
  const double expected_share = 6 * static_cast<double>(sampler.area_density(2));
  EXPECT_NEAR(on_red / static_cast<double>(total), expected_share, 0.002);
  const double expected = on_red / static_cast<double>(kCells * kCells);
  double chi_square = 0;
  for (const int count : cells) chi_square += (count - expected) * (count - expected) / expected;
  // 63 degrees of freedom: mean 63, standard deviation 11.2; 110 is the 0.02 % tail.
  EXPECT_LT(chi_square, 110);
  EXPECT_GT(chi_square, 25);
}

TEST(Lights, HintsAreAFunctionOfSeedAndFrame) {
  const Scene scene = emitters().load();
  const EmitterSampler sampler(scene, build_emission_table(scene));
  const auto positions = [&](uint32_t seed, uint32_t frame) {
    std::vector<float> values;
    for (const Hint& hint : sampler.draw_hints(scene, seed, frame, 64))
      values.insert(values.end(), {hint.position.x, hint.position.y, hint.position.z});
    return values;
  };
  EXPECT_EQ(positions(1, 2), positions(1, 2));
  EXPECT_NE(positions(1, 2), positions(1, 3));
  EXPECT_NE(positions(1, 2), positions(2, 2));
  EXPECT_NE(positions(1, 2), positions(2, 1));
}

TEST(Lights, StratificationGivesEachEmitterItsShareInEveryFrame) {
  const Scene scene = emitters().load();
  const EmitterSampler sampler(scene, build_emission_table(scene));
  const double expected = 6 * static_cast<double>(sampler.area_density(2)) * 64;
  for (uint32_t frame = 0; frame < 50; ++frame) {
    int on_red = 0;
    for (const Hint& hint : sampler.draw_hints(scene, 9, frame, 64)) on_red += hint.entry == 2 ? 1 : 0;
    EXPECT_NEAR(on_red, expected, 2.0);
  }
}

TEST(Lights, NothingEmitsNothingDrawn) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  const Scene scene = builder.load();
  const EmitterSampler sampler(scene, build_emission_table(scene));
  EXPECT_TRUE(sampler.draw_hints(scene, 1, 1, 16).empty());
  EXPECT_EQ(sampler.area_density(1), 0);
}

TEST(Lights, MovingEmittersMoveTheirHints) {
  GltfBuilder builder = emitters();
  builder.animation(0, "translation", {0, 1}, {0, 0, 10, 0, 0, 110});
  const Scene scene = builder.load();
  EmitterSampler sampler(scene, build_emission_table(scene));
  sampler.update(scene, pose(scene, 0.5).dynamic_vertices);
  int moved = 0;
  for (const Hint& hint : sampler.draw_hints(scene, 1, 1, 256)) {
    EXPECT_NE(hint.position.z, 10);
    moved += std::abs(hint.position.z - 60) < 1e-3f ? 1 : 0;
  }
  EXPECT_GT(moved, 20);
}

/// A quad whose emissive texture is bright in its left quarter only.
GltfBuilder quarter_emitter() {
  GltfBuilder builder;
  builder.append("images",
                 {{"uri", "data:image/png;base64," + test::to_base64(test::make_png(4, 1, 8, 0, {255, 0, 10, 20}))}});
  builder.append("samplers", {{"magFilter", 9728}});
  builder.append("textures", {{"source", 0}, {"sampler", 0}});
  builder.append("materials", {{"emissiveFactor", {2, 2, 2}}, {"emissiveTexture", {{"index", 0}}}});
  builder.node({{"mesh", builder.quad(0)}});
  return builder;
}

TEST(Lights, TexturedEmittersAreSampledWhereTheyEmit) {
  const Scene scene = quarter_emitter().load();
  const EmissionTable table = build_emission_table(scene);
  EXPECT_EQ(table.entries[1].radiance, glm::vec3(2)) << "the mean over emitting texels only";
  EXPECT_NEAR(table.entries[1].threshold, 1, 1e-6);
  const EmitterSampler sampler(scene, table);
  EXPECT_NEAR(sampler.area_density(1), 4, 0.05) << "one over the emitting area";
  double mean_x = 0;
  const std::vector<Hint> hints = sampler.draw_hints(scene, 3, 0, 4000);
  for (const Hint& hint : hints) {
    ASSERT_LE(hint.position.x, 0.25f);
    mean_x += static_cast<double>(hint.position.x) / static_cast<double>(hints.size());
  }
  EXPECT_NEAR(mean_x, 0.125, 0.005);
}

TEST(Lights, MoreThan255EmissiveMaterialsAreAnError) {
  for (const int count : {255, 256}) {
    GltfBuilder builder;
    const int quad = builder.quad(0);
    const auto primitive = builder.json["meshes"][quad]["primitives"][0];
    for (int m = 0; m < count; ++m) {
      builder.append("materials", {{"emissiveFactor", {1, 1, 1}}});
      builder.json["meshes"][quad]["primitives"][m] = primitive;
      builder.json["meshes"][quad]["primitives"][m]["material"] = m;
    }
    builder.node({{"mesh", quad}});
    const Scene scene = builder.load();
    if (count == 255) {
      EXPECT_EQ(build_emission_table(scene).entries.size(), 256u);
    } else {
      EXPECT_THROW((void)build_emission_table(scene), Error);
    }
  }
}

}  // namespace
}  // namespace lightloom::scene
