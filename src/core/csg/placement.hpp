// Where a primitive's object space lies in the world.
#pragma once

#include <memory>
#include <optional>

#include "core/geometry/bounds.hpp"
#include "core/geometry/exact_ray.hpp"
#include "core/math/lanes.hpp"
#include "core/math/precise_transform.hpp"
#include "core/ray/object_ray.hpp"
#include "crt/transform.hpp"

namespace crt::core {

/// All the transforms of an entity in one. In the standard tier the placement *is* by definition
/// the map to the world rounded to 12 doubles; in the exact tier it is the map. Its inverse is kept
/// in double-double, so that a ray enters object space with far less error than a double has.
class Placement {
 public:
  Placement() = default;
  explicit Placement(const PreciseTransform& to_world);
  /// Of the exact tier; the chain must outlive the placement if it is more than twelve doubles.
  explicit Placement(const TransformChain& to_world);

  bool is_identity() const { return kind_ == Kind::identity; }
  bool is_translation() const { return kind_ != Kind::affine; }
  /// Rounded to 12 doubles.
  const Transform& to_world() const { return to_world_; }
  /// The map itself.
  DyadicTransform exactly() const;
  bool is_more_than_doubles() const { return more_ != nullptr; }
  /// Whether both are the same map, without any rounding.
  bool has_map_of(const Placement& other) const;

  /// The ray origin + t * direction in object space, with the same t.
  ObjectRay to_object(const Vec3& origin, const Vec3& direction) const {
    ObjectRay ray{.origin = origin, .direction = direction};
    if (kind_ != Kind::identity) move_to_object(ray);
    return ray;
  }

  /// The same of several side by side, to the last bit.
  ObjectRayLanes to_object(const RayLanes& rays) const;

  /// The same as the exact tier takes it; `ray` is what to_object() says, and where it starts.
  ExactRay to_object_exactly(const Vec3& origin, const Vec3& direction, const ObjectRay& ray) const;

  // A Vector is a Vec3, or VectorLanes.

  Vec3 point_to_object(const Vec3& world) const;
  template <class Vector>
  Vector point_to_world(const Vector& object) const;
  /// The same where doubles can tell it and no more than a move is done, to the last bit.
  std::optional<Vec3> exactly_to_world(const Vec3& object) const;

  /// A covector (such as the gradient of a function of the object point) as the world sees it; its
  /// length matters.
  template <class Vector>
  Vector covector_to_world(const Vector& object) const;

  /// A unit normal from a unit normal.
  template <class Vector>
  Vector normal_to_world(const Vector& object) const;

  /// A box around the image of a box, rounded outwards.
  Bounds bounds_to_world(const Bounds& object) const;

  /// The plane {p : normal . p = offset} of object space as the world sees it.
  void plane_to_world(const PreciseVec3& normal, const DoubleDouble& offset,
                      PreciseVec3& world_normal, DoubleDouble& world_offset) const;

 private:
  void take_inverse(const PreciseTransform& inverse);
  double inverse_error() const;
  double inverse_size() const;
  /// A vector turned into object space, a lane a component.
  DoubleDoubleLanes turned_by_rows(const Vec3& v) const;
  /// Takes a ray of the world into object space.
  void move_to_object(ObjectRay& ray) const;

  enum class Kind { identity, translation, affine };

  Kind kind_ = Kind::identity;
  Transform to_world_;
  /// Of a map that has more to it than these.
  struct More {
    const TransformChain* chain = nullptr;
    Transform low;  ///< rounded to doubles, what the map is more than to_world_
  };
  std::shared_ptr<const More> more_;
  PreciseTransform to_object_;
  /// The same by columns, the translation last, a lane a row.
  std::array<DoubleDoubleLanes, 4> columns_;
  /// Of a vector taken to object space: each component is off by at most this times the largest of
  /// the vector.
  double vector_error_ = 0;
};

}  // namespace crt::core
