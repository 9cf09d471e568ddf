// A Shape is what every primitive can be asked once a scene is prepared. It is the one interface
// between geometry and everything that follows rays.
//
// Notation: a ray is the *whole line* o + t d, with t in (-inf, inf) and d of any length but 0. t
// is never rescaled. "Object space" is the space of the primitive's own public parameters, before
// any transform of the entity. Faces of a primitive are numbered from 0 in the order that its
// header gives.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/geometry/face_functions.hpp"
#include "core/geometry/placed_solid.hpp"
#include "core/geometry/shape_span.hpp"
#include "core/geometry/surface.hpp"
#include "core/geometry/surface_piece.hpp"
#include "core/ray/object_ray.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// A Crossing is a point where a ray passes through a face of a primitive.
struct Crossing {
  double t = 0;
  /// |t - true t| is at most this: the standard tier's bound of docs/numerics.md, in units of t.
  double error = 0;
  /// In the exact tier t + t_low is the crossing to about 100 bits, and `error` bounds the error of
  /// that sum.
  double t_low = 0;
  std::uint32_t face = 0;
  /// The root number counts the meetings of this ray with this face's surface (the whole plane, the
  /// whole quadric). It counts from 0 in order of t over the whole line. Two primitives with an
  /// equal surface give its crossings equal numbers.
  std::uint8_t root = 0;
  /// The ray enters the solid; a surface without an inside is met against its normal.
  bool entering = false;
  /// Crossings after this one were left out, as ObjectRay::first_wanted_after allows. It is the
  /// last that is there, and no other can be in its place. Only meshes and height fields say so.
  bool has_rest = false;
};

/// A CrossingList has crossings along one ray. It is reused from ray to ray so that no ray
/// allocates.
struct CrossingList : std::vector<Crossing> {
  /// Counts how often what a ray crosses of an Implicit could not be decided, since it was made.
  std::uint64_t undecided = 0;
  /// This is what a Custom has said, reused like the list itself.
  std::vector<CustomCrossing> of_custom;
};

/// A SurfacePointOf is what is known of a point on a face, or of as many as a Real has lanes.
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

/// A CoreSegment is a line through something long, with the largest distance from it at both ends.
/// In between that distance is interpolated linearly.
struct CoreSegment {
  Vec3 from;
  Vec3 to;
  double from_reach = 0;
  double to_reach = 0;

  double max_reach() const { return std::max(from_reach, to_reach); }
};

/// A BoundingSphere is a sphere around something that fills most of it.
struct BoundingSphere {
  Vec3 center;
  double radius = 0;
};

class FacetAttributes;

/// A ShadingNormal is a normal for shading, which has unit length.
struct ShadingNormal {
  Vec3 direction;
  /// Where the cosine of the angle to light is no more than this, a facet near to the point may be
  /// turned away from the light.
  double horizon = 0;
};

class Shape {
 public:
  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape() = default;

  /// Returns false for surfaces without an inside.
  virtual bool is_solid() const = 0;

  /// Returns whether no line that has left the shape outwards meets it again. A flat surface is
  /// left to either side.
  virtual bool is_convex() const { return true; }

  /// Returns a box in object space that holds the shape, rounded outwards. It is infinite where the
  /// shape is.
  virtual Bounds bounds() const = 0;

  /// Returns what encloses the shape along lines where a placement puts it, or null if it has no
  /// formula for that.
  virtual std::unique_ptr<const PlacedSolid> placed(const Placement& /*placement*/) const {
    return nullptr;
  }

  /// Returns a core segment in object space, or nothing for shapes that are about as long as wide.
  virtual std::optional<CoreSegment> core_segment() const { return std::nullopt; }

  /// Returns a bounding sphere in object space, or nothing for shapes that their box fits better.
  virtual std::optional<BoundingSphere> bounding_sphere() const { return std::nullopt; }

  /// Appends every crossing of the whole line in ascending t. The crossings of a solid alternate
  /// between entering and leaving. Returns whether the line is inside at t = -inf. A tangent
  /// (double) root is left out, and so is a span of length zero. For a surface without an inside it
  /// returns false.
  ///
  /// If ray.start.face is not invalid_index, the ray starts on the surface of that face. The root
  /// there is *exactly* t = 0, by removing it from the equation and not by comparing.
  /// ray.start.side says to which side of the surface (as the face's outward normal has it) the ray
  /// leaves, and the crossings agree with that. If it starts on the face itself (on_face), it also
  /// starts within what the other faces bound, whatever rounding says next to an edge. Then it has
  /// no crossing at t > 0 if it leaves a convex solid outwards, and exactly one if inwards. Only a
  /// mesh may leave out that start, for a ray that leaves from an edge past all triangles.
  virtual bool crossings(const ObjectRay& ray, CrossingList& out) const = 0;

  /// Returns whether span() ever finds anything where a placement puts the shape.
  virtual bool finds_spans(const Placement& /*placement*/) const { return false; }
  /// Returns whether span() of lines that no transform moves takes about as long as to enclose
  /// their part in the shape, so that nothing is gained by that before.
  virtual bool has_quick_spans() const { return false; }
  /// Finds what crossings() finds of each of some lines, to the last bit, where that is plain. The
  /// lines start on no face's surface, or as `starts` says for a shape whose faces are all flat.
  /// The first two are for lines that no transform moves.
  virtual void span(const FilterLine<double>& /*line*/, const WantedEnds<double>& /*wanted*/,
                    const FaceStarts<double>* /*starts*/, ShapeSpan<double>& /*span*/) const {}
  virtual void span(const FilterLine<Lanes>& /*lines*/, const WantedEnds<Lanes>& /*wanted*/,
                    const FaceStarts<Lanes>* /*starts*/, ShapeSpan<Lanes>& /*span*/) const {}
  virtual void span(const ObjectRay& /*ray*/, const WantedEnds<double>& /*wanted*/,
                    ShapeSpan<double>& /*span*/) const {}
  virtual void span(const ObjectRayLanes& /*rays*/, const WantedEnds<Lanes>& /*wanted*/,
                    ShapeSpan<Lanes>& /*span*/) const {}

  /// Finds where lines leave that start on the surface and go in, as crossings() does, where it can
  /// do so side by side. No transform moves them.
  virtual void exit_from_surface(const PlainRay<double>& /*line*/, SpanEnd<double>& /*end*/) const {
  }
  virtual void exit_from_surface(const RayLanes& /*lines*/, SpanEnd<Lanes>& /*end*/) const {}

  /// Returns which of the wanted rays have no crossing at t > 0. They start on the surface and go
  /// out. What is said of others means nothing.
  virtual bool leaves_for_good(const ObjectRay& /*ray*/, bool /*wanted*/) const { return false; }
  virtual LaneMask leaves_for_good(const ObjectRayLanes& /*rays*/,
                                   const LaneMask& /*wanted*/) const {
    return LaneMask{};
  }

  /// Returns position, normal and (u, v) where `ray` crosses. `crossing` came from crossings() of
  /// this ray. Without `with_uv`, u and v need not be set, as they may cost more than the rest.
  SurfacePoint surface_point(const ObjectRay& ray, const Crossing& crossing,
                             bool with_uv = true) const {
    return point_on(ray.from_center(anchor(crossing.face), crossing.t), ray.direction,
                    crossing.face, with_uv);
  }

  /// These compute the surface point from where rays cross a face, relative to the face's anchor:
  /// from_center(anchor, t) of an ObjectRay or of ObjectRayLanes. Each lane gets what one ray
  /// would, to the last bit. Only the lanes that have their bit in `some` are wanted. What is in
  /// the others, before and after, means nothing.
  virtual Vec3 anchor(std::uint32_t face) const = 0;
  virtual SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                                bool with_uv) const = 0;
  virtual void points_on(const VectorLanes& offsets, const VectorLanes& directions,
                         std::uint32_t some, std::uint32_t face, bool with_uv,
                         SurfacePointLanes& points) const = 0;

  /// Shapes of one family, if it is not null, may be asked by points_on_each().
  virtual const void* family() const { return nullptr; }
  /// Computes what points_on() does for rays that each cross a shape of its own at its t, to the
  /// last bit. All shapes are of one family, and have one face. No transform moves them.
  virtual void points_on_each(const std::array<const Shape*, lane_count>& /*shapes*/,
                              const RayLanes& /*rays*/, const Lanes& /*t*/, bool /*with_uv*/,
                              SurfacePointLanes& /*points*/) const {}

  /// Faces are counted, and each has the surface that it is a piece of, to find faces that
  /// coincide.
  virtual std::uint32_t face_count() const = 0;
  virtual Surface surface(std::uint32_t face) const = 0;
  /// Returns all faces in order, in object space, for drawing points of them, or none if it has no
  /// formula for that.
  virtual SurfacePieces pieces() const { return {}; }
  /// Returns triangles, counter-clockwise from outside, that are all of its surface and meet in
  /// whole edges, in object space. There are none if it is not made of triangles, or if it is not
  /// known on which side of them the solid is.
  virtual std::vector<Triangle> own_triangles() const { return {}; }
  /// Returns the functions of its faces, for questions about whole boxes, or null if it has no
  /// formulas for them.
  virtual std::unique_ptr<const FaceFunctions> face_functions() const { return nullptr; }

  /// Returns what its facets have beyond what rays meet, or null. Only meshes may have any.
  virtual const FacetAttributes* facet_attributes() const { return nullptr; }
  /// Returns the normal for shading at a point of a face, whose own normal is given. All are in
  /// object space. Only meshes may have others than their faces.
  virtual ShadingNormal shading_normal(std::uint32_t /*face*/, const Vec3& /*position*/,
                                       const Vec3& normal) const {
    return {normal};
  }

  /// A shape of more faces is compared with others face by face only as far as it has listed them.
  static constexpr std::uint32_t max_compared_faces = std::uint32_t{1} << 16;
  /// Returns how many faces, from the first on, are compared with those of all other shapes. The
  /// rest are so many, and so rarely coincide with any, that faces_near() finds those that may.
  virtual std::uint32_t listed_face_count() const { return face_count(); }
  /// Appends those of the rest that may lie in a plane, {p : normal . p = offset}, and have a point
  /// in a box. The numbers may be rounded.
  virtual void faces_near(const Vec3& /*normal*/, double /*offset*/, const Bounds& /*box*/,
                          std::vector<std::uint32_t>& /*faces*/) const {}

  /// Returns the bytes of memory it takes.
  virtual std::size_t bytes() const = 0;
};

/// A ShapeOfPoints has one formula for one point and for lanes: void
/// Derived::write_point<Real>(offset, direction, face, with_uv, point). It writes directly into
/// `point`, as copying what was just written waits until that has reached the cache.
template <class Derived>
class ShapeOfPoints : public Shape {
 public:
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const final {
    SurfacePoint point;
    derived().template write_point<double>(offset, direction, face, with_uv, point);
    return point;
  }
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t /*some*/,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const final {
    derived().template write_point<Lanes>(offsets, directions, face, with_uv, points);
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

/// A ShapeOfSpans also has one formula for the span of one line and of lanes: void
/// Derived::write_span<Real>(ray, wanted, span). A ray is a PlainRay or an ObjectRay, or as many
/// side by side.
template <class Derived>
class ShapeOfSpans : public ShapeOfPoints<Derived> {
 public:
  bool finds_spans(const Placement& /*placement*/) const final { return true; }
  void span(const FilterLine<double>& line, const WantedEnds<double>& wanted,
            const FaceStarts<double>* /*starts*/, ShapeSpan<double>& span) const final {
    derived().template write_span<double>(plain_ray(line), wanted, span);
  }
  void span(const FilterLine<Lanes>& lines, const WantedEnds<Lanes>& wanted,
            const FaceStarts<Lanes>* /*starts*/, ShapeSpan<Lanes>& span) const final {
    derived().template write_span<Lanes>(plain_ray(lines), wanted, span);
  }
  void span(const ObjectRay& ray, const WantedEnds<double>& wanted,
            ShapeSpan<double>& span) const final {
    derived().template write_span<double>(ray, wanted, span);
  }
  void span(const ObjectRayLanes& rays, const WantedEnds<Lanes>& wanted,
            ShapeSpan<Lanes>& span) const final {
    derived().template write_span<Lanes>(rays, wanted, span);
  }

 private:
  const Derived& derived() const { return static_cast<const Derived&>(*this); }
};

/// A ShapeOfSinglePoints has a formula for one point only. It asks for lanes one by one.
class ShapeOfSinglePoints : public Shape {
 public:
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override;
};

class ExactShape;

// Each primitive's header has these four for its own public struct. shape.cpp checks that none is
// missing.

/// Checks a primitive's parameters. Throws Error (invalid_argument) naming the field.
void validate(const Primitive& primitive);

/// Returns whether a primitive is a solid, without making its shape.
bool is_solid(const Primitive& primitive);

/// Makes the shape of a (valid) primitive.
std::unique_ptr<const Shape> make_shape(const Primitive& primitive);

/// Makes the shape of a (valid) primitive for the exact tier (exact_shape.hpp).
std::unique_ptr<const ExactShape> make_exact_shape(const Primitive& primitive);

}  // namespace crt::core
