#include "framework/scene/lights.hpp"

#include <algorithm>
#include <cmath>

#include "framework/scene/basis.hpp"
#include "framework/scene/color.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/finish.hpp"

namespace lightloom::scene {
namespace {

constexpr uint32_t kFractionSamples = 256;
constexpr uint32_t kMaxTries = 64;

// The output permutation of PCG-RXS-M-XS (O'Neill 2014) after one step of its generator, as a hash.
uint32_t hash(uint32_t value) {
  const uint32_t state = value * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return (word >> 22u) ^ word;
}

float to_unit_float(uint32_t bits) {
  return static_cast<float>(bits >> 8u) * 0x1p-24f;
}

glm::vec3 emission_texel(const Scene& scene, const Material& material, size_t texel) {
  const std::vector<uint8_t>& rgba = scene.images[static_cast<size_t>(material.emissive_texture.image)].rgba;
  const glm::vec3 color(srgb_to_linear(rgba[texel * 4]), srgb_to_linear(rgba[texel * 4 + 1]),
                        srgb_to_linear(rgba[texel * 4 + 2]));
  return material.emission * color;
}

EmissionEntry make_entry(const Scene& scene, uint32_t index) {
  const Material& material = scene.materials[index];
  EmissionEntry entry;
  entry.material = index;
  entry.two_sided = material.double_sided;
  entry.radiance = material.emission;
  if (material.emissive_texture.image < 0) return entry;
  const Image& image = scene.images[static_cast<size_t>(material.emissive_texture.image)];
  const size_t texels = size_t{image.width} * image.height;
  float largest = 0;
  for (size_t i = 0; i < texels; ++i) largest = std::max(largest, luminance(emission_texel(scene, material, i)));
  entry.threshold = largest * 0.5f;
  glm::dvec3 sum(0);
  size_t emitting = 0;
  for (size_t i = 0; i < texels; ++i) {
    const glm::vec3 emitted = emission_texel(scene, material, i);
    if (luminance(emitted) < entry.threshold) continue;
    sum += glm::dvec3(emitted);
    ++emitting;
  }
  entry.radiance = glm::vec3(sum / static_cast<double>(emitting));
  return entry;
}

uint32_t wrapped_texel(float coordinate, uint32_t size, Wrap wrap) {
  const double floored = std::floor(static_cast<double>(coordinate) * size);
  const auto n = static_cast<double>(size);
  if (wrap == Wrap::clamp) return static_cast<uint32_t>(std::clamp(floored, 0.0, n - 1));
  const double period = wrap == Wrap::mirror ? 2 * n : n;
  const double inside = floored - period * std::floor(floored / period);
  const double reflected = inside >= n ? period - 1 - inside : inside;
  return static_cast<uint32_t>(std::clamp(reflected, 0.0, n - 1));
}

// Barycentric coordinates of b and c; uniform on the triangle for uniform x and y (Heitz 2019, without a square root).
glm::vec2 triangle_point(float x, float y) {
  return y > x ? glm::vec2(x * 0.5f, y - x * 0.5f) : glm::vec2(x - y * 0.5f, y * 0.5f);
}

bool texel_emits(const Scene& scene, const EmissionEntry& entry, const Triangle& triangle, const glm::vec2& point) {
  const Material& material = scene.materials[entry.material];
  const TextureUse& use = material.emissive_texture;
  const auto texcoord = [&](uint32_t corner) {
    const Vertex& vertex = scene.vertices[corner];
    return use.texcoord == 0 ? glm::vec2(vertex.u0, vertex.v0) : vertex.uv1;
  };
  const glm::vec2 uv =
      texcoord(triangle.a) * (1 - point.x - point.y) + texcoord(triangle.b) * point.x + texcoord(triangle.c) * point.y;
  const glm::vec2 transformed = use.linear_transform * uv + use.offset;
  const Image& image = scene.images[static_cast<size_t>(use.image)];
  const size_t texel = size_t{wrapped_texel(transformed.y, image.height, use.wrap_v)} * image.width +
                       wrapped_texel(transformed.x, image.width, use.wrap_u);
  return luminance(emission_texel(scene, material, texel)) >= entry.threshold;
}

}  // namespace

EmissionTable build_emission_table(const Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const Triangle& triangle : scene.triangles) used[triangle.material] = true;
  EmissionTable table;
  table.entries.resize(1);
  table.entry_of_material.assign(scene.materials.size(), 0);
  for (uint32_t m = 0; m < scene.materials.size(); ++m) {
    if (!used[m] || !emits(scene, scene.materials[m])) continue;
    if (table.entries.size() == kMaxEmissionEntries) {
      fail(scene.file.string(), "the scene",
           "has more than " + std::to_string(kMaxEmissionEntries - 1) + " emissive materials, expected fewer",
           "merge materials that emit alike");
    }
    table.entry_of_material[m] = static_cast<uint32_t>(table.entries.size());
    table.entries.push_back(make_entry(scene, m));
  }
  return table;
}

EmitterSampler::EmitterSampler(const Scene& scene, const EmissionTable& table) : entries_(table.entries) {
  for (uint32_t t = 0; t < scene.triangles.size(); ++t) {
    const Triangle& triangle = scene.triangles[t];
    Emitter emitter;
    emitter.triangle = t;
    emitter.entry = table.entry_of_material[triangle.material];
    if (emitter.entry == 0) continue;
    emitter.textured = scene.materials[triangle.material].emissive_texture.image >= 0;
    uint32_t emitting = kFractionSamples;
    for (uint32_t i = 0; emitter.textured && i < kFractionSamples; ++i) {
      // Rank-1 lattice of the plastic number, which spreads any number of points evenly.
      const auto part = [&](double step) {
        const double x = 0.5 + step * i;
        return static_cast<float>(x - std::floor(x));
      };
      const glm::vec2 point = triangle_point(part(0.7548776662466927), part(0.5698402909980532));
      if (texel_emits(scene, entries_[emitter.entry], triangle, point))
        emitter.known_point = point;
      else
        --emitting;
    }
    emitter.emitting_fraction = static_cast<float>(emitting) / kFractionSamples;
    if (emitting == 0) continue;
    emitters_.push_back(emitter);
    moving_ = moving_ || t >= scene.static_triangle_count;
  }
  update(scene, std::span(scene.vertices).subspan(scene.static_vertex_count));
}

void EmitterSampler::update(const Scene& scene, std::span<const Vertex> dynamic_vertices) {
  const auto position = [&](uint32_t vertex) {
    return vertex < scene.static_vertex_count ? scene.vertices[vertex].position
                                              : dynamic_vertices[vertex - scene.static_vertex_count].position;
  };
  if (!moving_ && !cumulative_.empty()) return;
  cumulative_.clear();
  areas_.assign(entries_.size(), 0);
  double total = 0;
  for (Emitter& emitter : emitters_) {
    const Triangle& triangle = scene.triangles[emitter.triangle];
    emitter.a = position(triangle.a);
    emitter.b = position(triangle.b);
    emitter.c = position(triangle.c);
    const EmissionEntry& entry = entries_[emitter.entry];
    const double area = glm::length(double_area(emitter.a, emitter.b, emitter.c)) * 0.5 *
                        static_cast<double>(emitter.emitting_fraction);
    areas_[emitter.entry] += area;
    total += area * static_cast<double>(luminance(entry.radiance)) * (entry.two_sided ? 2 : 1);
    cumulative_.push_back(total);
  }
}

float EmitterSampler::area_density(uint32_t entry) const {
  const double total = cumulative_.empty() ? 0.0 : cumulative_.back();
  if (entry == 0 || !(total > 0)) return 0;
  const double power = static_cast<double>(luminance(entries_[entry].radiance)) * (entries_[entry].two_sided ? 2 : 1);
  return static_cast<float>(power / total);
}

float EmitterSampler::emitting_area(uint32_t entry) const {
  return static_cast<float>(areas_.at(entry));
}

Hint EmitterSampler::sample(const Scene& scene, const Emitter& emitter, uint32_t random_state) const {
  glm::vec2 point = emitter.known_point;
  for (uint32_t attempt = 0; attempt < kMaxTries; ++attempt) {
    const uint32_t x = hash(random_state + 2 * attempt), y = hash(random_state + 2 * attempt + 1);
    const glm::vec2 candidate = triangle_point(to_unit_float(x), to_unit_float(hash(y ^ 0x9E3779B9u)));
    if (emitter.textured && !texel_emits(scene, entries_[emitter.entry], scene.triangles[emitter.triangle], candidate))
      continue;
    point = candidate;
    break;
  }
  Hint hint;
  hint.position = emitter.a * (1 - point.x - point.y) + emitter.b * point.x + emitter.c * point.y;
  hint.normal = glm::vec3(glm::normalize(double_area(emitter.a, emitter.b, emitter.c)));
  hint.entry = emitter.entry;
  hint.triangle = emitter.triangle;
  return hint;
}

std::vector<Hint> EmitterSampler::draw_hints(const Scene& scene, uint32_t seed, uint32_t frame, uint32_t count) const {
  std::vector<Hint> hints;
  const double total = cumulative_.empty() ? 0.0 : cumulative_.back();
  if (!(total > 0) || !std::isfinite(total)) return hints;
  hints.reserve(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t state = hash(i + hash(frame + hash(seed)));
    const double wanted = (static_cast<double>(i) + static_cast<double>(to_unit_float(state))) / count * total;
    const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), wanted);
    const auto index = static_cast<size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin());
    hints.push_back(sample(scene, emitters_[index], hash(state ^ 0x68BC21EBu)));
  }
  return hints;
}

}  // namespace lightloom::scene
