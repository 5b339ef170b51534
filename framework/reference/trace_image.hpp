#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "framework/base/interrupt.hpp"
#include "framework/reference/first_hits.hpp"
#include "framework/reference/parallel.hpp"
#include "framework/reference/path_tracer.hpp"

namespace lightloom::reference {

/// Standard error of what was estimated once, as pass `accumulate` writes it.
constexpr float kUnknownError = 1e4f;

/// Mean and spread of one pixel's paths, in double: a float sum of 65536 bright paths would lose digits.
class PixelMean {
 public:
  void add(const glm::vec3& value) {
    const glm::dvec3 wide(value);
    ++count_;
    const glm::dvec3 step = wide - mean_;
    mean_ += step / static_cast<double>(count_);
    squares_ += step * (wide - mean_);
  }
  [[nodiscard]] glm::vec3 mean() const { return glm::vec3(mean_); }
  /// Standard deviation of the mean; kUnknownError with a single value.
  [[nodiscard]] glm::vec3 standard_error() const {
    if (count_ < 2) return glm::vec3(kUnknownError);
    const auto n = static_cast<double>(count_);
    return glm::vec3(glm::sqrt(squares_ / (n - 1) / n));
  }

 private:
  uint64_t count_ = 0;
  glm::dvec3 mean_{0}, squares_{0};
};

/// What is known of a pixel; `coverage` is 1 where there is a lit surface (radiance, diffuse, specular) or any surface
/// (outgoing).
struct TracedPixel {
  glm::vec3 radiance{0}, diffuse{0}, specular{0};  ///< reflected light over its modulation
  glm::vec3 outgoing{0}, standard_error{0};        ///< [W m^-2 sr^-1]
  float lit = 0, covered = 0;
};

struct ImageSettings {
  uint32_t width = 1, height = 1;  ///< [pixels]
  uint32_t paths = 1;              ///< per pixel
  uint32_t frame = 0, seed = 0;
  uint32_t threads = 0;  ///< 0: all cores
  PathSettings path;
};

/// The first hit of a path, whose random numbers may place it within the pixel.
using FindFirstHit = std::function<FirstHit(uint32_t x, uint32_t y, const PathRandom& random)>;

namespace detail {

/// Sums of one pixel over its paths.
struct PixelSums {
  PixelMean radiance, diffuse, specular, outgoing;
  uint32_t lit = 0, covered = 0, not_finite = 0;

  void add(const FirstHit& hit, const Lobes& light, const glm::vec3& out) {
    if (!std::isfinite(out.x + out.y + out.z)) ++not_finite;
    radiance.add(light.sum() / hit.modulation_sum);
    diffuse.add(light.diffuse / hit.modulation.diffuse);
    specular.add(light.specular / hit.modulation.specular);
    outgoing.add(out);
    covered += hit.surface ? 1 : 0;
    lit += hit.surface && !hit.surface->unlit ? 1 : 0;
  }
};

}  // namespace detail

/// Throws Error (run_failed): some of the paths of an image gave infinity or no number.
void require_finite(uint64_t not_finite, const ImageSettings& settings);

/// Traces an image; `write` is called once a pixel, from any thread. `shared_first_hit`: all paths of a pixel start at
/// one point. The result does not depend on the number of threads.
/// Throws Error (run_failed) if a path gives infinity or no number: nothing is clamped or left out.
template <Geometry G>
void trace_image(const G& geometry, const Lights& lights, const ImageSettings& settings, bool shared_first_hit,
                 const FindFirstHit& first_hit,
                 const std::function<void(uint32_t x, uint32_t y, const TracedPixel&)>& write) {
  const PathTracer<G> tracer(geometry, lights, settings.path);
  std::atomic<uint64_t> not_finite{0};
  const auto trace_pixel = [&](uint32_t x, uint32_t y) {
    detail::PixelSums sums;
    std::optional<FirstHit> hit;
    std::optional<PathVertex> vertex;
    for (uint32_t path = 0; path < settings.paths; ++path) {
      stop_if_interrupted();
      const PathRandom random(x, y, settings.frame, settings.seed, path);
      if (!hit || !shared_first_hit) {
        hit = first_hit(x, y, random);
        vertex.reset();
        if (hit->surface && !hit->surface->unlit)
          vertex.emplace(geometry.start(hit->surface->point), -glm::vec3(hit->ray.direction), settings.path.ward);
      }
      const Lobes light = vertex ? tracer.reflected(*vertex, random) : Lobes{};
      const glm::vec3 own = !hit->surface         ? lights.environment->radiance(glm::vec3(hit->ray.direction))
                            : hit->surface->unlit ? hit->surface->point.reflectance.base_color + hit->surface->emission
                                                  : hit->surface->emission;
      sums.add(*hit, light, light.sum() + own);
      // Background and unlit surfaces are the same for all paths.
      if (shared_first_hit && !vertex) break;
    }
    not_finite += sums.not_finite;
    const bool same_for_all = shared_first_hit && !vertex;
    const float share = 1.0f / static_cast<float>(same_for_all ? 1 : settings.paths);
    write(x, y,
          {sums.radiance.mean(), sums.diffuse.mean(), sums.specular.mean(), sums.outgoing.mean(),
           same_for_all ? glm::vec3(0) : sums.outgoing.standard_error(), static_cast<float>(sums.lit) * share,
           static_cast<float>(sums.covered) * share});
  };
  constexpr uint32_t kTile = 16;
  const uint32_t columns = (settings.width + kTile - 1) / kTile, rows = (settings.height + kTile - 1) / kTile;
  run_tasks(columns * rows, settings.threads, [&](uint32_t tile) {
    const uint32_t left = tile % columns * kTile, top = tile / columns * kTile;
    for (uint32_t y = top; y < std::min(top + kTile, settings.height); ++y)
      for (uint32_t x = left; x < std::min(left + kTile, settings.width); ++x) trace_pixel(x, y);
  });
  require_finite(not_finite, settings);
}

}  // namespace lightloom::reference
