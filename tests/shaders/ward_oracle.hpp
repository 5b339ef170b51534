#pragma once

#include <cmath>

// Ward reflection in double precision and in the angles of the papers, with the tangents that shaders/lib/ward.glsl
// avoids: no formula is shared.
namespace lightloom::test {

struct Direction {
  double theta, phi;  // [radians]
  [[nodiscard]] double x() const { return std::sin(theta) * std::cos(phi); }
  [[nodiscard]] double y() const { return std::sin(theta) * std::sin(phi); }
  [[nodiscard]] double z() const { return std::cos(theta); }
};

inline double radians(double degrees) {
  return degrees * 3.141592653589793 / 180.0;
}

/// Walter 2005, equation 9: density of the reflected direction o given i.
inline double ward_pdf_oracle(const Direction& i, const Direction& o, double ax, double ay) {
  const double hx = i.x() + o.x(), hy = i.y() + o.y(), hz = i.z() + o.z();
  const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
  const double theta = std::acos(std::min(1.0, hz / length)), phi = std::atan2(hy, hx);
  const double tangent = std::tan(theta);
  const double along = std::cos(phi) / ax, across = std::sin(phi) / ay;
  const double h_dot_i = (hx * i.x() + hy * i.y() + hz * i.z()) / length;
  const double cosine = std::cos(theta);
  return std::exp(-tangent * tangent * (along * along + across * across)) /
         (4 * 3.141592653589793 * ax * ay * h_dot_i * cosine * cosine * cosine);
}

}  // namespace lightloom::test
