// The axes of what is drawn in a plane.
#pragma once

#include "core/math/vector.hpp"

namespace crt::core {

/// DrawingAxes are of length 1, across a normal and across each other.
struct DrawingAxes {
  Vec3 x;
  Vec3 y;
};

/// Returns a direction of length 1. Coordinate axes come out exactly. Throws Error
/// (invalid_argument) for a normal that is not finite or has no length.
Vec3 unit_normal(const Vec3& normal);

/// Returns the axes of a drawing, in which y of the world, or z for a plane across it, is upwards.
/// The world is left-handed: who looks against the normal, which has the length 1, has x to the
/// right.
DrawingAxes axes_across(const Vec3& normal);

}  // namespace crt::core
