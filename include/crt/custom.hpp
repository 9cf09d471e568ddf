// A program adds solids of its own to a scene by a CustomShape, which says what a line crosses:
//   class Egg : public crt::CustomShape { ... };
//   const crt::Entity egg = crt::Custom{.shape = std::make_shared<const Egg>()};
#pragma once

#include <crt/bounding_box.hpp>
#include <crt/ray.hpp>
#include <crt/vec.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace crt {

/// A CustomCrossing is where a ray crosses the surface of a custom shape.
struct CustomCrossing {
  double t = 0;            ///< along the ray that was given
  double error = 0;        ///< |t - true t| is at most this, for that ray
  std::uint32_t face = 0;  ///< the face that is crossed, below face_count()
};

/// A CustomPoint is what a custom shape knows of a point on its surface.
struct CustomPoint {
  Vec3 normal{0, 0, 1};  ///< out of the solid, of any length but 0
  double u = 0;
  double v = 0;
};

/// A CustomShape is a solid that is finite, in a space of its own. Entities of it may be placed,
/// combined and given materials as all others.
///
/// All functions are called from many threads at once, and the same question must always have the
/// same answer. What they throw comes out of the call that asked: of prepare(), a render or a
/// query. An answer that cannot be makes it fail with an Error (invalid_argument), which says what
/// was wrong and along which ray. Bounds and the number of faces are asked when an entity is made
/// and when a scene is prepared.
class CustomShape {
 public:
  /// A ray has at most so many crossings.
  static constexpr std::size_t most_crossings = 65536;

  CustomShape() = default;
  CustomShape(const CustomShape&) = delete;
  CustomShape& operator=(const CustomShape&) = delete;
  virtual ~CustomShape() = default;

  /// Returns what the solid lies within. Coordinates must be at most 1e100 in magnitude, and lower
  /// and upper ones differ by at least 1e-100. No ray that misses the box is ever asked about, so a
  /// tight one saves time.
  virtual BoundingBox bounds() const = 0;

  /// Appends what the ray crosses from ray.t_min to ray.t_max, which is where it is within the
  /// bounds: in ascending t, first where it enters the solid, then where it leaves it, and so on.
  /// So there is an even number, of at most most_crossings. The direction has unit length, t
  /// may be negative, and the origin is near the bounds. A ray that only touches the solid may have
  /// no crossings or two.
  ///
  /// The errors must be true, also where the ray grazes. What is within them of a surface that a
  /// ray starts on is taken for that surface. The library adds what its own rounding of the ray
  /// does: about 1e-15 of the largest coordinate, divided by the cosine of the ray to the normal.
  virtual void crossings(const Ray& ray, std::vector<CustomCrossing>& out) const = 0;

  /// Returns the normal and (u, v) where a ray crosses a face. The position is on the surface to
  /// the crossing's error.
  virtual CustomPoint point(const Vec3& position, std::uint32_t face) const = 0;

  /// Returns how many faces there are, from 1 to 65536. Hits say which was met.
  virtual std::uint32_t face_count() const { return 1; }

  /// Returns what messages call it.
  virtual std::string name() const { return "a custom shape"; }
};

}  // namespace crt
