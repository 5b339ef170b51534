#pragma once

#include <algorithm>
#include <cmath>

// Ward reflection in double precision and in the angles of the papers, with the tangents that shaders/lib/ward.glsl
// avoids: no formula is shared.
namespace lightloom::test {

constexpr double kPi = 3.141592653589793;

struct Direction {
  double theta, phi;  // [radians]
  [[nodiscard]] double x() const { return std::sin(theta) * std::cos(phi); }
  [[nodiscard]] double y() const { return std::sin(theta) * std::sin(phi); }
  [[nodiscard]] double z() const { return std::cos(theta); }
};

inline double radians(double degrees) {
  return degrees * kPi / 180.0;
}

/// The half vector of two directions in angles, and what the densities need of it.
struct HalfAngles {
  double tangent, cosine;  ///< of its angle from the normal
  double phi;
  double h_dot_i;
};

inline HalfAngles half_angles(const Direction& i, const Direction& o) {
  const double hx = i.x() + o.x(), hy = i.y() + o.y(), hz = i.z() + o.z();
  const double length = std::sqrt(hx * hx + hy * hy + hz * hz);
  const double theta = std::acos(std::min(1.0, hz / length));
  return {std::tan(theta), std::cos(theta), std::atan2(hy, hx), (hx * i.x() + hy * i.y() + hz * i.z()) / length};
}

/// Rate of the exponential distribution of the squared tangent at an azimuth: cos^2 / ax^2 + sin^2 / ay^2.
inline double ward_rate(double phi, double ax, double ay) {
  const double along = std::cos(phi) / ax, across = std::sin(phi) / ay;
  return along * along + across * across;
}

/// Walter 2005, equation 9: density of the reflected direction o given i.
inline double ward_pdf_oracle(const Direction& i, const Direction& o, double ax, double ay) {
  const HalfAngles h = half_angles(i, o);
  return std::exp(-h.tangent * h.tangent * ward_rate(h.phi, ax, ay)) /
         (4 * kPi * ax * ay * h.h_dot_i * h.cosine * h.cosine * h.cosine);
}

/// Density where the azimuth of the half vector is uniform and its squared tangent exponential with `ward_rate`. With
/// t = tan: p(theta | phi) = 2 t (1 + t^2) rate exp(-rate t^2); per solid angle / (2 pi sin theta); and 4 (h . i) solid
/// angles of o go into one of h.
inline double ward_phi_uniform_pdf_oracle(const Direction& i, const Direction& o, double ax, double ay) {
  const HalfAngles h = half_angles(i, o);
  const double rate = ward_rate(h.phi, ax, ay);
  const double polar = 2 * (1 + h.tangent * h.tangent) * rate * std::exp(-rate * h.tangent * h.tangent) / h.cosine;
  return polar / (2 * kPi) / (4 * h.h_dot_i);
}

}  // namespace lightloom::test
