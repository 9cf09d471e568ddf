// Sines of angles in lanes are computed here to nearly a double's precision, and quickly. They have
// the same bits on every machine.
#pragma once

#include <numbers>

#include "core/geometry/angles.hpp"

namespace crt::core {

/// Returns sine and cosine of angles from 0 to some turns. The error is some 2^-51.
inline SineAndCosine<Lanes> quick_sine_and_cosine(const Lanes& angle) {
  constexpr double quarter = std::numbers::pi / 2;
  const Lanes quarters = floor(angle * (1 / quarter) + 0.5);
  const auto [sine, cosine] = of_eighth_turns<Lanes>((2 / quarter) * (angle - quarters * quarter));
  const Lanes half = floor(0.5 * quarters);
  const LaneMask is_odd = quarters - 2.0 * half > 0.5;
  const LaneMask is_turned = half - 2.0 * floor(0.5 * half) > 0.5;
  const Lanes sign = select(is_turned, lanes_of(-1), lanes_of(1));
  return {.sine = sign * select(is_odd, cosine, sine),
          .cosine = sign * select(is_odd, -sine, cosine)};
}

}  // namespace crt::core
