#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "framework/scene/scene.hpp"

namespace lightloom::scene {

/// What the surfaces of one emissive material emit.
struct EmissionEntry {
  glm::vec3 radiance{0};  ///< [W·m⁻²·sr⁻¹]; of a textured emitter the mean over the texels that emit
  bool two_sided = false;
  float threshold = 0;  ///< texels of smaller luminance do not emit: half the largest; 0 without a texture
  uint32_t material = 0;
};

constexpr size_t kMaxEmissionEntries = 256;  ///< with entry 0; kEmissionLimit of shaders/lib/scene.glsl

/// Entry 0 is "no emission"; the others are the emissive materials that triangles use, in the order of materials.
struct EmissionTable {
  std::vector<EmissionEntry> entries;
  std::vector<uint32_t> entry_of_material;  ///< by material; 0: does not emit
};

/// Throws Error if more than 255 materials emit.
[[nodiscard]] EmissionTable build_emission_table(const Scene& scene);

/// A point on an emitter.
struct Hint {
  glm::vec3 position{0};  ///< [m]
  glm::vec3 normal{0};    ///< unit, geometric, on the front side
  uint32_t entry = 0;     ///< of the emission table
  uint32_t triangle = 0;  ///< that it lies on
};

/// Draws points on the emissive triangles for next-event estimation.
///
/// A triangle is picked with probability proportional to luminance(radiance) * sides * emitting area, and a point
/// uniformly on its emitting part. So the density on emitting surfaces depends on the emission entry alone:
///     p = luminance(radiance) * sides / sum(luminance * sides * emitting area)   [m⁻²]
/// with sides = 2 for two-sided emitters and 1 for others. The other side of multiple importance sampling, which hits
/// an emitter by chance, looks p up by entry (`area_density`).
///
/// The emitting part of a textured triangle (texels at or above the threshold, nearest texel) is estimated with 256
/// points; the relative error of p on that triangle is that of the estimate, about 1/sqrt(256 f (1-f)^-1) for an
/// emitting fraction f. Where 64 tries find no emitting texel, a point of the estimate is taken instead.
class EmitterSampler {
 public:
  EmitterSampler(const Scene& scene, const EmissionTable& table);

  /// Takes over the positions of a pose, where emitters move; `dynamic_vertices` as Pose::dynamic_vertices.
  void update(const Scene& scene, std::span<const Vertex> dynamic_vertices);

  /// Density of the points per area of an emitting surface [m⁻²]; 0 for entry 0 and where nothing emits.
  [[nodiscard]] float area_density(uint32_t entry) const;

  /// Area of the triangles of an entry, one side of it, as far as they emit [m²].
  [[nodiscard]] float emitting_area(uint32_t entry) const;

  /// `count` points, stratified over the emitted power, a function of its arguments and the pose alone. Empty if
  /// nothing emits.
  [[nodiscard]] std::vector<Hint> draw_hints(const Scene& scene, uint32_t seed, uint32_t frame, uint32_t count) const;

 private:
  struct Emitter {
    uint32_t triangle = 0;
    uint32_t entry = 0;
    float emitting_fraction = 1;
    glm::vec2 known_point{1.0f / 3};  ///< barycentric coordinates of a point that emits
    bool textured = false;
    glm::vec3 a{0}, b{0}, c{0};  ///< corners of this pose
  };
  [[nodiscard]] Hint sample(const Scene& scene, const Emitter& emitter, uint32_t random_state) const;

  std::vector<EmissionEntry> entries_;
  std::vector<Emitter> emitters_;
  bool moving_ = false;             ///< any of them; else one update is enough
  std::vector<double> areas_;       ///< by entry [m²]
  std::vector<double> cumulative_;  ///< power up to and including each emitter
};

}  // namespace lightloom::scene
