#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <optional>

namespace crt {

/// A Thread is the solid of a screw thread from one point to another, with the profile of ISO 68-1:
/// flanks at 60 degrees, crests that are an 8th of the pitch wide and roots that are a quarter. So
/// M8 has a diameter of 8 and a pitch of 1.25. Its ends are flat. What it cuts out of a solid is
/// the thread of a nut.
///
/// It is an implicit solid (see crt::Implicit), so rays and measures take longer than those of
/// other solids. It is an Entity wherever one is needed.
struct Thread {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 1};     ///< at least 1e-100 from `from`
  double diameter = 8;  ///< of the crests, from 1e-100 to 1e100
  /// Is how far a turn leads, from a 10000th of the length to 0.9 diameters.
  double pitch = 1.25;
  bool left = false;  ///< turns the other way: screwed in counterclockwise
  std::optional<SharedMaterial> material{};

  /// Makes the entity. Throws Error (invalid_argument) naming the field that is out of range.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
