#pragma once

namespace crt {

/// A linear RGB colour with an alpha. Channels are not limited to [0, 1] unless whoever takes the
/// colour says so: a light may be brighter than 1.
struct Color {
  double r = 0;
  double g = 0;
  double b = 0;
  /// Coverage in [0, 1]. In a material 1 - a adds to the transparency; in a background it is the
  /// alpha of the pixels where nothing is hit; elsewhere it means nothing.
  double a = 1;

  friend bool operator==(const Color&, const Color&) = default;
};

/// The grey of the given level: 0 black, 1 white.
constexpr Color grey(double level) {
  return {level, level, level};
}

}  // namespace crt
