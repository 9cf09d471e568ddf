// Patterns are colours that vary over a surface or through space.
#pragma once

#include <crt/color.hpp>
#include <crt/image.hpp>
#include <crt/vec.hpp>
#include <memory>
#include <variant>

namespace crt {

// Patterns live in the space of the entity that wears them: they move, turn and scale with it.
// `scale` is the size of one period in scene units (> 0), and `offset` moves the pattern. Colours
// have the range of those of materials.

/// A Checker is a checkerboard of cubes whose edges are `scale` long.
struct Checker {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// Stripes are bands of equal width across `direction`. A period (`scale`) holds one of each
/// colour.
struct Stripes {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  Vec3 direction{1, 0, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// A Gradient changes smoothly from color_a to color_b and back along `direction` within `scale`.
struct Gradient {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  Vec3 direction{0, 1, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// Noise looks like clouds: it is gradient noise summed over `octaves` (1 to 16), each half as
/// large and half as strong.
struct Noise {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  int octaves = 4;
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// Marble has veins: a wave along `direction` whose phase is shifted by noise of the strength
/// `turbulence`.
struct Marble {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  Vec3 direction{1, 0, 0};
  double turbulence = 1;
  int octaves = 4;
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// Wood has growth rings: a wave in the distance from the line through `offset` along `direction`.
struct Wood {
  Color color_a = {0.6, 0.4, 0.2};
  Color color_b = {0.3, 0.15, 0.05};
  Vec3 direction{0, 1, 0};
  double turbulence = 0.1;
  int octaves = 3;
  double scale = 1;
  Vec3 offset{0, 0, 0};
};

/// An ImageMap is a picture laid over the surface by its (u, v), repeated `repeat_u` by `repeat_v`
/// times, with bilinear interpolation. u = 0 is its left edge, v = 0 its lower one.
struct ImageMap {
  std::shared_ptr<const Image> image{};
  double repeat_u = 1;
  double repeat_v = 1;
};

/// A Pattern is any of the patterns.
using Pattern = std::variant<Checker, Stripes, Gradient, Noise, Marble, Wood, ImageMap>;

}  // namespace crt
