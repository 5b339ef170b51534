#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "tests/passes/light_support.hpp"
#include "tests/passes/voxel_support.hpp"
#include "tests/support/device_fixture.hpp"

namespace lightloom::test {
namespace {

constexpr double kPi = 3.141592653589793;

class EmissiveFaces : public DeviceTest {};

/// `count` materials that emit, of growing radiance, the odd ones two-sided, each used by one triangle.
scene::Scene lamps(uint32_t count) {
  std::vector<scene::Material> materials;
  std::vector<WorldTriangle> triangles;
  for (uint32_t k = 0; k < count; ++k) {
    scene::Material material = plain(glm::vec3(0.5f));
    material.emission = glm::vec3(static_cast<float>(k + 1)) * glm::vec3(1, 0.5f, 0.25f);
    material.double_sided = k % 2 == 0;
    materials.push_back(material);
    const float x = static_cast<float>(k) / static_cast<float>(count);
    triangles.push_back({glm::vec3(x, 0, 0), glm::vec3(x, 1, 0), glm::vec3(x, 0, 1)});
  }
  return make_triangle_scene(triangles, materials);
}

Images list_faces(const scene::Scene& scene, int resolution, double density) {
  return run_passes(R"("v": { "type": "voxel_pattern", "params": { "resolution": )" + std::to_string(resolution) +
                        R"(, "density": )" + std::to_string(density) + R"( } },
                       "f": { "type": "emissive_faces", "in": { "voxels": "v.voxels" } })",
                    "f.faces", scene);
}

uint32_t list_value(const image::HostImage& faces, uint32_t index, uint32_t channel) {
  return static_cast<uint32_t>(faces.at(index % 1024, index / 1024, 0, channel));
}

/// Normal of a voxel: y is the pole, 256 steps of azimuth from z towards x, 254 of the polar angle.
glm::dvec3 normal_at(const image::HostImage& normals, const glm::ivec3& voxel) {
  const double azimuth = byte_at(normals, voxel, 0) * kPi / 128;
  const double polar = std::min(byte_at(normals, voxel, 1), 254) * kPi / 254;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth)};
}

struct Face {
  uint32_t code = 0;
  double weight = 0;  ///< before it is rounded
};

struct Expected {
  std::vector<Face> faces;
  std::map<int, double> power;  ///< by emission index
};

/// The list in double precision, for the scene that lamps(count) makes.
Expected expected_faces(const Images& images, uint32_t count) {
  const image::HostImage& albedo = images.at("v.voxels.albedo");
  const Extent3& size = albedo.desc.extent;
  const glm::ivec3 extent(size.width, size.height, size.depth);
  Expected result;
  for_each_voxel(albedo, [&](const glm::ivec3& voxel) {
    const int emission = byte_at(images.at("v.voxels.material"), voxel, 3);
    if (!occupied(albedo, voxel) || emission == 0 || emission > static_cast<int>(count)) return;
    for (int face = 0; face < 6; ++face) {
      glm::ivec3 out(0);
      out[face / 2] = face % 2 == 0 ? -1 : 1;
      const glm::ivec3 next = voxel + out;
      const bool inside = glm::all(glm::greaterThanEqual(next, glm::ivec3(0))) && glm::all(glm::lessThan(next, extent));
      if (inside && occupied(albedo, next)) continue;
      const bool two_sided = emission % 2 == 1;
      const double cosine = glm::dot(glm::dvec3(out), normal_at(images.at("v.voxels.normal"), voxel));
      const double share = two_sided ? 1 : 0.5 + 0.5 * cosine;
      result.power[emission] += share;
      if (share < 1e-3) continue;
      const glm::uvec3 at(voxel);
      result.faces.push_back({at.y << 21 | at.x << 12 | at.z << 3 | static_cast<uint32_t>(face),
                              4095 * share * static_cast<double>(emission) / static_cast<double>(count)});
    }
  });
  std::sort(result.faces.begin(), result.faces.end(), [](const Face& a, const Face& b) { return a.code < b.code; });
  return result;
}

TEST_F(EmissiveFaces, AreThoseThatEmptySpaceAdjoinsInTheirOrder) {
  for (const double density : {0.02, 0.5}) {
    const uint32_t count = 120;  // about half of the pattern's emission indices then mean nothing
    const Images images = list_faces(lamps(count), 24, density);
    const Expected expected = expected_faces(images, count);
    const image::HostImage& faces = images.at("f.faces");
    ASSERT_EQ(list_value(faces, 0, 0), expected.faces.size());
    ASSERT_GT(expected.faces.size(), 100u);
    uint32_t before = 0;
    for (uint32_t k = 0; k < expected.faces.size(); ++k) {
      ASSERT_EQ(list_value(faces, k + 1, 0), expected.faces[k].code) << k;
      const uint32_t cumulative = list_value(faces, k + 1, 1);
      ASSERT_GT(cumulative, before);
      ASSERT_NEAR(cumulative - before, std::max(1.0, expected.faces[k].weight), 0.51) << k;
      before = cumulative;
    }
    EXPECT_EQ(list_value(faces, 0, 1), before);
    for (const auto& [emission, power] : expected.power)
      ASSERT_NEAR(images.at("f.power").at(static_cast<uint32_t>(emission), 0, 0, 0) / 512.0, power,
                  0.01 * power + 0.05);
  }
}

TEST_F(EmissiveFaces, EndWhereTheListIsFull) {
  const Images images = list_faces(lamps(255), 128, 0.3);
  const image::HostImage& faces = images.at("f.faces");
  const Expected expected = expected_faces(images, 255);
  ASSERT_GT(expected.faces.size(), 1048575u);
  ASSERT_EQ(list_value(faces, 0, 0), 1048575u);
  EXPECT_EQ(list_value(faces, 1048575, 0), expected.faces[1048574].code);
  EXPECT_EQ(list_value(faces, 0, 1), list_value(faces, 1048575, 1));
  EXPECT_GT(list_value(faces, 0, 1), list_value(faces, 1048574, 1));
}

TEST_F(EmissiveFaces, OfNothingAreNone) {
  const Images images = list_faces(lamps(4), 16, 0);
  EXPECT_EQ(list_value(images.at("f.faces"), 0, 0), 0u);
  EXPECT_EQ(list_value(images.at("f.faces"), 0, 1), 0u);
}

TEST_F(EmissiveFaces, AreAskedForWhereTheyAreMissing) {
  const scene::Scene scene = make_quad_scene({{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}}, {}, look_at({0, 3, 1}, {}, 0.9f));
  const auto trace = [&](const std::string& params) {
    return run_graph(graph_text(16, 16, 16, 16, trace_passes(16, params), R"("radiance": "trace.radiance")"), scene);
  };
  for (const std::string params : {R"("nee": "voxel_faces")", R"("emitter_area": "surface")"}) {
    try {
      trace(params);
      FAIL() << params;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("not connected"), std::string::npos) << error.what();
      EXPECT_NE(error.hint().find("emissive_faces"), std::string::npos) << error.hint();
    }
  }
}

}  // namespace
}  // namespace lightloom::test
