#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "framework/stability/check.hpp"
#include "framework/stability/scenes.hpp"

namespace lightloom::stability {
namespace {

constexpr std::array<double, 8> kAlphas{0, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.3, 1};
constexpr std::array<double, 7> kDegrees{0, 45, 75, 85, 89, 89.9, 89.99};
constexpr uint32_t kViews = 21;       ///< each angle at azimuths of 0, 45 and 90 degrees
constexpr double kLeastAlpha = 1e-4;  ///< what alphas are raised to
constexpr double kEdge = 1.01e-3;     ///< below it, along both axes, a lobe is a mirror

const std::array<std::string, 3> kForms{"1992", "dur", "bounded"};
const std::array<std::string, 2> kSamplings{"exact", "phi_uniform"};

scene::Scene any_scene() {
  return make_quad_scene({{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}}, {}, look_at({0, 2, 2}, {0, 0, 0}, 0.8f));
}

/// The samples and the density of the lobe over `rows` pairs of alphas; `edge` above 0 stands for all of them.
Images sweep_ward(Lab& lab, size_t form, size_t sampling, uint32_t rows, double edge, bool density = false) {
  const std::string size = std::to_string(kViews) + "x" + std::to_string(rows);
  return lab.last_frame(R"({ "lightloom": 1, "name": "ward_sweep", "passes": { "sweep": { "type": "compute",
      "shader": "stability/ward_sweep.comp", "out": { "samples": { "size": ")" +
                            size + R"(" }, "density": { "size": ")" + size + R"(" } }, "params": { "edge_alpha": )" +
                            std::to_string(edge) + R"(, "density": )" + (density ? "1" : "0") + R"(, "ward": )" +
                            std::to_string(form) + R"(, "ward_sampling": )" + std::to_string(sampling) +
                            R"( } } }, "outputs": { "samples": "sweep.samples", "density": "sweep.density" } })",
                        any_scene());
}

Images sweep_bsdf(Lab& lab, size_t form, size_t sampling, double metallic, uint32_t rows, double edge) {
  const char* heights = form == 2 && sampling == 0 ? "64" : "8";  // its albedo is judged
  return lab.last_frame(R"({ "lightloom": 1, "name": "bsdf_sweep", "passes": { "sweep": { "type": "compute",
      "shader": "stability/bsdf_sweep.comp", "out": { "samples": { "size": "7x)" +
                            std::to_string(rows) + R"(" } }, "params": { "metallic": )" + std::to_string(metallic) +
                            R"(, "edge_alpha": )" + std::to_string(edge) + R"(, "heights": )" + heights +
                            R"(, "ward": )" + std::to_string(form) + R"(, "ward_sampling": )" +
                            std::to_string(sampling) + R"( } } }, "outputs": { "samples": "sweep.samples" } })",
                        any_scene());
}

struct View {
  double degrees = 0;
  double x = 0, y = 0, z = 1;  ///< unit direction to the viewer
};

View view_of(uint32_t column) {
  const double theta = kDegrees.at(column / 3) * std::numbers::pi / 180;
  const double azimuth = (column % 3) * std::numbers::pi / 4;
  return {kDegrees.at(column / 3), std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth),
          std::cos(theta)};
}

double stored_alpha(uint32_t index) {
  return std::max(kAlphas.at(index), kLeastAlpha);
}

/// Share of the half vectors drawn that send the view above the horizon. Along a direction of slopes s (unit in slopes
/// over alpha) those up to a radius do, and the radius r is drawn with density 2 r exp(-r^2).
double share_above_horizon(const View& i, double ax, double ay, bool phi_uniform) {
  constexpr int kAzimuths = 128;  // those that the shader sums over
  double sum = 0;
  for (int k = 0; k < kAzimuths; ++k) {
    const double phi = std::numbers::pi * (2 * (k + 0.5) / kAzimuths - 1);
    double sx = std::cos(phi), sy = std::sin(phi);
    if (phi_uniform) {
      const double scale = 1 / std::hypot(sx / ax, sy / ay);
      sx *= scale;
      sy *= scale;
    } else {
      sx *= ax;
      sy *= ay;
    }
    // o.z = 2 (i . h) h.z - i.z > 0 with h = (r s, 1) / length: i.z + 2 r i.s - i.z r^2 s.s > 0.
    const double towards = i.x * sx + i.y * sy, squared = sx * sx + sy * sy;
    const double root = std::sqrt(towards * towards + i.z * i.z * squared);
    const double last = towards > 0 ? (towards + root) / (i.z * squared) : i.z / (root - towards);
    sum += 1 - std::exp(-last * last);
  }
  return sum / kAzimuths;
}

/// Albedo of the bounded form with the same alpha along both axes: its weights 2 o.z / (i.z + o.z), over half vectors
/// drawn as in share_above_horizon.
double bounded_albedo(const View& i, double alpha) {
  constexpr int kAzimuths = 360, kRadii = 1000;
  double sum = 0;
  for (int k = 0; k < kAzimuths; ++k)
    for (int j = 0; j < kRadii; ++j) {
      const double phi = std::numbers::pi * 2 * (k + 0.5) / kAzimuths;
      const double radius = alpha * std::sqrt(-std::log(1 - (j + 0.5) / kRadii));
      const double towards = i.x * std::cos(phi) * radius + i.y * std::sin(phi) * radius + i.z;
      // h = (slopes, 1) / length: o.z = 2 (i . h) h.z - i.z.
      const double z = 2 * towards / (radius * radius + 1) - i.z;
      if (towards > 0 && z > 0) sum += 2 * z / (i.z + z);
    }
  return sum / (double{kAzimuths} * kRadii);
}

struct WardExtremes {
  double bad = 0;
  double albedo = 0;          ///< largest, to 89 degrees
  double grazing_albedo = 0;  ///< largest anywhere
  double weight = 0;          ///< largest, over its bound
};

/// The bounded form's weights: at most 2, times the ratio of the alphas where the azimuth is uniform.
double weight_bound(double ax, double ay, size_t sampling) {
  return sampling == 0 ? 2 : 2 * std::max(ax, ay) / std::min(ax, ay);
}

WardExtremes ward_extremes(const image::HostImage& samples, size_t sampling) {
  WardExtremes found;
  for (uint32_t row = 0; row < 64; ++row)
    for (uint32_t column = 0; column < kViews; ++column) {
      const double ax = stored_alpha(row / 8), ay = stored_alpha(row % 8);
      if (std::max(ax, ay) < kEdge) continue;  // a mirror
      found.bad += samples.at(column, row, 0, 3);
      found.weight = std::max(found.weight, samples.at(column, row, 0, 1) / weight_bound(ax, ay, sampling));
      // A uniform azimuth meets the long axis of the others too rarely for a mean over so few.
      if (sampling == 1 && weight_bound(ax, ay, 1) > 20.1) continue;
      const double albedo = samples.at(column, row, 0, 0);
      found.grazing_albedo = std::max(found.grazing_albedo, albedo);
      if (kDegrees.at(column / 3) < 89.5) found.albedo = std::max(found.albedo, albedo);
    }
  return found;
}

std::vector<Figure> measure_lobes(Lab& lab) {
  const double least_cosine = std::cos(89.99 * std::numbers::pi / 180);
  std::vector<Figure> figures;
  double bad = 0;
  for (size_t sampling = 0; sampling < kSamplings.size(); ++sampling)
    for (size_t form = 0; form < kForms.size(); ++form) {
      const WardExtremes found = ward_extremes(sweep_ward(lab, form, sampling, 64, 0).at("samples"), sampling);
      const std::string which = kForms.at(form) + ", " + kSamplings.at(sampling) + ": ";
      bad += found.bad;
      if (kForms.at(form) == "bounded") {
        figures.push_back(at_most(which + "largest albedo", found.grazing_albedo, 1 + 1e-3));
        figures.push_back(at_most(which + "largest weight over its bound", found.weight, 1 + 1e-5));
      } else if (kForms.at(form) == "dur") {
        figures.push_back(
            at_most(which + "largest albedo, which has no bound but 1 / cos", found.grazing_albedo, 1 / least_cosine));
      } else {
        figures.push_back(at_most(which + "largest albedo to 89 degrees", found.albedo, 1 + 1e-3));
        figures.push_back(at_most(which + "largest albedo to 89.99 degrees, which has no bound but 1 / sqrt(cos)",
                                  found.grazing_albedo, 1 / std::sqrt(least_cosine)));
      }
    }
  figures.push_back(none("directions, weights, densities and values that are not finite or of unit length", bad));
  return figures;
}

std::vector<Figure> measure_densities(Lab& lab) {
  std::vector<Figure> figures;
  for (size_t sampling = 0; sampling < kSamplings.size(); ++sampling) {
    const Images images = sweep_ward(lab, 2, sampling, 64, 0, true);
    double exact = 0, rounded = 0;
    for (uint32_t row = 0; row < 64; ++row)
      for (uint32_t column = 0; column < kViews; ++column) {
        const double ax = stored_alpha(row / 8), ay = stored_alpha(row % 8);
        const double above = share_above_horizon(view_of(column), ax, ay, sampling == 1);
        const auto off = [&](uint32_t channel) {
          return std::abs(images.at("density").at(column, row, 0, channel) - above);
        };
        exact = std::max(exact, off(0));
        if (std::min(ax, ay) >= 1e-3 && kDegrees.at(column / 3) < 89.5) rounded = std::max(rounded, off(1));
      }
    figures.push_back(
        at_most(kSamplings.at(sampling) + ": integral less the share of samples above the horizon", exact, 3e-3));
    figures.push_back(
        at_most(kSamplings.at(sampling) + ": the same from rounded directions, alpha from 0.001, to 89 degrees",
                rounded, 1e-2));
  }
  return figures;
}

std::vector<Figure> measure_surfaces(Lab& lab) {
  double bad = 0, reflected = 0, least_density = 1e30, largest = 0;
  for (size_t form = 0; form < kForms.size(); ++form)
    for (size_t sampling = 0; sampling < kSamplings.size(); ++sampling)
      for (const double metallic : {0.0, 1.0}) {
        const Images images = sweep_bsdf(lab, form, sampling, metallic, 64, 0);
        for (uint32_t row = 0; row < 64; ++row)
          for (uint32_t column = 0; column < kDegrees.size(); ++column) {
            const auto sample = [&](uint32_t channel) { return images.at("samples").at(column, row, 0, channel); };
            bad += sample(3);
            least_density = std::min(least_density, sample(2));
            if (kForms.at(form) != "bounded" || sampling == 1) continue;
            reflected = std::max(reflected, sample(0));
            largest = std::max(largest, sample(1));
          }
      }
  return {none("weights, densities and values that are not finite, or below 0", bad),
          at_least("least density of a sample that counts", least_density, 1e-30, "1/sr"),
          at_most("largest albedo of base and bounded lobe", reflected, 1 + 1e-3),
          at_most("largest weight of base and bounded lobe, exact sampling", largest, 2 + 1e-4)};
}

/// Albedo just above the alpha from which a lobe has a width, against what a mirror reflects there.
std::vector<Figure> measure_mirror_edge(Lab& lab) {
  std::vector<Figure> figures;
  for (size_t form = 0; form < kForms.size(); ++form) {
    double off = 0, at_horizon = 0, inexact = 0;
    const Images lobe = sweep_ward(lab, form, 0, 1, kEdge * 1.001);
    for (uint32_t column = 0; column < kViews; ++column) {
      const View view = view_of(column);
      const double mirror = kForms.at(form) == "1992" ? view.z : 1;
      const double change = std::abs(lobe.at("samples").at(column, 0, 0, 0) - mirror);
      (view.degrees < 89.5 ? off : at_horizon) = std::max(view.degrees < 89.5 ? off : at_horizon, change);
      if (kForms.at(form) == "bounded")
        inexact =
            std::max(inexact, std::abs(lobe.at("samples").at(column, 0, 0, 0) - bounded_albedo(view, kEdge * 1.001)));
    }
    const std::string name = kForms.at(form) == "1992" ? "1992, against the cosine that narrow lobes of it darken by"
                                                       : kForms.at(form) + ", against a mirror";
    figures.push_back(at_most(name + ", to 89 degrees", off, 0.02));
    if (kForms.at(form) != "bounded") continue;
    // The exact lobe of this alpha is that far from a mirror, too: 89.99 degrees are 0.17 alpha off the horizon, which
    // half of the half vectors send the view below. The loss falls as the square of alpha: 0.02 would take 3.5e-5, a
    // third of the least alpha that lobes are computed with.
    figures.push_back(at_most("bounded, against the exact integral of its lobe, to 89.99 degrees", inexact, 2e-3));
    figures.push_back(at_most(name + ", to 89.99 degrees, 0.17 alpha off the horizon, where the exact lobe loses " +
                                  std::to_string(1 - bounded_albedo(view_of(18), kEdge * 1.001)).substr(0, 5) +
                                  " of the light",
                              at_horizon, 0.14));
  }
  for (const double metallic : {0.0, 1.0}) {
    double step = 0;
    const Images mirror = sweep_bsdf(lab, 2, 0, metallic, 1, kEdge * 0.999);
    const Images lobe = sweep_bsdf(lab, 2, 0, metallic, 1, kEdge * 1.001);
    for (uint32_t column = 0; kDegrees.at(column) < 89.5; ++column)
      step =
          std::max(step, std::abs(lobe.at("samples").at(column, 0, 0, 0) - mirror.at("samples").at(column, 0, 0, 0)));
    figures.push_back(at_most(
        metallic > 0 ? "a metal, either side of the edge" : "a dielectric, either side of the edge", step, 0.02));
  }
  return figures;
}

}  // namespace

void add_material_checks(std::vector<Check>& checks) {
  const std::string group = "materials";
  checks.push_back(
      {.name = "ward_lobes",
       .group = group,
       .extreme = "alpha 0, 1e-6, 1e-4, 0.001, 0.01, 0.1, 0.3 and 1 in all 64 pairs, views from 0 to 89.99 degrees",
       .danger = "0/0 where one alpha is 0, albedos above 1, weights without a bound",
       .guard = "alphas of at least 1e-4, exponent as a quotient, no reflection at a cosine below 1e-6: "
                "shaders/lib/ward.glsl",
       .measure = measure_lobes});
  checks.push_back(
      {.name = "ward_densities",
       .group = group,
       .extreme = "the same alphas and views: the density of each sampling, integrated over directions",
       .danger = "a density that is not that of the samples makes multiple importance sampling wrong",
       .guard = "density from the slopes that are drawn, not normalised over the hemisphere: shaders/lib/ward.glsl",
       .measure = measure_densities});
  checks.push_back(
      {.name = "bsdf_surfaces",
       .group = group,
       .extreme = "a base under a lobe, and a metal, at the same alphas and views",
       .danger = "a lobe picked with probability 0, weights of mirrors, NaN that spreads through the filters",
       .guard = "mirrors apart, densities of both lobes together, tests by > 0: shaders/lib/bsdf.glsl",
       .measure = measure_surfaces});
  checks.push_back(
      {.name = "mirror_edge",
       .group = group,
       .extreme = "alpha on either side of 0.00101, where a lobe becomes a mirror",
       .danger = "a step in brightness between textured roughness 0 and a little more",
       .guard = "the edge lies where lobe and mirror reflect the same: shaders/lib/ward.glsl, kWardMirrorAlpha",
       .measure = measure_mirror_edge});
}

}  // namespace lightloom::stability
