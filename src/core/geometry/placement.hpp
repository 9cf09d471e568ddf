// A placement is where a primitive's object space lies in the world.
#pragma once

#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "core/geometry/bounds.hpp"
#include "core/geometry/exact_ray.hpp"
#include "core/math/interval.hpp"
#include "core/math/lanes.hpp"
#include "core/math/precise_transform.hpp"
#include "core/ray/object_ray.hpp"
#include "crt/transform.hpp"

namespace crt::core {

/// Returns a box around the image of a box, rounded outwards.
Bounds moved_bounds(const Transform& transform, const Bounds& box);

/// A Placement is all the transforms of an entity in one. In the standard tier it *is* by
/// definition the map to the world rounded to 12 doubles, and in the exact tier it is the map. Its
/// inverse is kept in double-double, so that a ray enters object space with far less error than a
/// double has.
class Placement {
 public:
  Placement() = default;
  explicit Placement(const PreciseTransform& to_world);
  /// Makes a placement of the exact tier. The chain must outlive the placement if it is more than
  /// twelve doubles.
  explicit Placement(const TransformChain& to_world);

  bool is_identity() const { return kind_ == Kind::identity; }
  bool is_translation() const { return kind_ != Kind::affine; }
  /// Returns the map rounded to 12 doubles.
  const Transform& to_world() const { return to_world_; }
  /// Returns the map itself.
  DyadicTransform exactly() const;
  bool is_more_than_doubles() const { return more_ != nullptr; }
  /// Returns whether both are the same map, without any rounding.
  bool has_map_of(const Placement& other) const;

  /// Returns the ray origin + t * direction in object space, with the same t.
  ObjectRay to_object(const Vec3& origin, const Vec3& direction) const {
    ObjectRay ray{.origin = origin, .direction = direction};
    if (kind_ != Kind::identity) move_to_object(ray);
    return ray;
  }

  ObjectRay to_object(const PlainRay<double>& ray) const {
    return to_object(ray.origin, ray.direction);
  }

  /// Returns several rays side by side in object space, each of them to the last bit as it is
  /// alone.
  ObjectRayLanes to_object(const RayLanes& rays) const;

  /// Returns a ray in object space as the exact tier takes it. `ray` is what to_object() returns,
  /// and where it starts.
  ExactRay to_object_exactly(const Vec3& origin, const Vec3& direction, const ObjectRay& ray) const;

  // A Vector is a Vec3, or VectorLanes.

  Vec3 point_to_object(const Vec3& world) const;
  /// Returns a place of the world, of any kind of numbers (face_functions.hpp), in object space.
  template <class Number>
  std::array<Number, 3> to_object(const std::array<Number, 3>& world) const {
    if (kind_ == Kind::identity) return world;
    std::array<Number, 3> moved = world;
    for (std::size_t i = 0; i < 3; ++i) {
      const double by = to_world_.translation[static_cast<int>(i)];
      if (by != 0) moved[i] = world[i] - Interval::of(by);
    }
    if (kind_ == Kind::translation) return moved;
    std::array<Number, 3> object = moved;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto row = enclosed_row(i);
      object[i] = moved[0] * row[0] + moved[1] * row[1] + moved[2] * row[2];
    }
    return object;
  }
  template <class Vector>
  Vector point_to_world(const Vector& object) const;
  /// Returns a point in the world to the last bit, or nothing if doubles do not hold it or the map
  /// does more than move.
  std::optional<Vec3> exactly_to_world(const Vec3& object) const;

  /// Returns a direction in the world, rounded, of the length that it has there.
  Vec3 direction_to_world(const Vec3& object) const;
  /// Returns by how much the map scales, if it does so alike in all directions but for roundings,
  /// 2^-40; else 0.
  double even_scale() const;

  /// Returns a covector in the world, such as the gradient of a function of the object point. Its
  /// length matters.
  template <class Vector>
  Vector covector_to_world(const Vector& object) const;

  /// Returns a unit normal in the world from one in object space.
  template <class Vector>
  Vector normal_to_world(const Vector& object) const;

  /// Returns a box around the image of a box, rounded outwards.
  Bounds bounds_to_world(const Bounds& object) const {
    return kind_ == Kind::identity ? object : moved_bounds(to_world_, object);
  }
  /// Returns how many times as large components of a vector may get in object space.
  double largest_stretch_to_object() const { return kind_ == Kind::affine ? inverse_size() : 1; }

  /// Computes what the plane {p : normal . p = offset} of object space is in the world.
  void plane_to_world(const PreciseVec3& normal, const DoubleDouble& offset,
                      PreciseVec3& world_normal, DoubleDouble& world_offset) const;

 private:
  /// Returns a row of the linear part of the inverse map, enclosed.
  std::array<Interval, 3> enclosed_row(std::size_t row) const {
    const auto enclosed = [&](const DoubleDouble& entry) {
      const double off = vector_error_ + 0x1p-52 * std::abs(entry.hi);
      return entry.hi == 0 && entry.lo == 0 && vector_error_ == 0
                 ? Interval{0, 0}
                 : Interval{sum_down(entry.hi - off), sum_up(entry.hi + off)};
    };
    const PreciseVec3& entries = to_object_.rows[row];
    return {enclosed(entries[0]), enclosed(entries[1]), enclosed(entries[2])};
  }
  void take_inverse(const PreciseTransform& inverse);
  double inverse_error() const;
  double inverse_size() const;
  /// Returns a vector turned into object space, a lane a component.
  DoubleDoubleLanes turned_by_rows(const Vec3& v) const;
  /// Takes a ray of the world into object space.
  void move_to_object(ObjectRay& ray) const;

  enum class Kind { identity, translation, affine };

  Kind kind_ = Kind::identity;
  Transform to_world_;
  /// More is what a map has beyond 12 doubles.
  struct More {
    const TransformChain* chain = nullptr;
    Transform low;  ///< what the map is more than to_world_, rounded to doubles
  };
  std::shared_ptr<const More> more_;
  PreciseTransform to_object_;
  /// These are the columns of to_object_, the translation last, a lane a row.
  std::array<DoubleDoubleLanes, 4> columns_;
  /// Each component of a vector taken to object space is off by at most this times the largest
  /// component of the vector.
  double vector_error_ = 0;
};

}  // namespace crt::core
