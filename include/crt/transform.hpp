#pragma once

#include <crt/vec.hpp>

namespace crt {

/// A Transform is an affine map p -> linear * p + translation. Nested transforms of an entity are
/// not multiplied here but once, with more than double precision, when the scene is prepared.
struct Transform {
  /// These are the rows of the linear part.
  Vec3 row_x{1, 0, 0};
  Vec3 row_y{0, 1, 0};
  Vec3 row_z{0, 0, 1};
  Vec3 translation{0, 0, 0};

  friend bool operator==(const Transform&, const Transform&) = default;
};

/// Moves by `offset` (scene units).
Transform translate(const Vec3& offset);

/// Scales about the origin by the same factor in all directions. A negative one mirrors, and 0 is
/// an error.
Transform scale(double factor);

/// Scales about the origin by a factor an axis. A negative one mirrors, and 0 is an error.
Transform scale(const Vec3& factors);

/// Rotates about x, then y, then z by the given *degrees*, left-handed: +90 about z takes x to y,
/// about x takes y to z, about y takes z to x. Multiples of 90 degrees are exact.
Transform rotate_degrees(const Vec3& degrees);

/// Rotates about a line through the origin along `axis` (not 0, of any length) by so many degrees,
/// in the same sense: about (0, 0, 1) as rotate_degrees({0, 0, degrees}) does.
Transform rotate_degrees(const Vec3& axis, double degrees);

/// Mirrors in the plane through the origin that is normal to `normal` (not 0, of any length).
Transform mirror(const Vec3& normal);

/// Is the name that rotate_degrees() has in version 1.0.
[[deprecated("it takes degrees: call rotate_degrees()")]] inline Transform rotate(
    const Vec3& degrees) {
  return rotate_degrees(degrees);
}

}  // namespace crt
