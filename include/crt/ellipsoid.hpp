#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <optional>

namespace crt {

/// An Ellipsoid is a solid with its axes along those of space: a sphere about `center` that is
/// scaled to `radii`, each from 1e-100 to 1e100. Transforms turn it. (u, v) are longitude about y
/// and latitude of that sphere, both in [0, 1]. It is an Entity wherever one is needed.
struct Ellipsoid {
  Vec3 center{0, 0, 0};
  Vec3 radii{1, 1, 1};
  std::optional<SharedMaterial> material{};

  /// Makes the entity. Throws Error (invalid_argument) naming the field that is out of range.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
