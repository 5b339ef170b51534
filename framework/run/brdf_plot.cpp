#include "framework/run/brdf_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "framework/image/canvas.hpp"
#include "framework/image/png.hpp"

namespace lightloom::run {
namespace {

using image::Align;
using image::Box;
using image::Canvas;
using image::Color;
using image::Point;

constexpr double kRadiansPerDegree = 3.141592653589793 / 180;
constexpr Color kPaper{1, 1, 1}, kInk{0.13f, 0.13f, 0.15f}, kGrid{0.85f, 0.85f, 0.87f}, kAxis{0.45f, 0.45f, 0.48f};

struct Form {
  WardForm form;
  const char* name;
  Color color;  ///< told apart by the colour-blind, too
};
constexpr std::array kForms = {Form{WardForm::ward_1992, "ward92", {0.90f, 0.62f, 0.0f}},
                               Form{WardForm::dur, "dur", {0.0f, 0.62f, 0.45f}},
                               Form{WardForm::bounded, "bounded", {0.0f, 0.35f, 0.75f}}};

std::string number_text(double number) {
  char text[32];
  (void)std::snprintf(text, sizeof(text), "%.4g", number);
  return text;
}

/// Two or three digits, at most 7 letters.
std::string short_text(double number) {
  char text[32];
  (void)std::snprintf(text, sizeof(text), number >= 0.01 && number < 1000 ? "%.3g" : "%.1e", number);
  return text;
}

/// 1, 2 or 5 times a power of ten, so that `maximum` has two to five steps.
double nice_step(double maximum) {
  const double power = std::pow(10.0, std::floor(std::log10(maximum / 2)));
  const double mantissa = maximum / 2 / power;
  return power * (mantissa >= 5 ? 5 : mantissa >= 2 ? 2 : 1);
}

struct Plot {
  BrdfEvaluator& evaluator;
  WardLobe lobe;
  DirectionPair pair;
  Canvas canvas{1500, 620, kPaper};
};

double thickness_of(const Plot& plot, WardForm form) {
  return form == plot.lobe.form ? 3.5 : 1.5;
}

WardLobe with_form(WardLobe lobe, WardForm form) {
  lobe.form = form;
  return lobe;
}

/// Angles in the plane of incidence from -90 (the side of wi) to 90 [degrees]: even ones, and ever denser ones towards
/// the mirror direction, where a smooth lobe is a needle.
std::vector<double> slice_angles(double theta) {
  std::vector<double> angles;
  for (int k = -720; k <= 720; ++k) angles.push_back(k / 8.0);
  for (int k = -400; k <= 400; ++k) angles.push_back(std::clamp(theta + 90 * std::pow(k / 400.0, 3), -90.0, 90.0));
  std::sort(angles.begin(), angles.end());
  return angles;
}

/// f cos(theta of wo): the share of the light that leaves to wo, per solid angle; bounded at the horizon, as f is not.
std::vector<double> scattered(Plot& plot, WardForm form, const std::vector<DirectionPair>& pairs) {
  std::vector<double> values;
  for (const LobeValues& v : plot.evaluator.evaluate(with_form(plot.lobe, form), pairs))
    values.push_back(v.f * std::cos(pairs[values.size()].outgoing.theta * kRadiansPerDegree));
  return values;
}

/// For a scale that is never 0.
double maximum_of(const std::vector<double>& values) {
  const double maximum = *std::max_element(values.begin(), values.end());
  return maximum > 0 ? maximum : 1;
}

std::vector<double> slice_values(Plot& plot, WardForm form, const std::vector<double>& angles) {
  std::vector<DirectionPair> pairs;
  for (const double angle : angles)
    pairs.push_back({plot.pair.incoming, {std::abs(angle), plot.pair.incoming.phi + (angle < 0 ? 0 : 180)}});
  return scattered(plot, form, pairs);
}

Point on_circle(const Point& centre, double radius, double angle) {
  return {centre.x + radius * std::sin(angle * kRadiansPerDegree),
          centre.y - radius * std::cos(angle * kRadiansPerDegree)};
}

void draw_polar_axes(Canvas& canvas, const Point& centre, double radius, double maximum) {
  const double step = nice_step(maximum);
  for (double ring = step; ring <= maximum * 1.001; ring += step) {
    std::vector<Point> arc;
    for (int angle = -90; angle <= 90; angle += 2) arc.push_back(on_circle(centre, radius * ring / maximum, angle));
    canvas.line(arc, 1, kGrid);
    canvas.text({centre.x - radius * ring / maximum, centre.y + 16}, number_text(ring), kAxis, Align::centre);
  }
  for (int angle = -90; angle <= 90; angle += 30) {
    const std::array spoke = {centre, on_circle(centre, radius * 1.03, angle)};
    canvas.line(spoke, 1, angle == -90 || angle == 90 ? kAxis : kGrid);
    const Align align = angle < 0 ? Align::right : angle > 0 ? Align::left : Align::centre;
    canvas.text(on_circle(centre, radius * 1.08, angle), std::to_string(std::abs(angle)), kAxis, align);
  }
}

/// The chosen one first, so that its broad line does not hide others.
std::array<Form, 3> chosen_first(WardForm chosen) {
  std::array<Form, 3> forms = kForms;
  std::stable_partition(forms.begin(), forms.end(), [chosen](const Form& form) { return form.form == chosen; });
  return forms;
}

void draw_slice(Plot& plot, const Point& centre, double radius) {
  const std::vector<double> angles = slice_angles(plot.pair.incoming.theta);
  const double maximum = maximum_of(slice_values(plot, plot.lobe.form, angles));
  Canvas& canvas = plot.canvas;
  canvas.text({centre.x, centre.y - radius - 60}, "f cos in the plane of incidence (1/sr)", kInk, Align::centre);
  draw_polar_axes(canvas, centre, radius, maximum);
  const Box clip{centre.x - radius * 1.15, centre.y - radius * 1.15, centre.x + radius * 1.15, centre.y + 1};
  for (const Form& form : chosen_first(plot.lobe.form)) {
    const std::vector<double> values = slice_values(plot, form.form, angles);
    std::vector<Point> curve;
    for (size_t k = 0; k < angles.size(); ++k)
      curve.push_back(on_circle(centre, radius * values[k] / maximum, angles[k]));
    canvas.line(curve, thickness_of(plot, form.form), form.color, clip);
  }
  const std::array ray = {on_circle(centre, radius * 1.03, -plot.pair.incoming.theta), centre};
  canvas.line(ray, 2, kInk);
  const double beside = plot.pair.incoming.theta > 45 ? 7 : -7;
  canvas.text(on_circle(centre, radius * 0.95, beside - plot.pair.incoming.theta), "wi", kInk, Align::right);
}

/// Dark to bright in steps that look alike, for 0..1.
Color heat(double value) {
  constexpr std::array<Color, 5> kAnchors = {Color{0.02f, 0.02f, 0.07f}, Color{0.30f, 0.07f, 0.48f},
                                             Color{0.71f, 0.21f, 0.47f}, Color{0.98f, 0.53f, 0.38f},
                                             Color{0.99f, 0.98f, 0.75f}};
  const double place = std::clamp(value, 0.0, 1.0) * (kAnchors.size() - 1);
  const size_t below = std::min(static_cast<size_t>(place), kAnchors.size() - 2);
  const auto mix = static_cast<float>(place - static_cast<double>(below));
  const Color &a = kAnchors[below], &b = kAnchors[below + 1];
  return {a.r + (b.r - a.r) * mix, a.g + (b.g - a.g) * mix, a.b + (b.b - a.b) * mix};
}

/// Lambert's equal-area map of the hemisphere to a disc; the tangent (phi 0) points right, the bitangent up.
Point map_point(const Point& centre, double radius, const PolarDirection& direction) {
  const double r = radius * std::sqrt(2.0) * std::sin(0.5 * direction.theta * kRadiansPerDegree);
  const double phi = direction.phi * kRadiansPerDegree;
  return {centre.x + r * std::cos(phi), centre.y - r * std::sin(phi)};
}

constexpr double kDecades = 4;

double decade_share(double value, double maximum) {
  return value > 0 ? 1 + std::log10(value / maximum) / kDecades : 0;
}

void draw_color_bar(Canvas& canvas, const Box& bar, double maximum) {
  for (double x = bar.left; x < bar.right; x += 1)
    canvas.fill({x, bar.top, x + 1, bar.bottom}, heat((x - bar.left) / (bar.right - bar.left)));
  for (int decade = 0; decade <= kDecades; ++decade) {
    const double x = bar.left + (bar.right - bar.left) * decade / kDecades;
    const std::array tick = {Point{x, bar.bottom}, Point{x, bar.bottom + 6}};
    canvas.line(tick, 1, kAxis);
    canvas.text({x, bar.bottom + 18}, short_text(maximum * std::pow(10.0, decade - kDecades)), kAxis, Align::centre);
  }
}

void draw_map(Plot& plot, const Point& centre, double radius) {
  struct Pixel {
    int64_t x, y;
  };
  std::vector<Pixel> pixels;
  std::vector<DirectionPair> pairs;
  const auto reach = static_cast<int64_t>(radius);
  for (int64_t y = -reach; y < reach; ++y)
    for (int64_t x = -reach; x < reach; ++x) {
      const double right = (static_cast<double>(x) + 0.5) / radius, up = -(static_cast<double>(y) + 0.5) / radius;
      const double r = std::hypot(right, up);
      if (r >= 1) continue;
      pixels.push_back({x, y});
      pairs.push_back(
          {plot.pair.incoming,
           {2 * std::asin(r / std::sqrt(2.0)) / kRadiansPerDegree, std::atan2(up, right) / kRadiansPerDegree}});
    }
  const PolarDirection mirrored{plot.pair.incoming.theta, plot.pair.incoming.phi + 180};
  pairs.push_back({plot.pair.incoming, mirrored});  // a needle may fall between pixels
  const std::vector<double> values = scattered(plot, plot.lobe.form, pairs);
  const double maximum = maximum_of(values);
  Canvas& canvas = plot.canvas;
  for (size_t k = 0; k < pixels.size(); ++k)
    canvas.set(static_cast<int64_t>(centre.x) + pixels[k].x, static_cast<int64_t>(centre.y) + pixels[k].y,
               heat(decade_share(values[k], maximum)));
  const Point needle = map_point(centre, radius, mirrored);
  canvas.set(static_cast<int64_t>(needle.x), static_cast<int64_t>(needle.y),
             heat(decade_share(values.back(), maximum)));
  canvas.text({centre.x, centre.y - radius - 50}, "f cos over wo (1/sr)", kInk, Align::centre);
  for (const double theta : {30.0, 60.0, 90.0}) {
    const double r = map_point({0, 0}, radius, {theta, 0}).x;
    canvas.circle(centre, r, theta < 90 ? 0.5 : 1.5, theta < 90 ? kGrid : kAxis);
    if (theta < 90) canvas.text({centre.x + r + 4, centre.y + 10}, number_text(theta), kGrid, Align::left);
  }
  for (int phi = 0; phi < 360; phi += 90) {
    const Point place = map_point(centre, radius + 26, {90, static_cast<double>(phi)});
    canvas.text(place, "phi " + std::to_string(phi), kAxis,
                phi == 0     ? Align::left
                : phi == 180 ? Align::right
                             : Align::centre);
  }
  canvas.circle(map_point(centre, radius, plot.pair.incoming), 6, 2, kPaper);
  canvas.disc(map_point(centre, radius, plot.pair.outgoing), 4, kPaper);
  draw_color_bar(canvas, {centre.x - radius, centre.y + radius + 50, centre.x + radius, centre.y + radius + 66},
                 maximum);
}

void draw_albedo_axes(Canvas& canvas, const Box& frame, double top) {
  const auto line = [&](const Point& a, const Point& b, const Color& color) {
    const std::array points = {a, b};
    canvas.line(points, 1, color);
  };
  for (double value = 0; value <= top; value += 0.25) {
    const double y = frame.bottom - (frame.bottom - frame.top) * value / top;
    line({frame.left, y}, {frame.right, y}, value == 1 ? kAxis : kGrid);
    canvas.text({frame.left - 10, y}, number_text(value), kAxis, Align::right);
  }
  for (int theta = 0; theta <= 90; theta += 15) {
    const double x = frame.left + (frame.right - frame.left) * theta / 90;
    line({x, frame.top}, {x, frame.bottom + 6}, kGrid);
    canvas.text({x, frame.bottom + 18}, std::to_string(theta), kAxis, Align::centre);
  }
  line({frame.left, frame.top}, {frame.left, frame.bottom}, kAxis);
  line({frame.left, frame.bottom}, {frame.right, frame.bottom}, kAxis);
}

void draw_albedo(Plot& plot, const Box& frame) {
  constexpr double kTop = 1.5;
  Canvas& canvas = plot.canvas;
  const double middle = (frame.left + frame.right) / 2;
  canvas.text({middle, frame.top - 40}, "albedo over theta of wi (degrees)", kInk, Align::centre);
  draw_albedo_axes(canvas, frame, kTop);
  const auto x_of = [&](double theta) { return frame.left + (frame.right - frame.left) * theta / 90; };
  std::vector<PolarDirection> directions;
  for (int theta = 0; theta < 80; theta += 2)
    directions.push_back({static_cast<double>(theta), plot.pair.incoming.phi});
  for (double theta = 80; theta < 89.8; theta += 0.5) directions.push_back({theta, plot.pair.incoming.phi});
  directions.push_back({89.9, plot.pair.incoming.phi});
  for (const Form& form : chosen_first(plot.lobe.form)) {
    const std::vector<double> albedos = plot.evaluator.albedo(with_form(plot.lobe, form.form), directions);
    std::vector<Point> curve;
    for (size_t k = 0; k < directions.size(); ++k)
      curve.push_back({x_of(directions[k].theta), frame.bottom - (frame.bottom - frame.top) * albedos[k] / kTop});
    canvas.line(curve, thickness_of(plot, form.form), form.color, frame);
  }
  const std::array marker = {Point{x_of(plot.pair.incoming.theta), frame.top},
                             Point{x_of(plot.pair.incoming.theta), frame.bottom}};
  canvas.line(marker, 1.5, kInk);
  canvas.text({x_of(plot.pair.incoming.theta), frame.top - 12}, "wi", kInk, Align::centre);
}

void draw_legend(Plot& plot, Point at) {
  for (const Form& form : kForms) {
    const std::array sample = {at, Point{at.x + 40, at.y}};
    plot.canvas.line(sample, thickness_of(plot, form.form), form.color);
    plot.canvas.text({at.x + 52, at.y}, form.name, kInk, Align::left);
    at.y += 26;
  }
}

}  // namespace

void plot_brdf(BrdfEvaluator& evaluator, const WardLobe& lobe, const DirectionPair& pair,
               const std::filesystem::path& file) {
  Plot plot{evaluator, lobe, pair};
  const auto* chosen =
      std::find_if(kForms.begin(), kForms.end(), [&](const Form& form) { return form.form == lobe.form; });
  const std::string title = std::string(chosen->name) + "   alpha " + number_text(lobe.alpha_x) + ", " +
                            number_text(lobe.alpha_y) + "   wi " + number_text(pair.incoming.theta) + ", " +
                            number_text(pair.incoming.phi) + "   wo " + number_text(pair.outgoing.theta) + ", " +
                            number_text(pair.outgoing.phi);
  plot.canvas.text({plot.canvas.width() / 2.0, 32}, title, kInk, Align::centre, 3);
  draw_slice(plot, {235, 410}, 180);
  draw_legend(plot, {175, 490});
  draw_map(plot, {760, 320}, 180);
  draw_albedo(plot, {1090, 140, 1470, 540});
  std::error_code ignored;  // writing says what is wrong, with the name of the file
  std::filesystem::create_directories(file.parent_path(), ignored);
  image::write_png(file, plot.canvas.image());
}

}  // namespace lightloom::run
