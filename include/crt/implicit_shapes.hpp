// These functions make implicit solids (crt/primitives.hpp) of well-known fields.
#pragma once

#include <crt/primitives.hpp>
#include <crt/vec.hpp>
#include <cstddef>
#include <span>

namespace crt {

/// A BlobPart is a ball about `from`, or what is around the line from there to another point. With
/// the share s of the radius that a point is away from it, it adds strength (1 - s^2)^2 where s <
/// 1, and nothing elsewhere. A negative strength takes away.
struct BlobPart {
  Vec3 from{0, 0, 0};
  Vec3 to{0, 0, 0};  ///< equal to `from` for a ball, else at least 1e-100 from it
  double radius = 1;
  double strength = 1;
};

/// More parts than this are not possible. Fewer lines are, as each has more operations.
inline constexpr std::size_t most_blob_parts = 1024;

/// Makes a blob: all points at which parts add up to a threshold or more, which is above 0. So a
/// part of strength 1 alone is a ball smaller than its radius, and two that come near each other
/// flow together. There may be some 300 balls or 150 lines. Throws Error (invalid_argument) naming
/// the part (they count from 0).
Implicit blob(std::span<const BlobPart> parts, double threshold);

/// Makes a superellipsoid: all points at which (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) <= 1. `e`
/// is `east_west`, the shape across z, and `n` is `north_south`, the shape along it, both between
/// 0.01 and 10. It is a sphere for 1 and 1, nearly a cube for small numbers, an octahedron for 2
/// and 2, and pinched beyond. It reaches from -1 to 1 along all axes.
Implicit superellipsoid(double east_west, double north_south);

}  // namespace crt
