// Angles of one direction or of lanes are computed here to nearly a double's precision, and
// quickly: without a table, a branch or a second double. They have the same bits on every machine.
// Where an angle must be as near as a double can be, crt/elementary.hpp has it.
#pragma once

#include <array>
#include <numbers>

#include "core/math/lanes.hpp"
#include "core/math/polynomial.hpp"

namespace crt::core {

namespace quick_angle_detail {

inline constexpr double tangent_of_sixteenth = 0x1.a827999fcef32p-2;  // tan(pi / 8)

// The real part of 2 atan(q e^(i v)) is atan(2 q cos(v) / (1 - q^2)), by the theorem of addition.
// So for q = tan(a / 2) and T, Chebyshev's polynomials,
//     atan(x tan a) = 2 (q T_1(x) - q^3 T_3(x) / 3 + q^5 T_5(x) / 5 - ...).
// These are the coefficients of t, t^3, ..., t^21 of the first 11 terms for t = x tan(pi / 8). What
// is left out is at most 7 10^-18 for |t| <= tan(pi / 8), and rounding them adds 2 10^-17.
inline constexpr std::array<double, 11> arctangent = {
    0x1.ffffffffffffdp-1, -0x1.55555555547cep-2, 0x1.9999999897068p-3, -0x1.249248dd22fa1p-3,
    0x1.c71c5bc962a34p-4, -0x1.745b03ad37ce6p-4, 0x1.3af340d54e4e3p-4, -0x1.0fc1824170213p-4,
    0x1.cfe1fab20fe94p-5, -0x1.5ebed0b995518p-5, 0x1.4e355e80a252dp-6};

}  // namespace quick_angle_detail

/// Returns the angle of (x, y) from the x axis, from -pi to pi. The error is at most 2^-50. The
/// numbers are finite, and their sums, too. The angle of (0, 0) is 0, and a y of -0 counts as 0.
template <class Real>
Real quick_atan2(const Real& y, const Real& x) {
  using namespace quick_angle_detail;
  constexpr double right = std::numbers::pi / 2;
  const Real width = abs(x);
  const Real height = abs(y);
  const Real longer = max(width, height);
  const Real shorter = min(width, height);
  // The tangent of the angle less an eighth of a turn is (t - 1) / (t + 1).
  const auto is_diagonal = shorter > tangent_of_sixteenth * longer;
  const Real above = select(is_diagonal, Real(shorter - longer), shorter);
  const Real below = select(is_diagonal, Real(shorter + longer), longer);
  const Real tangent = above / select(below == 0.0, broadcast<Real>(1), below);
  const Real rest = tangent * polynomial(arctangent, Real(tangent * tangent));
  const Real to_axis = select(is_diagonal, Real(rest + right / 2), rest);
  const Real steep = select(height > width, Real(right - to_axis), to_axis);
  const Real upper = select(x < 0.0, Real(2 * right - steep), steep);
  return select(y < 0.0, Real(-upper), upper);
}

}  // namespace crt::core
