#include "framework/image/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "framework/image/font.hpp"

namespace lightloom::image {
namespace {

constexpr int kCircleSegments = 180;

std::byte to_byte(float value) {
  return static_cast<std::byte>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double along = squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return std::hypot(p.x - a.x - along * dx, p.y - a.y - along * dy);
}

bool finite(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Pixels whose centres are in [low, high), within [0, size).
struct PixelRange {
  int64_t begin, end;
};
PixelRange pixels_between(double low, double high, uint32_t size) {
  const double limit = size;
  return {static_cast<int64_t>(std::clamp(std::ceil(low - 0.5), 0.0, limit)),
          static_cast<int64_t>(std::clamp(std::ceil(high - 0.5), 0.0, limit))};
}

}  // namespace

Canvas::Canvas(uint32_t width, uint32_t height, const Color& background)
    : width_(width), height_(height), pixels_(size_t{width} * height, background) {}

void Canvas::blend(size_t pixel, const Color& color, float coverage) {
  Color& target = pixels_[pixel];
  target.r += (color.r - target.r) * coverage;
  target.g += (color.g - target.g) * coverage;
  target.b += (color.b - target.b) * coverage;
}

void Canvas::set(int64_t x, int64_t y, const Color& color) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  pixels_[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)] = color;
}

void Canvas::fill(const Box& box, const Color& color) {
  const PixelRange columns = pixels_between(box.left, box.right, width_);
  const PixelRange rows = pixels_between(box.top, box.bottom, height_);
  for (int64_t y = rows.begin; y < rows.end; ++y)
    for (int64_t x = columns.begin; x < columns.end; ++x) set(x, y, color);
}

void Canvas::line(std::span<const Point> points, double thickness, const Color& color, const Box& clip) {
  // All segments into one mask: where two meet, a pixel must not be painted twice.
  std::vector<float> mask(pixels_.size());
  const double reach = thickness / 2 + 0.5;
  for (size_t k = 1; k < points.size(); ++k) {
    const Point &a = points[k - 1], &b = points[k];
    if (!finite(a) || !finite(b)) continue;
    const PixelRange columns = pixels_between(std::max(clip.left, std::min(a.x, b.x) - reach),
                                              std::min(clip.right, std::max(a.x, b.x) + reach), width_);
    const PixelRange rows = pixels_between(std::max(clip.top, std::min(a.y, b.y) - reach),
                                           std::min(clip.bottom, std::max(a.y, b.y) + reach), height_);
    for (int64_t y = rows.begin; y < rows.end; ++y)
      for (int64_t x = columns.begin; x < columns.end; ++x) {
        const Point centre{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
        const double coverage = std::clamp(reach - distance_to_segment(centre, a, b), 0.0, std::min(1.0, thickness));
        float& cell = mask[static_cast<size_t>(y) * width_ + static_cast<size_t>(x)];
        cell = std::max(cell, static_cast<float>(coverage));
      }
  }
  for (size_t pixel = 0; pixel < mask.size(); ++pixel)
    if (mask[pixel] > 0) blend(pixel, color, mask[pixel]);
}

void Canvas::circle(const Point& centre, double radius, double thickness, const Color& color) {
  std::vector<Point> points;
  for (int k = 0; k <= kCircleSegments; ++k) {
    const double angle = 6.283185307179586 * k / kCircleSegments;
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  line(points, thickness, color);
}

void Canvas::disc(const Point& centre, double radius, const Color& color) {
  const std::vector<Point> point(2, centre);
  line(point, 2 * radius, color);
}

void Canvas::text(const Point& position, std::string_view letters, const Color& color, Align align, uint32_t scale) {
  const double advance = (kGlyphWidth + 1) * scale;
  const double length = advance * static_cast<double>(letters.size()) - scale;
  const double shift = align == Align::left ? 0 : align == Align::centre ? length / 2 : length;
  double left = std::round(position.x - shift);
  const double top = std::round(position.y - 0.5 * kGlyphAscent * scale);
  for (const char letter : letters) {
    const auto& rows = glyph_rows(letter);
    for (uint32_t y = 0; y < kGlyphHeight; ++y)
      for (uint32_t x = 0; x < kGlyphWidth; ++x)
        if ((rows[y] >> (kGlyphWidth - 1 - x) & 1) != 0)
          fill({left + x * scale, top + y * scale, left + (x + 1) * scale, top + (y + 1) * scale}, color);
    left += advance;
  }
}

HostImage Canvas::image() const {
  HostImage image;
  image.desc = {Format::rgba8_unorm, Dimension::d2, {width_, height_, 1}};
  image.texels.reserve(pixels_.size() * 4);
  for (const Color& pixel : pixels_)
    for (const float value : {pixel.r, pixel.g, pixel.b, 1.0f}) image.texels.push_back(to_byte(value));
  return image;
}

}  // namespace lightloom::image
