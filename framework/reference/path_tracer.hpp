#pragma once

#include <cstdint>

#include "framework/reference/bsdf.hpp"
#include "framework/reference/frame.hpp"
#include "framework/reference/geometry.hpp"
#include "framework/reference/lights.hpp"
#include "framework/reference/random.hpp"

namespace lightloom::reference {

/// What finds light that both next event estimation (NEE) and scattered rays can find: both, sharing it by the balance
/// heuristic (Veach 1997, section 9.2), or one of them alone. Light without extent is always found by the former, light
/// in mirrors by the latter.
enum class Strategy : uint8_t { mis, nee, bsdf };

struct PathSettings {
  uint32_t bounces = 3;  ///< times that light may be scattered on its way to the first hit; 0 leaves direct light
  WardForm ward = WardForm::bounded;
  Strategy strategy = Strategy::mis;
};

/// A surface point with the reflection towards where the path came from.
class PathVertex {
 public:
  PathVertex(const SurfacePoint& surface, const glm::vec3& to_viewer, WardForm ward)
      : surface_(surface),
        frame_(Frame::around(surface.normal, surface.tangent)),
        bsdf_(surface.reflectance, ward, frame_.to_local(to_viewer)) {}

  [[nodiscard]] const SurfacePoint& surface() const { return surface_; }
  [[nodiscard]] const Bsdf& bsdf() const { return bsdf_; }
  [[nodiscard]] glm::vec3 to_world(const glm::vec3& direction) const { return frame_.to_world(direction); }
  /// Is a direction on the side of the surface that reflects?
  [[nodiscard]] bool outside(const glm::vec3& direction) const {
    return glm::dot(direction, surface_.geometric_normal) > 0;
  }
  [[nodiscard]] Bsdf::Evaluation evaluate(const glm::vec3& direction) const {
    return outside(direction) ? bsdf_.evaluate(frame_.to_local(direction)) : Bsdf::Evaluation{};
  }

 private:
  SurfacePoint surface_;
  Frame frame_;
  Bsdf bsdf_;
};

/// Unbiased light transport over a geometry, for paths of at most `bounces` + 2 edges behind the first hit. Each vertex
/// takes one sample of the emitters, the sun, the environment's image and the punctual lights, and sends out one ray.
template <Geometry G>
class PathTracer {
 public:
  PathTracer(const G& geometry, const Lights& lights, const PathSettings& settings)
      : geometry_(geometry),
        lights_(lights),
        settings_(settings),
        sample_emitters_(geometry.emits() && settings.strategy != Strategy::bsdf),
        sample_sun_(lights.sun.shines() && (settings.strategy != Strategy::bsdf || !lights.sun.has_extent())),
        // Scattered rays find an even environment at least as well.
        sample_environment_(lights.environment->shines() && settings.strategy != Strategy::bsdf &&
                            (settings.strategy == Strategy::nee || lights.environment->is_image())),
        rays_find_light_(geometry.emits() || lights.sun.has_extent() || lights.environment->shines()) {}

  /// Radiance that each lobe of the first hit scatters to the viewer along one path, without what the surface emits
  /// [W m^-2 sr^-1].
  [[nodiscard]] Lobes reflected(const PathVertex& first, const PathRandom& random) const {
    Lobes light = direct(first, random, 0);
    if (settings_.bounces == 0 && !rays_find_light_) return light;
    const Bsdf::Sample scatter = scattered(first, random, 0);
    if (scatter.weight.sum() == glm::vec3(0)) return light;
    return light.add_scaled(scatter.weight, incoming(first, scatter, random));
  }

 private:
  static Bsdf::Sample scattered(const PathVertex& vertex, const PathRandom& random, uint32_t index) {
    const float pick = random.pair(index, Decision::lobe).x;
    return vertex.bsdf().sample(pick, random.pair(index, Decision::direction));
  }

  /// Light along the ray that was scattered from the first hit.
  [[nodiscard]] glm::vec3 incoming(PathVertex vertex, Bsdf::Sample scatter, const PathRandom& random) const {
    glm::vec3 radiance(0), throughput(1);
    for (uint32_t index = 1;; ++index) {
      const Ray ray{vertex.surface().origin, vertex.to_world(scatter.direction)};
      if (!vertex.outside(ray.direction)) break;
      const auto hit = geometry_.closest_hit(ray);
      if (!hit) {
        radiance += throughput * (met(lights_.environment->hit(ray.direction), scatter, sample_environment_) +
                                  met(lights_.sun.hit(ray.direction), scatter, sample_sun_));
        break;
      }
      radiance += throughput * met(geometry_.emission(vertex.surface(), ray, *hit), scatter, sample_emitters_);
      if (index > settings_.bounces) break;
      vertex = PathVertex(geometry_.surface(ray, *hit), -ray.direction, settings_.ward);
      radiance += throughput * direct(vertex, random, index).sum();
      if (index == settings_.bounces && !rays_find_light_) break;
      scatter = scattered(vertex, random, index);
      throughput *= scatter.weight.sum();
      if (throughput == glm::vec3(0)) break;
    }
    return radiance;
  }

  /// The share of light that a scattered ray met.
  [[nodiscard]] glm::vec3 met(const LightHit& hit, const Bsdf::Sample& scatter, bool sampled) const {
    if (hit.radiance == glm::vec3(0)) return hit.radiance;
    if (!sampled || scatter.mirror || !(hit.pdf > 0)) return hit.radiance;
    return settings_.strategy == Strategy::nee ? glm::vec3(0) : hit.radiance * (scatter.pdf / (scatter.pdf + hit.pdf));
  }

  /// Light that reaches a vertex without being scattered before, as each lobe reflects it.
  [[nodiscard]] Lobes direct(const PathVertex& vertex, const PathRandom& random, uint32_t index) const {
    Lobes light;
    if (sample_emitters_)
      add(light, vertex, true,
          geometry_.sample_emitter(vertex.surface(), random.pair(index, Decision::emitter),
                                   random.pair(index, Decision::emitter_point)));
    if (sample_sun_)
      add(light, vertex, lights_.sun.has_extent(), lights_.sun.sample(random.pair(index, Decision::sun)));
    if (sample_environment_)
      add(light, vertex, true,
          lights_.environment->sample(random.pair(index, Decision::environment_cell),
                                      random.pair(index, Decision::environment_point)));
    if (!lights_.punctual.empty())
      add(light, vertex, false,
          lights_.punctual.sample(vertex.surface().position, random.pair(index, Decision::punctual).x));
    return light;
  }

  void add(Lobes& light, const PathVertex& vertex, bool has_extent, const LightSample& sample) const {
    if (!(sample.pdf > 0) || sample.radiance == glm::vec3(0)) return;
    const Bsdf::Evaluation reflected = vertex.evaluate(sample.direction);
    if (reflected.value.sum() == glm::vec3(0) || geometry_.occluded(vertex.surface(), sample)) return;
    const bool shared = has_extent && settings_.strategy == Strategy::mis;
    light.add_scaled(reflected.value, sample.radiance / (sample.pdf + (shared ? reflected.pdf : 0)));
  }

  const G& geometry_;
  const Lights& lights_;
  PathSettings settings_;
  bool sample_emitters_, sample_sun_, sample_environment_;
  bool rays_find_light_;
};

}  // namespace lightloom::reference
