#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "framework/image/host_image.hpp"

namespace lightloom::image {

/// Display-ready (sRGB), 0..1.
struct Color {
  float r = 0, g = 0, b = 0;
};

/// Pixels from the upper left corner, y down; the first pixel's centre is (0.5, 0.5).
struct Point {
  double x = 0, y = 0;
};

struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;
};

enum class Align : uint8_t { left, centre, right };

/// A small rasteriser for plots: lines with smooth edges, filled boxes, and text in a bitmap font of 5 x 7 dots.
class Canvas {
 public:
  Canvas(uint32_t width, uint32_t height, const Color& background);

  [[nodiscard]] uint32_t width() const { return width_; }
  [[nodiscard]] uint32_t height() const { return height_; }
  [[nodiscard]] Box box() const { return {0, 0, double(width_), double(height_)}; }

  /// Outside the canvas nothing is drawn.
  void set(int64_t x, int64_t y, const Color& color);
  void fill(const Box& box, const Color& color);
  /// A line through all points; what lies outside `clip` is not drawn. Points that are not finite break it.
  void line(std::span<const Point> points, double thickness, const Color& color, const Box& clip);
  void line(std::span<const Point> points, double thickness, const Color& color) {
    line(points, thickness, color, box());
  }
  void circle(const Point& centre, double radius, double thickness, const Color& color);
  void disc(const Point& centre, double radius, const Color& color);
  /// `scale` pixels a dot of the font; `position` is the middle of the left edge, of the whole, or of the right edge.
  void text(const Point& position, std::string_view letters, const Color& color, Align align, uint32_t scale = 2);

  /// rgba8_unorm.
  [[nodiscard]] HostImage image() const;

 private:
  void blend(size_t pixel, const Color& color, float coverage);

  uint32_t width_;
  uint32_t height_;
  std::vector<Color> pixels_;
};

}  // namespace lightloom::image
