#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <memory>
#include <optional>

namespace crt {

/// A ShapedExtrusion is a profile that is drawn out along z, from 0 to a height, and on its way is
/// turned about the z axis, becomes larger or smaller, and has its edges at both ends cut off.
///
/// It is an implicit solid (see crt::Implicit) with the profile's distance as its field, so rays
/// and measures take longer than those of an Extrusion, which it is if nothing shapes it. It is an
/// Entity wherever one is needed.
struct ShapedExtrusion {
  /// From make_profile(). Its contours neither cross nor touch one another, and have at most 4096
  /// pieces. Must be given.
  std::shared_ptr<const Profile> profile{};
  double height = 1;  ///< from 1e-100 to 1e100
  /// Is by how much the upper end is turned, in radians from x towards y: at most 1000 turns.
  double twist = 0;
  /// Is how many times as large as the lower end the upper one is, about the z axis: from 0.001 to
  /// 1000.
  double taper = 1;
  /// Is how far the edges at both ends are cut off, at 45 degrees: at most half of the height. What
  /// is narrower than twice as much becomes a roof.
  double bevel = 0;
  double rounding = 0;  ///< the radius of edges that are rounded instead, likewise
  std::optional<SharedMaterial> material{};

  /// Makes the entity. Throws Error (invalid_argument) naming the field that is out of range.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
