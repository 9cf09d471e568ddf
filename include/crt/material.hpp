#pragma once

#include <concepts>
#include <crt/color.hpp>
#include <crt/pattern.hpp>
#include <crt/principled.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

namespace crt {

/// A Material says what a surface is made of, and what light does with it. All factors are without
/// unit.
struct Material {
  /// The colour of the surface is one everywhere, or a pattern. Channels are at least 0 and at most
  /// 1e30. Above 1 more light leaves than comes. Alpha is in [0, 1].
  std::variant<Color, Pattern> color = grey(0.5);
  /// This is the share of light mirrored, in [0, 1].
  double reflectivity = 0;
  /// This is the share of light let through, in [0, 1]. Fresnel's equations say what part of it is
  /// mirrored instead. What passes a surface is multiplied by the colour there: clear glass is
  /// white.
  double transparency = 0;
  /// This is the refractive index of the inside, relative to vacuum, in [0.01, 100]. 1 lets light
  /// through straight.
  double refractive_index = 1;
  /// This is the strength of the diffuse light, >= 0. By default it is what is neither mirrored nor
  /// let through: max(0, 1 - reflectivity - transparency).
  std::optional<double> diffuse{};
  /// This is the strength of the highlight, >= 0.
  double specular = 0;
  /// This is the sharpness of the highlight: the exponent of its cosine, >= 0.
  double shininess = 3;
  /// This is the absorption inside the solid per scene unit and channel, >= 0 (Beer-Lambert).
  Color absorption = {0, 0, 0};
  /// Tilts the normal as if the surface were raised by the luminance of this pattern times
  /// `bump_height`.
  std::optional<Pattern> bump{};
  /// This is the height of the bumps in scene units.
  double bump_height = 0.1;
  /// This is the radiance that the surface gives off, >= 0. It is a light for others, too.
  Color emission = {0, 0, 0};
  /// This is the density of what it is, in kg per cubic metre, for masses: see density(). Pictures
  /// do not need it. 0 says nothing of it.
  double density = 0;
};

/// A SharedMaterial is a material that many entities share: an immutable handle, cheap to copy. Any
/// function that takes one also takes a plain `Material` or `PrincipledMaterial`. The constructor
/// checks the values.
class SharedMaterial {
 public:
  /// Takes the values. Throws Error (invalid_argument) naming the field that is out of range.
  SharedMaterial(Material material);  // NOLINT(google-explicit-constructor): meant to be implicit
  /// Takes the values of a principled material. Throws Error (invalid_argument) naming the field
  /// that is out of range.
  template <std::same_as<PrincipledMaterial> Principled>
  SharedMaterial(Principled material)  // NOLINT(google-explicit-constructor): meant to be implicit
      : SharedMaterial(std::make_shared<const PrincipledMaterial>(std::move(material))) {}

  /// Returns the values, or those of a material that is roughly like the principled one.
  const Material& operator*() const { return *material_; }
  /// Gives access to one of the values.
  const Material* operator->() const { return material_.get(); }
  /// Returns the values of a principled material, or null if it is none.
  const PrincipledMaterial* principled() const { return principled_.get(); }

 private:
  explicit SharedMaterial(std::shared_ptr<const PrincipledMaterial> principled);

  std::shared_ptr<const Material> material_;
  std::shared_ptr<const PrincipledMaterial> principled_;
};

}  // namespace crt
