// What every primitive can be asked once a scene is prepared: the one interface between geometry
// and everything that follows rays.
//
// Notation: a ray is the *whole line* o + t d, with t in (-inf, inf) and d of any length but 0; t
// is never rescaled. "Object space" is the space of the primitive's own public parameters, before
// any transform of the entity. Faces of a primitive are numbered from 0 in the order its header
// tells.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/surface.hpp"
#include "core/geometry/typed_shape.hpp"
#include "core/ray/object_ray.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// A point where a ray passes through a face of a primitive.
struct Crossing {
  double t = 0;
  /// |t - true t| is at most this: the standard tier's bound of docs/numerics.md, in units of t.
  double error = 0;
  /// In the exact tier t + t_low is the crossing to about 100 bits, and `error` that of the sum.
  double t_low = 0;
  std::uint32_t face = 0;
  /// The how-manieth meeting of this ray with this face's surface (the whole plane, the whole
  /// quadric), in order of t from 0, counted over the whole line. Two primitives with an equal
  /// surface give its crossings equal numbers.
  std::uint8_t root = 0;
  /// Into the solid; for a mere surface: against its normal.
  bool entering = false;
};

/// Crossings along one ray. Reused from ray to ray so that no ray allocates.
using CrossingList = std::vector<Crossing>;

/// What is known of a point on a face, or of as many as a Real has lanes.
template <class Real>
struct SurfacePointOf {
  Vec3Of<Real> position{};  ///< in object space, on the surface to rounding
  Vec3Of<Real> normal{};    ///< unit length, in object space, out of the solid
  Real u{};
  Real v{};
};
using SurfacePoint = SurfacePointOf<double>;
using SurfacePointLanes = SurfacePointOf<Lanes>;

inline SurfacePoint lane_of(const SurfacePointLanes& points, std::size_t lane) {
  return {points.position.lane(lane), points.normal.lane(lane), points.u[lane], points.v[lane]};
}

/// A line through something long, and how far from the line that reaches at its ends; in between it
/// reaches as far as a straight line from one to the other.
struct CoreSegment {
  Vec3 from;
  Vec3 to;
  double from_reach = 0;
  double to_reach = 0;

  double most_reach() const { return std::max(from_reach, to_reach); }
};

class Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape() = default;

  /// False for mere surfaces, which have no inside.
  virtual bool is_solid() const = 0;

  /// Whether no line that has left it outwards meets it again; a flat surface is left to either
  /// side.
  virtual bool is_convex() const { return true; }

  /// A box in object space that holds the shape, rounded outwards; infinite where the shape is.
  virtual Bounds bounds() const = 0;

  /// Itself, if there are fast tests for its type. A shape without is asked for its crossings
  /// wherever a ray comes near.
  virtual TypedShape typed() const { return {}; }

  /// In object space; none of shapes that are about as long as wide.
  virtual std::optional<CoreSegment> core_segment() const { return std::nullopt; }

  /// Appends every crossing of the whole line in ascending t. For a solid they alternate between
  /// entering and leaving, and what is returned is whether the line is inside at t = -inf; a
  /// tangent (double) root is left out, so is a span of length zero. For a surface: false.
  ///
  /// If ray.start.face is not no_face the ray starts on the surface of that face: the root there is
  /// *exactly* t = 0, by removing it from the equation and not by comparing; ray.start.side says to
  /// which side of the surface (as the face's outward normal has it) the ray leaves, and the
  /// crossings agree with that. If it starts on the face itself (on_face), it also starts within
  /// what the other faces bound, whatever rounding says next to an edge: leaving a convex solid
  /// outwards it has no crossing at t > 0, inwards exactly one.
  virtual bool crossings(const ObjectRay& ray, CrossingList& out) const = 0;

  /// Position, normal and (u, v) where `ray` crosses. `crossing` came from crossings() of this ray.
  /// Without `with_uv`, u and v need not be set: they may cost more than the rest.
  SurfacePoint surface_point(const ObjectRay& ray, const Crossing& crossing,
                             bool with_uv = true) const {
    return point_on(ray.from_center(anchor(crossing.face), crossing.t), ray.direction,
                    crossing.face, with_uv);
  }

  /// The same by where rays of that direction cross a face, relative to the face's anchor:
  /// from_center(anchor, t) of an ObjectRay or of ObjectRayLanes. Of each lane it is that of one,
  /// to the last bit.
  virtual Vec3 anchor(std::uint32_t face) const = 0;
  virtual SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                                bool with_uv) const = 0;
  virtual void points_on(const VectorLanes& offsets, const VectorLanes& directions,
                         std::uint32_t face, bool with_uv, SurfacePointLanes& points) const = 0;

  /// How many faces there are, and the surface that a face is a piece of (for finding faces that
  /// coincide).
  virtual std::uint32_t face_count() const = 0;
  virtual Surface surface(std::uint32_t face) const = 0;

  /// Of memory.
  virtual std::size_t bytes() const = 0;
};

/// A shape with one formula for one point and for lanes:
/// void Derived::write_point<Real>(offset, direction, face, with_uv, point), to where it stays: a
/// copy of what has just been written waits until that has reached the cache.
template <class Derived>
class ShapeOfPoints : public Shape {
 public:
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const final {
    SurfacePoint point;
    derived().template write_point<double>(offset, direction, face, with_uv, point);
    return point;
  }
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t face,
                 bool with_uv, SurfacePointLanes& points) const final {
    derived().template write_point<Lanes>(offsets, directions, face, with_uv, points);
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

class ExactShape;

// Each primitive's header has these four for its own public struct; shape.cpp checks that none is
// missing.

/// Checks a primitive's parameters; throws Error (invalid_argument) naming the field.
void validate(const Primitive& primitive);

/// Whether a primitive is a solid, without making its shape.
bool is_solid(const Primitive& primitive);

/// Makes the shape of a (valid) primitive.
std::unique_ptr<const Shape> make_shape(const Primitive& primitive);

/// Makes what the exact tier asks (exact_shape.hpp) of a (valid) primitive.
std::unique_ptr<const ExactShape> make_exact_shape(const Primitive& primitive);

}  // namespace crt::core
