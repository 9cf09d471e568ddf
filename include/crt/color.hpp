#pragma once

namespace crt {

/// A Color is linear RGB with an alpha. Channels are not limited to [0, 1] unless the documentation
/// of what takes the colour says so. A light may be brighter than 1.
struct Color {
  double r = 0;
  double g = 0;
  double b = 0;
  /// Coverage is in [0, 1]. In a material 1 - a adds to the transparency. In a background it is the
  /// alpha of the pixels where nothing is hit. Elsewhere it means nothing.
  double a = 1;

  friend bool operator==(const Color&, const Color&) = default;
};

/// Returns the grey of the given level: 0 is black, 1 is white.
constexpr Color grey(double level) {
  return {level, level, level};
}

}  // namespace crt
