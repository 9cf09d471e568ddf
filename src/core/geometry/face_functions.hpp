// A face function of a solid is below 0 on the inner side of the surface that a face is a piece of,
// above 0 on the other side, and 0 on it. From these functions follows what is known of a solid in
// a whole box at once: that it is surely full or empty, or which faces cross it, and how.
//
// Every primitive writes each of its functions once, for numbers of any of the four kinds below.
// Lengths are those of object space; a function may be scaled by any number above 0.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <memory>
#include <vector>

#include "core/geometry/bounds.hpp"
#include "core/math/jet.hpp"
#include "core/math/patch_series.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A PointOf is a place in object space, of any kind of numbers.
template <class Number>
using PointOf = std::array<Number, 3>;

/// NearFaces are what a solid knows of a box.
struct NearFaces {
  enum class Kind : std::uint8_t {
    outside,  ///< no point of the box is in the solid
    inside,   ///< all points are, but for those on its surface
    /// A point of the box is in the solid if all functions of `faces` are below 0 there, and not in
    /// it if one of them is above.
    where_all_negative,
    /// A point of the box is in the solid if one of these functions is below 0 there, and not in it
    /// if all of them are above.
    where_any_negative,
    /// A point of the box is in the solid if `inside` says so: its bit m is that of points where
    /// exactly the functions of those of `faces` are below 0 whose bits are set in m.
    by_signs,
    /// Nothing is known, but that no other faces than `faces` are in the box. If these are none,
    /// not even that.
    unknown,
  };
  Kind kind = Kind::unknown;
  /// Numbers from Shape::face_count() on are of more functions, whose surfaces no other solid has.
  std::vector<std::uint32_t> faces;
  std::uint32_t inside = 0;
  static constexpr std::size_t most_by_signs = 5;

  /// Says so of at most most_by_signs faces.
  void say_by_signs(std::initializer_list<std::uint32_t> of_faces, std::uint32_t in_solid) {
    say(Kind::by_signs, of_faces);
    inside = in_solid;
  }
  void say(Kind what, std::initializer_list<std::uint32_t> of_faces = {}) {
    kind = what;
    faces.assign(of_faces);
  }
  /// Takes away from the solid where the function of a face is above 0.
  void keep_within(std::uint32_t face);
};

class FaceFunctions {
 public:
  FaceFunctions() = default;
  FaceFunctions(const FaceFunctions&) = delete;
  FaceFunctions& operator=(const FaceFunctions&) = delete;
  virtual ~FaceFunctions() = default;

  /// Says what is known of a box of object space, whose coordinates are within `box`. It takes the
  /// place of what `near` holds.
  virtual void look(const PointOf<Interval>& box, NearFaces& near) const = 0;

  /// These return what the function of a face is. The last two know nothing (their error is
  /// infinite) if has_series() is false.
  virtual Interval value(std::uint32_t face, const PointOf<Interval>& point) const = 0;
  virtual Jet value(std::uint32_t face, const PointOf<Jet>& point) const = 0;
  virtual PatchSeries value(std::uint32_t face, const PointOf<PatchSeries>& point) const = 0;
  virtual JetOf<PatchSeries> value(std::uint32_t face,
                                   const PointOf<JetOf<PatchSeries>>& point) const = 0;
  virtual bool has_series() const = 0;

  /// Returns the largest number of times that a line may cross the surface of a face, or 0 if there
  /// is no such number.
  virtual int max_crossings(std::uint32_t face) const = 0;
  /// Returns whether the surface of a face may be surface of the solid. Others only say where faces
  /// count.
  virtual bool is_surface(std::uint32_t face) const = 0;
};

/// A FaceFunctionsOf is made of a Solid with `template <class Number> Number value(face, point)`,
/// `int max_crossings(face)`, and either face_count(), of a solid that is where all its functions
/// are below 0, or `void look(box, near)`. One whose functions take no series says so by
/// `static constexpr bool has_series = false`, and one with functions of no surface has
/// `bool is_surface(face)`.
template <class Solid>
class FaceFunctionsOf final : public FaceFunctions {
 public:
  explicit FaceFunctionsOf(const Solid& solid) : solid_(solid) {}

  void look(const PointOf<Interval>& box, NearFaces& near) const override {
    if constexpr (requires { solid_.look(box, near); }) {
      solid_.look(box, near);
    } else {
      near.kind = NearFaces::Kind::where_all_negative;
      near.faces.clear();
      for (std::uint32_t face = 0; face < solid_.face_count(); ++face) near.faces.push_back(face);
    }
  }
  Interval value(std::uint32_t face, const PointOf<Interval>& point) const override {
    return solid_.value(face, point);
  }
  Jet value(std::uint32_t face, const PointOf<Jet>& point) const override {
    return solid_.value(face, point);
  }
  PatchSeries value(std::uint32_t face, const PointOf<PatchSeries>& point) const override {
    if constexpr (with_series) return solid_.value(face, point);
    return nothing();
  }
  JetOf<PatchSeries> value(std::uint32_t face,
                           const PointOf<JetOf<PatchSeries>>& point) const override {
    if constexpr (with_series) return solid_.value(face, point);
    return {nothing(), {nothing(), nothing(), nothing()}};
  }
  bool has_series() const override { return with_series; }
  int max_crossings(std::uint32_t face) const override { return solid_.max_crossings(face); }
  bool is_surface(std::uint32_t face) const override {
    if constexpr (requires { solid_.is_surface(face); }) return solid_.is_surface(face);
    return true;
  }

 private:
  static constexpr bool with_series = [] {
    if constexpr (requires { Solid::has_series; }) return Solid::has_series;
    return true;
  }();
  static PatchSeries nothing() { return {.error = std::numeric_limits<double>::infinity()}; }

  Solid solid_;
};

template <class Solid>
std::unique_ptr<const FaceFunctions> face_functions_of(const Solid& solid) {
  return std::make_unique<const FaceFunctionsOf<Solid>>(solid);
}

bool is_one_point(const PointOf<Interval>& box);
/// Returns whether a box may have more in common with bounds than a part of its surface, or is a
/// point that may be in them.
bool may_overlap(const PointOf<Interval>& box, const Bounds& bounds);

/// Returns a point of which the coordinates are known.
inline PointOf<Interval> known_point(const Vec3& point) {
  return {Interval::of(point.x), Interval::of(point.y), Interval::of(point.z)};
}
/// Returns the point or vector in the middle of intervals, rounded.
inline Vec3 middle_of(const PointOf<Interval>& v) {
  return {v[0].middle(), v[1].middle(), v[2].middle()};
}
/// Returns a place relative to another.
template <class Number>
PointOf<Number> relative_to(const PointOf<Number>& point, const Vec3& center) {
  return {point[0] - Interval::of(center.x), point[1] - Interval::of(center.y),
          point[2] - Interval::of(center.z)};
}
/// Returns it in units of a power of two, whose inverse is given.
template <class Number>
PointOf<Number> scaled(const PointOf<Number>& point, double inverse_unit) {
  const Interval factor = Interval::of(inverse_unit);
  return {point[0] * factor, point[1] * factor, point[2] * factor};
}
/// Returns how far a place is along a vector of unit length.
template <class Number>
Number component_along(const PointOf<Number>& a, const PointOf<Interval>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
Number squared_length(const PointOf<Number>& a) {
  return square(a[0]) + square(a[1]) + square(a[2]);
}
/// Returns the squared length of the part of a that is across a unit vector.
template <class Number>
Number squared_length_across(const PointOf<Number>& a, const PointOf<Interval>& axis) {
  const auto component = [&](std::size_t i, std::size_t j) {
    return square(a[i] * axis[j] - a[j] * axis[i]);
  };
  return component(1, 2) + component(2, 0) + component(0, 1);
}
/// Returns the unit vector from one point to another, enclosed.
PointOf<Interval> unit_vector(const Vec3& from, const Vec3& to);
/// Returns a unit vector that is known to rounding, enclosed. Coordinate axes are exact.
PointOf<Interval> enclosed_unit(const Vec3& unit);
/// Returns the distance of two points, enclosed.
Interval distance(const Vec3& from, const Vec3& to);

/// A HalfSpaceFunction is that of a plane.
struct HalfSpaceFunction {
  PointOf<Interval> normal;  ///< of about unit length
  Vec3 position{0, 0, 0};

  template <class Number>
  Number value(const PointOf<Number>& point) const {
    return component_along(relative_to(point, position), normal);
  }
};

}  // namespace crt::core
