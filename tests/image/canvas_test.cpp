#include "framework/image/canvas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "framework/image/font.hpp"

namespace lightloom::image {
namespace {

constexpr Color kWhite{1, 1, 1}, kBlack{0, 0, 0};

/// Sum of how dark the pixels are.
double ink(const Canvas& canvas) {
  const HostImage image = canvas.image();
  double sum = 0;
  for (uint32_t y = 0; y < canvas.height(); ++y)
    for (uint32_t x = 0; x < canvas.width(); ++x) sum += 1 - image.at(x, y, 0, 0);
  return sum;
}

TEST(Canvas, line_covers_length_times_thickness_in_every_direction) {
  for (int angle = 0; angle < 180; angle += 15) {
    Canvas canvas(200, 200, kWhite);
    const double dx = 80 * std::cos(angle * 0.017453292519943295), dy = 80 * std::sin(angle * 0.017453292519943295);
    const std::array points = {Point{100 - dx, 100 - dy}, Point{100, 100}, Point{100 + dx, 100 + dy}};
    canvas.line(points, 3, kBlack);
    EXPECT_NEAR(ink(canvas), 160 * 3 + 2.25 * 3.1416, 10) << angle;  // with a round cap at each end
  }
}

TEST(Canvas, lines_stay_inside_their_box_and_break_where_a_point_is_missing) {
  Canvas canvas(100, 100, kWhite);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::array points = {Point{10, 50}, Point{90, 50}, Point{nan, 0}, Point{50, 1e9}};
  canvas.line(points, 1, kBlack, {20, 0, 60, 100});
  const HostImage image = canvas.image();
  EXPECT_EQ(image.at(19, 50, 0, 0), 1);
  EXPECT_LT(image.at(20, 50, 0, 0), 1);
  EXPECT_LT(image.at(59, 49, 0, 0), 1);
  EXPECT_EQ(image.at(60, 50, 0, 0), 1);
  EXPECT_EQ(image.at(50, 80, 0, 0), 1);
}

TEST(Canvas, discs_and_circles_have_their_areas) {
  Canvas disc(100, 100, kWhite);
  disc.disc({50, 50}, 20, kBlack);
  EXPECT_NEAR(ink(disc), 3.14159 * 400, 5);
  Canvas circle(100, 100, kWhite);
  circle.circle({50, 50}, 30, 2, kBlack);
  EXPECT_NEAR(ink(circle), 2 * 3.14159 * 30 * 2, 5);
}

TEST(Canvas, text_stands_where_it_is_aligned) {
  for (const Align align : {Align::left, Align::centre, Align::right}) {
    Canvas canvas(100, 40, kWhite);
    canvas.text({50, 20}, "||", kBlack, align, 2);
    const HostImage image = canvas.image();
    uint32_t first = 100, last = 0;
    for (uint32_t x = 0; x < 100; ++x)
      if (image.at(x, 20, 0, 0) < 0.5) {
        first = std::min(first, x);
        last = x;
      }
    // Two glyphs of 5 dots with one between: 22 pixels; a bar is the third dot of its glyph.
    const uint32_t left = align == Align::left ? 50 : align == Align::centre ? 39 : 28;
    EXPECT_EQ(first, left + 4);
    EXPECT_EQ(last, left + 12 + 5);
  }
}

TEST(Canvas, nothing_outside_is_drawn) {
  Canvas canvas(10, 10, kWhite);
  canvas.set(-1, 0, kBlack);
  canvas.set(0, 10, kBlack);
  canvas.fill({-50, -50, 0, 0}, kBlack);
  canvas.text({200, 5}, "8", kBlack, Align::left);
  EXPECT_EQ(ink(canvas), 0);
  canvas.fill({-50, -50, 50, 50}, kBlack);
  EXPECT_EQ(ink(canvas), 100);
}

TEST(Font, letters_differ_from_each_other) {
  const std::string letters = "abcdefghijklmnopqrstuvwxyz0123456789.,:-+=/^()| ";
  for (const char one : letters)
    for (const char other : letters) EXPECT_EQ(glyph_rows(one) == glyph_rows(other), one == other) << one << other;
  EXPECT_EQ(glyph_rows('A'), glyph_rows('a'));
  EXPECT_NE(glyph_rows('?'), glyph_rows(' '));
}

}  // namespace
}  // namespace lightloom::image
