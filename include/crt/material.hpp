#pragma once

#include <crt/color.hpp>
#include <crt/pattern.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace crt {

/// What a surface is made of, and what light does with it. All factors are without unit.
struct Material {
  /// The colour of the surface: one everywhere, or a pattern. Channels at least 0 and at most 1e30;
  /// above 1 more light leaves than comes. Alpha in [0, 1].
  std::variant<Color, Pattern> color = grey(0.5);
  /// Share of light mirrored, in [0, 1].
  double reflectivity = 0;
  /// Share of light let through, in [0, 1]; what of it is mirrored instead follows Fresnel's
  /// equations.
  double transparency = 0;
  /// Of the inside, relative to vacuum, in [0.01, 100]; 1 lets light through straight.
  double refractive_index = 1;
  /// Strength of the diffuse light, >= 0. By default what is neither mirrored nor let through:
  /// max(0, 1 - reflectivity - transparency).
  std::optional<double> diffuse{};
  /// Strength of the highlight, >= 0.
  double specular = 0;
  /// Sharpness of the highlight: the exponent of its cosine, >= 0.
  double shininess = 3;
  /// Absorption inside the solid per scene unit and channel, >= 0 (Beer-Lambert).
  Color absorption = {0, 0, 0};
  /// Tilts the normal as if the surface were raised by the luminance of this pattern times
  /// `bump_height`.
  std::optional<Pattern> bump{};
  /// Height of the bumps in scene units.
  double bump_height = 0.1;
};

/// A material that many entities share: an immutable handle, cheap to copy. Any function that takes
/// one also takes a plain `Material`. The values are checked (crt::Error) on the way in.
class SharedMaterial {
 public:
  /// Throws Error (invalid_argument) naming the field that is out of range.
  SharedMaterial(Material material);  // NOLINT(google-explicit-constructor): meant to be implicit

  /// The values.
  const Material& operator*() const { return *material_; }
  /// One of the values.
  const Material* operator->() const { return material_.get(); }

 private:
  std::shared_ptr<const Material> material_;
};

}  // namespace crt
