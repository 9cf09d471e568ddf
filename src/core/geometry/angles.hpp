// Angles about an axis serve as texture coordinates. They are computed for one double or for lanes.
#pragma once

#include <array>
#include <numbers>

#include "core/math/lanes.hpp"
#include "core/math/plane_point.hpp"
#include "core/math/polynomial.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// Returns the angle of (x, y) from x towards y as a share of a whole turn, for x, y >= 0. It is in
/// [0, 1/4], and 0 for (0, 0). The error is within 2^-53 of a turn and 2^-51 of the angle, where
/// neither coordinate is below 1e-290.
///
/// Beyond 1/16 the angle is computed from 1/8: atan a = pi/4 + atan((a - 1) / (a + 1)). The
/// polynomial is the best one of its degree in q^2 for atan(q) / (2 pi q) up to q = tan(pi / 8), to
/// 2^-59 (Remez' algorithm).
template <class Real>
Real quarter_turn(const Real& x, const Real& y) {
  constexpr double tangent_of_sixteenth = std::numbers::sqrt2 - 1;
  const Real longer = max(x, y);
  const Real shorter = min(x, y);
  const auto beyond = shorter > tangent_of_sixteenth * longer;
  const Real across = select(beyond, shorter - longer, shorter);
  const Real along = select(beyond, shorter + longer, longer);
  const Real q = across / select(along > Real{}, along, broadcast<Real>(1));

  constexpr std::array<double, 12> coefficients = {
      0x1.45f306dc9c883p-3, -0x1.b2995e7b7b5d5p-5, 0x1.04c26be3ad380p-5, -0x1.7483758ba87cep-6,
      0x1.21bb93b5826efp-6, -0x1.da1b83a1805dap-7, 0x1.9127a793e9965p-7, -0x1.5b7cd067a60f4p-7,
      0x1.30f097ca5ef75p-7, -0x1.06a6a9f79c2a9p-7, 0x1.8c4a5c9966effp-8, -0x1.7410d2c7ce990p-9};
  constexpr double eighth = 0.125;
  const Real turned =
      q * polynomial(coefficients, Real(q * q)) + select(beyond, broadcast<Real>(eighth), Real{});
  return select(y > x, 2 * eighth - turned, turned);
}

/// Returns the angle of any (x, y) as a share of a whole turn, in [0, 1).
template <class Real>
Real turn(const Real& x, const Real& y) {
  const Real quarter = quarter_turn(abs(x), abs(y));
  const Real half = select(x < Real{}, 0.5 - quarter, quarter);
  const Real whole = select(y < Real{}, 1.0 - half, half);
  return select(whole < broadcast<Real>(1), whole, Real{});
}

/// Returns the latitude of (level, height), with level >= 0. It goes from 0, straight down, to 1,
/// straight up.
template <class Real>
Real latitude(const Real& level, const Real& height) {
  const Real half = 2.0 * quarter_turn(level, abs(height));
  return select(height < Real{}, 0.5 - half, 0.5 + half);
}

template <class Real>
struct SineAndCosine {
  Real sine;
  Real cosine;
};

/// Returns sine and cosine of q eighths of a turn, -1 <= q <= 1, within 2^-52 each, by their power
/// series.
template <class Real>
SineAndCosine<Real> of_eighth_turns(const Real& q) {
  constexpr std::array<double, 8> odd = {
      0x1.921fb54442d18p-1,  -0x1.4abbce625be53p-4,  0x1.466bc6775aae2p-9,  -0x1.32d2cce62bd86p-15,
      0x1.50783487ee782p-22, -0x1.e3074fde8871fp-30, 0x1.e8f434d018d63p-38, -0x1.6fadb9f155744p-46};
  constexpr std::array<double, 8> even = {
      -0x1.3bd3cc9be45dep-2,  0x1.03c1f081b5ac4p-6,  -0x1.55d3c7e3cbffap-12, 0x1.e1f506891babbp-19,
      -0x1.a6d1f2a204a8cp-26, 0x1.f9d38a3763cc3p-34, -0x1.b6e24f44b128fp-42, 0x1.20c62c2f2d7f5p-50};
  const Real square = q * q;
  Real sine = broadcast<Real>(odd.back());
  Real cosine = broadcast<Real>(even.back());
  for (std::size_t i = odd.size() - 1; i > 0; --i) {
    sine = fma(sine, square, broadcast<Real>(odd[i - 1]));
    cosine = fma(cosine, square, broadcast<Real>(even[i - 1]));
  }
  return {.sine = q * sine, .cosine = fma(cosine, square, broadcast<Real>(1))};
}

/// Returns a point of the unit disc for one of the square, u and v in [0, 1], by the concentric map
/// of Shirley and Chiu, A low distortion map between disk and square, Journal of Graphics Tools
/// 2(3), 1997. Equal areas stay equal, and neighbours stay neighbours.
template <class Real>
PlanePointOf<Real> point_of_disc(const Real& u, const Real& v) {
  const Real x = 2.0 * u - 1.0;
  const Real y = 2.0 * v - 1.0;
  const auto beside = abs(x) > abs(y);
  const Real radius = select(beside, x, y);
  const Real across = select(beside, y, x);
  const auto [sine, cosine] =
      of_eighth_turns(Real(across / select(radius == 0.0, broadcast<Real>(1), radius)));
  return {radius * select(beside, cosine, sine), radius * select(beside, sine, cosine)};
}

/// An AxisFrame has unit vectors that make a frame with `along`, a unit vector. Angles about the
/// axis start at `zero`, which is +z as far as that is across the axis, or +x if the axis is mostly
/// along z. `quarter` is along x zero, a quarter of a turn further. The frame is exact for
/// coordinate axes.
struct AxisFrame {
  Vec3 zero;
  Vec3 quarter;
  Vec3 along;
};
AxisFrame frame_about(const Vec3& axis);

}  // namespace crt::core
