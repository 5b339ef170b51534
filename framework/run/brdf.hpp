#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "framework/gpu/device.hpp"
#include "framework/run/shader_library.hpp"

namespace lightloom::run {

/// Forms of the Ward lobe and ways to draw its half vectors; formulas and sources are in shaders/lib/ward.glsl. The
/// values are those of the shader's constants.
enum class WardForm : uint32_t { ward_1992, dur, bounded };
enum class WardSampling : uint32_t { exact, phi_uniform };

/// A lobe of reflectance 1.
struct WardLobe {
  WardForm form = WardForm::bounded;
  WardSampling sampling = WardSampling::exact;
  double alpha_x = 0.3;  ///< root mean square slope times sqrt(2) along the tangent, 0..1; below 1e-4 counts as 1e-4
  double alpha_y = 0.3;  ///< across it
};

/// A direction of the upper hemisphere [degrees]: theta from the normal, 0..90; phi from the tangent to the bitangent.
struct PolarDirection {
  double theta = 0;
  double phi = 0;
};

struct DirectionPair {
  PolarDirection incoming;  ///< towards where the light, or the path, comes from
  PolarDirection outgoing;
};

struct LobeValues {
  float f = 0;          ///< [sr^-1]; 0 at the horizon
  float pdf = 0;        ///< of `outgoing`, if it is drawn [sr^-1]
  float weight = 0;     ///< f cos(theta of outgoing) / pdf
  bool mirror = false;  ///< so smooth that the path tracer takes the lobe for a mirror instead
};

struct LobeSample {
  std::array<float, 3> direction{};  ///< unit; below the horizon (z <= 0) the sample is lost: f, pdf and weight are 0
  LobeValues values;
};

/// The Ward lobe as the device computes it, by shaders/brdf.comp. Results are in the order of what is asked.
class BrdfEvaluator {
 public:
  /// Throws Error(no_device).
  explicit BrdfEvaluator(const gpu::DeviceOptions& options, const ShaderFolders& folders = default_shader_folders());

  [[nodiscard]] std::vector<LobeValues> evaluate(const WardLobe& lobe, std::span<const DirectionPair> pairs);
  /// The direction that two numbers in [0, 1) are mapped to.
  [[nodiscard]] LobeSample sample(const WardLobe& lobe, const PolarDirection& incoming, std::array<double, 2> u);
  /// Share of the light from each direction that the lobe reflects; does not depend on the sampling. Quadrature, to
  /// 1e-4 of the larger of 1 and the albedo. 0 at the horizon itself.
  [[nodiscard]] std::vector<double> albedo(const WardLobe& lobe, std::span<const PolarDirection> incoming);

  [[nodiscard]] const gpu::Device& device() const { return device_; }

 private:
  enum class Quantity : uint32_t { evaluate, sample, albedo };
  struct Query {
    std::array<float, 4> i, o, h;
  };
  struct Answer {
    std::array<float, 4> direction, values;
  };
  /// `per_query` invocations, and answers, for each query.
  [[nodiscard]] std::vector<Answer> run(Quantity quantity, const WardLobe& lobe, std::span<const Query> queries,
                                        uint32_t per_query);

  gpu::Device device_;
  ShaderLibrary shaders_;
};

}  // namespace lightloom::run
