#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <optional>

namespace crt {

/// A Helix is a round wire that winds about a line from one point to another, where its ends are
/// cut flat: a spring with ground ends. Its turns begin along z as far as that is across the line,
/// or along x if the line is mostly along z.
///
/// It is all points for which s^2 + (h cos a)^2 <= thickness^2, where s is the distance from the
/// cylinder of the radius, h that from the helix along the line, and a the angle at which the helix
/// rises. h is computed to a 10^6th. Across the wire that is a circle to about thickness / radius
/// times tan(a)^2.
///
/// It is an implicit solid (see crt::Implicit), so rays and measures take longer than those of
/// other solids. It is an Entity wherever one is needed.
struct Helix {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 1};        ///< at least 1e-100 from `from`
  double radius = 1;       ///< from the line to the middle of the wire, from 1e-100 to 1e100
  double thickness = 0.1;  ///< the wire's radius: at most 0.9 of `radius`
  /// Is how far a turn leads: from a 10000th of the length on, and so far that turns have a tenth
  /// of it between them.
  double pitch = 1;
  bool left = false;  ///< winds the other way than a common screw
  std::optional<SharedMaterial> material{};

  /// Makes the entity. Throws Error (invalid_argument) naming the field that is out of range.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
