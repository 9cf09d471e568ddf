// Patterns are colours that vary over a surface or through space.
#pragma once

#include <crt/color.hpp>
#include <crt/image.hpp>
#include <crt/vec.hpp>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace crt {

struct NestedPattern;

/// A SharedPattern is a pattern within another: see nested().
using SharedPattern = std::shared_ptr<const NestedPattern>;

/// A ColorStop is the colour at a place of a smooth pattern: 0 is where color_a would be, 1 is
/// where color_b would be.
struct ColorStop {
  double position = 0;
  Color color = {1, 1, 1};

  friend bool operator==(const ColorStop&, const ColorStop&) = default;
};

// Patterns live in the space of the entity that wears them: they move, turn and scale with it.
// `scale` is the size of one period in scene units (> 0), and `offset` moves the pattern. Colours
// have the range of those of materials. Where there is a `pattern_a` or `pattern_b`, it takes the
// place of that colour. At most five patterns lie within one another. `colors` (2 to 64 stops at
// ascending positions in [0, 1]) take the place of both colours, and allow no nested patterns. Two
// at one position make an edge.

/// A Checker is a checkerboard of cubes whose edges are `scale` long.
struct Checker {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
};

/// Stripes are bands of equal width across `direction`. A period (`scale`) holds one of each
/// colour.
struct Stripes {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  Vec3 direction{1, 0, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
};

/// A Gradient changes smoothly from color_a to color_b and back along `direction` within `scale`.
struct Gradient {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  Vec3 direction{0, 1, 0};
  double scale = 1;
  Vec3 offset{0, 0, 0};
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
  std::vector<ColorStop> colors{};
};

/// Noise looks like clouds: it is gradient noise summed over `octaves` (1 to 16), each half as
/// large and half as strong.
struct Noise {
  Color color_a = {1, 1, 1};
  Color color_b = {0, 0, 0};
  int octaves = 4;
  double scale = 1;
  Vec3 offset{0, 0, 0};
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
  std::vector<ColorStop> colors{};
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
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
  std::vector<ColorStop> colors{};
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
  SharedPattern pattern_a{};
  SharedPattern pattern_b{};
  std::vector<ColorStop> colors{};
};

/// Lists how a picture is laid over a surface. All but uv work in space, around `offset`.
enum class ImageMapping {
  uv,           ///< by the surface's own (u, v)
  planar,       ///< along `direction`, as seen from where that comes from
  cylindrical,  ///< once around the axis `direction`, and up along it; around y its middle is at -z
  cubic,        ///< planar, along the axis of space that is nearest to the normal
};

/// An ImageMap is a picture laid over the surface by its (u, v) or another mapping, repeated
/// `repeat_u` by `repeat_v` times, with bilinear interpolation. u = 0 is its left edge, v = 0 its
/// lower one.
struct ImageMap {
  std::shared_ptr<const Image> image{};
  double repeat_u = 1;
  double repeat_v = 1;
  ImageMapping mapping = ImageMapping::uv;
  Vec3 direction{0, 0, 1};
  double scale = 1;  ///< the picture's width and height in scene units
  Vec3 offset{0, 0, 0};
};

/// A Pattern is any of the patterns.
using Pattern = std::variant<Checker, Stripes, Gradient, Noise, Marble, Wood, ImageMap>;

/// A NestedPattern holds the pattern that a SharedPattern points to.
struct NestedPattern {
  Pattern pattern;
};

/// Makes a pattern that can stand in others: Checker{.pattern_a = nested(Wood{})}.
inline SharedPattern nested(Pattern pattern) {
  return std::make_shared<const NestedPattern>(NestedPattern{std::move(pattern)});
}

}  // namespace crt
