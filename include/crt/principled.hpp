#pragma once

#include <crt/color.hpp>
#include <crt/pattern.hpp>
#include <optional>
#include <utility>
#include <variant>

namespace crt {

/// A Share is a number from 0 to 1, or a pattern whose luminance is that number.
struct Share : std::variant<double, Pattern> {
  /// Takes the number.
  Share(double number = 0)  // NOLINT(google-explicit-constructor): meant to be implicit
      : variant(number) {}
  /// Takes the pattern.
  Share(Pattern pattern)  // NOLINT(google-explicit-constructor): meant to be implicit
      : variant(std::move(pattern)) {}
};

/// A PrincipledMaterial says what a surface is made of in the words of glTF, OpenPBR and Blender: a
/// mixture of a metal and a dielectric, whose energy is kept. A white one sends back all light.
/// Numbers are without unit where nothing else is said.
struct PrincipledMaterial {
  /// The base colour is one everywhere, or a pattern. It is what a dielectric scatters, what a
  /// metal mirrors straight on, and what is left of light that a surface lets through. Channels are
  /// at least 0; above 1 more light leaves than comes. Alpha is in [0, 1].
  std::variant<Color, Pattern> color = grey(0.8);
  /// This is the share of the surface that is a metal, in [0, 1].
  Share metallic = 0;
  /// This is how rough the surface is, in [0, 1]. 0 is a perfect mirror or clear glass. Its square
  /// is the width of the GGX distribution.
  Share roughness = 0.5;
  /// This is the refractive index of the inside, relative to vacuum, in [0.01, 100]. It says how
  /// much a dielectric mirrors, and how light bends.
  double refractive_index = 1.5;
  /// This is the share of the dielectric that lets light through, in [0, 1], as rough as it is.
  double transmission = 0;
  /// This is the absorption inside the solid per scene unit and channel, >= 0 (Beer-Lambert).
  Color absorption = {0, 0, 0};
  /// This is the strength of a clear varnish on top, of refractive index 1.5, in [0, 1].
  double coat = 0;
  /// This is the roughness of the varnish, in [0, 1].
  double coat_roughness = 0;
  /// This is the strength of the sheen of cloth's fibres, in [0, 1].
  double sheen = 0;
  /// This is the radiance that the surface gives off, as a colour or a pattern, >= 0.
  std::variant<Color, Pattern> emission = grey(0);
  /// Tilts the normal by its colours: red is along u, green along v and blue out of the surface,
  /// each from -1 at 0 to 1 at 1. Pictures count as they are, without the gamma of displays.
  std::optional<Pattern> normal_map{};
  /// Tilts the normal as if the surface were raised by the luminance of this pattern times
  /// `bump_height`.
  std::optional<Pattern> bump{};
  /// This is the height of the bumps in scene units.
  double bump_height = 0.1;
  /// This is the density of what it is, in kg per cubic metre, for masses: see density(). 0 says
  /// nothing of it.
  double density = 0;
};

}  // namespace crt
