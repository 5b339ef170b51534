#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tests/shaders/statistics.hpp"
#include "tests/shaders/ward_support.hpp"
#include "tests/support/device_fixture.hpp"
#include "tests/support/snippet_runner.hpp"

// Every sampler of directions against a density that C++ knows by itself: samples are drawn on the device by its own
// random numbers, read back, and counted in cells. Each test is also given a wrong density, which it must notice.
namespace lightloom::test {
namespace {

constexpr int kSamples = 400000;
constexpr double kSignificance = 0.0025;  // of all comparisons below together
constexpr int kComparisons = 18;

/// Sidak's correction: the significance of one of many independent comparisons.
double one_of_many() {
  return 1 - std::pow(1 - kSignificance, 1.0 / kComparisons);
}

class ChiSquareTest : public DeviceTest {};

using Density = std::function<double(const Direction&)>;  ///< [sr^-1]

/// Cells of equal theta and phi, with the share of samples below the horizon as one more.
struct Cells {
  static constexpr int kRows = 20, kColumns = 40;

  static size_t at(double x, double y, double z) {
    if (z <= 0) return kRows * kColumns;
    const double phi = std::atan2(y, x), turn = phi < 0 ? phi + 2 * kPi : phi;
    const int row = std::min(kRows - 1, static_cast<int>(std::acos(std::min(1.0, z)) / (kPi / 2) * kRows));
    const int column = std::min(kColumns - 1, static_cast<int>(turn / (2 * kPi) * kColumns));
    return static_cast<size_t>(row * kColumns + column);
  }

  /// Midpoint rule with n^2 points.
  static double integral(const Density& density, int row, int column, int n) {
    const double d_theta = kPi / 2 / kRows / n, d_phi = 2 * kPi / kColumns / n;
    double sum = 0;
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        const Direction direction{(row * n + a + 0.5) * d_theta, (column * n + b + 0.5) * d_phi};
        sum += density(direction) * std::sin(direction.theta);
      }
    return sum * d_theta * d_phi;
  }

  /// Refined until what changes is far below the noise of the count.
  static double expected_count(const Density& density, int row, int column) {
    double count = kSamples * integral(density, row, column, 4);
    for (int n = 8; n <= 256; n *= 2) {
      const double finer = kSamples * integral(density, row, column, n);
      const double change = std::abs(finer - count);
      count = finer;
      if (change < 0.05 * std::sqrt(std::max(finer, 1.0))) break;
    }
    return count;
  }

  static std::vector<double> expected(const Density& density) {
    std::vector<double> cells;
    double total = 0;
    for (int row = 0; row < kRows; ++row)
      for (int column = 0; column < kColumns; ++column) {
        cells.push_back(expected_count(density, row, column));
        total += cells.back();
      }
    cells.push_back(std::max(0.0, kSamples - total));
    return cells;
  }
};

/// `body` defines `vec3 draw(vec4 random)`, the sampler.
std::vector<double> observe(gpu::Device& device, const std::string& body, const std::vector<float>& inputs,
                            const std::vector<ShaderValue>& constants = {}) {
  const std::string snippet = "#include \"lib/random.glsl\"\n" + body + R"(
void evaluate(uint index) {
  vec3 o = draw(random4(RandomKey(uvec2(index & 1023u, index >> 10u), 3u, 11u, 0u, 1u), 0u, kDimensionScatter));
  outputs[3u * index] = o.x;
  outputs[3u * index + 1u] = o.y;
  outputs[3u * index + 2u] = o.z;
})";
  const std::vector<float> o = run_snippet(device, snippet, inputs, 3 * size_t{kSamples}, kSamples, constants);
  std::vector<double> cells(Cells::kRows * Cells::kColumns + 1);
  for (size_t k = 0; k < o.size(); k += 3) ++cells[Cells::at(o[k], o[k + 1], o[k + 2])];
  return cells;
}

const std::string kDrawWard = R"(
#include "lib/ward.glsl"
vec3 draw(vec4 random) {
  vec3 i = vec3(inputs[0], inputs[1], inputs[2]);
  vec2 alpha = vec2(inputs[3], inputs[4]);
  return ward_sample(i, random.xy, alpha);
})";

std::vector<double> observe_ward(gpu::Device& device, const Lobe& lobe, WardSampling sampling) {
  std::vector<float> inputs;
  append(inputs, lobe.incoming);
  inputs.push_back(static_cast<float>(lobe.ax));
  inputs.push_back(static_cast<float>(lobe.ay));
  return observe(device, kDrawWard, inputs, {{"ward_sampling", static_cast<uint32_t>(sampling)}});
}

/// The lobe's own density under either sampling.
Density ward_density(const Lobe& lobe, WardSampling sampling) {
  return [=](const Direction& o) {
    return sampling == WardSampling::exact ? ward_pdf_oracle(lobe.incoming, o, lobe.ax, lobe.ay)
                                           : ward_phi_uniform_pdf_oracle(lobe.incoming, o, lobe.ax, lobe.ay);
  };
}

const std::vector<Lobe>& lobes() {
  static const std::vector<Lobe> list = {
      {{radians(30), 0}, 0.2, 0.2},
      {{radians(45), radians(37)}, 0.1, 0.3},
      {{radians(80), radians(10)}, 0.1, 0.3},
      {{radians(60), radians(90)}, 0.05, 0.5},
      {{radians(30), 0}, 1, 1},
      {{radians(85), radians(200)}, 0.5, 0.25},
  };
  return list;
}

std::string describe(const ChiSquare& result) {
  return "chi2 " + std::to_string(result.statistic) + " of " + std::to_string(result.degrees) + ", p " +
         std::to_string(result.p_value);
}

TEST_F(ChiSquareTest, WardSamplesFollowTheirDensity) {
  for (const WardSampling sampling : {WardSampling::exact, WardSampling::phi_uniform})
    for (const Lobe& lobe : lobes()) {
      const ChiSquare result =
          chi_square(observe_ward(device(), lobe, sampling), Cells::expected(ward_density(lobe, sampling)));
      EXPECT_GT(result.p_value, one_of_many())
          << describe(result) << ", sampling " << static_cast<int>(sampling) << ", theta " << lobe.incoming.theta;
      EXPECT_GT(result.degrees, 20);
    }
}

TEST_F(ChiSquareTest, WaltersDensityIsNotThatOfUniformAzimuths) {
  for (const Lobe& lobe : lobes()) {
    if (lobe.ax == lobe.ay) continue;
    const std::vector<double> observed = observe_ward(device(), lobe, WardSampling::phi_uniform);
    EXPECT_LT(chi_square(observed, Cells::expected(ward_density(lobe, WardSampling::exact))).p_value, 1e-9);
  }
}

TEST_F(ChiSquareTest, WrongDensitiesOfWardAreNoticed) {
  const Lobe lobe = lobes()[1];
  const std::vector<double> observed = observe_ward(device(), lobe, WardSampling::exact);
  const Density right = ward_density(lobe, WardSampling::exact);
  const auto p_value = [&](const Density& density) { return chi_square(observed, Cells::expected(density)).p_value; };
  EXPECT_LT(p_value(ward_density({lobe.incoming, 0.3, 0.1}, WardSampling::exact)), 1e-9) << "alphas swapped";
  EXPECT_LT(p_value(ward_density({lobe.incoming, 0.1, 0.31}, WardSampling::exact)), 1e-9) << "alpha off by 3 %";
  EXPECT_LT(p_value([&](const Direction& o) { return right(o) * half_angles(lobe.incoming, o).cosine; }), 1e-9)
      << "a cosine too few";
}

TEST_F(ChiSquareTest, CosineWeightedDirectionsFollowTheCosine) {
  const std::vector<double> observed =
      observe(device(),
              "#include \"lib/bsdf.glsl\"\nvec3 draw(vec4 random) { return sample_cosine_hemisphere(random.xy); }", {});
  const ChiSquare result = chi_square(observed, Cells::expected([](const Direction& o) { return o.z() / kPi; }));
  EXPECT_GT(result.p_value, one_of_many()) << describe(result);
  EXPECT_LT(chi_square(observed, Cells::expected([](const Direction&) { return 0.5 / kPi; })).p_value, 1e-9);
}

/// Around the z axis, so that the cells are the cone's own; another test turns it.
TEST_F(ChiSquareTest, ConesAreCoveredUniformly) {
  const double cosine = std::cos(radians(36));  // eight rows of cells
  const std::vector<double> observed =
      observe(device(),
              "#include \"lib/sampling.glsl\"\n"
              "vec3 draw(vec4 random) { return sample_cone(vec3(0.0, 0.0, 1.0), inputs[0], random.xy); }",
              {static_cast<float>(1 - cosine)});
  const Density uniform = [&](const Direction& o) { return o.z() > cosine ? 0.5 / kPi / (1 - cosine) : 0; };
  const ChiSquare result = chi_square(observed, Cells::expected(uniform));
  EXPECT_GT(result.p_value, one_of_many()) << describe(result);
  EXPECT_EQ(result.degrees, 8 * Cells::kColumns - 1);
  const Density uniform_angle = [&](const Direction& o) {
    return o.z() > cosine ? 1 / (radians(36) * 2 * kPi * std::sin(o.theta)) : 0;
  };
  EXPECT_LT(chi_square(observed, Cells::expected(uniform_angle)).p_value, 1e-9);
}

/// Dielectric and metal over a Lambertian base: shares by Schlick's terms of grey surfaces, worked out here.
struct Mixture {
  Lobe lobe;
  double base, metallic, f0, f90;
  [[nodiscard]] double specular_share() const {
    const double grazing = std::pow(1 - lobe.incoming.z(), 5);
    const double dielectric = f0 + (f90 - f0) * grazing;
    const double metal = base + (1 - base) * grazing;
    const double specular = (1 - metallic) * dielectric + metallic * metal;
    const double diffuse = base * (1 - metallic) * (1 - dielectric);
    return specular / (specular + diffuse);
  }
};

std::vector<double> observe_mixture(gpu::Device& device, const Mixture& m, WardSampling sampling) {
  std::vector<float> inputs;
  append(inputs, m.lobe.incoming);
  for (const double v : {m.base, m.metallic, m.f0, m.f90, m.lobe.ax, m.lobe.ay})
    inputs.push_back(static_cast<float>(v));
  return observe(device, R"(
#include "lib/bsdf.glsl"
vec3 draw(vec4 random) {
  Bsdf bsdf = Bsdf(vec3(inputs[3]), inputs[4], inputs[5], inputs[6], vec2(inputs[7], inputs[8]));
  return bsdf_sample(bsdf, vec3(inputs[0], inputs[1], inputs[2]), random.xyz).direction;
})",
                 inputs, {{"ward_sampling", static_cast<uint32_t>(sampling)}});
}

TEST_F(ChiSquareTest, SamplesOfTheWholeSurfaceFollowTheMixture) {
  const std::vector<Mixture> mixtures = {{lobes()[1], 0.6, 0.3, 0.04, 1}, {lobes()[5], 0.3, 0.0, 0.08, 0.9}};
  for (const WardSampling sampling : {WardSampling::exact, WardSampling::phi_uniform})
    for (const Mixture& mixture : mixtures) {
      const double share = mixture.specular_share();
      const Density lobe = ward_density(mixture.lobe, sampling);
      const auto expected = [&](double specular) {
        return Cells::expected([&](const Direction& o) { return specular * lobe(o) + (1 - specular) * o.z() / kPi; });
      };
      const std::vector<double> observed = observe_mixture(device(), mixture, sampling);
      const ChiSquare result = chi_square(observed, expected(share));
      EXPECT_GT(result.p_value, one_of_many()) << describe(result) << ", specular " << share;
      EXPECT_LT(chi_square(observed, expected(share + 0.02)).p_value, 1e-9);
    }
}

/// What the device takes for the density is the same, so that weights and multiple importance sampling are right.
TEST_F(ChiSquareTest, TheDeviceKnowsTheDensityOfItsSamples) {
  std::vector<float> u;
  for (int k = 0; k < 400; ++k) u.push_back(static_cast<float>(std::fmod(0.5 + k * 0.6180339887, 1)));
  for (const WardSampling sampling : {WardSampling::exact, WardSampling::phi_uniform})
    for (const Lobe& lobe : lobes()) {
      const Density density = ward_density(lobe, sampling);
      for (const WardSample& s : sample_ward(device(), lobe, u, WardForm::bounded, sampling)) {
        if (s.z <= 1e-3) continue;
        const Direction o{std::acos(std::min(1.0, static_cast<double>(s.z))), std::atan2(s.y, s.x)};
        ASSERT_NEAR(s.pdf / density(o), 1, 5e-4) << s.x << " " << s.y << " " << s.z;
      }
    }
}

}  // namespace
}  // namespace lightloom::test
