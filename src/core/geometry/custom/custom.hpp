// A custom shape is a solid of which the program says what rays cross (crt/custom.hpp).
//
// A ray is handed over as a CustomLine: from where it is closest to the middle of the bounds, so
// that distance costs no accuracy, and along a unit vector. What comes back is checked, as nothing
// that a program says may break what follows. Entries and exits alternate, as the solid is finite.
//
// A ray that starts on the surface is followed from its origin. There the crossing that is its
// start is found by the bounds on errors, or else where entries and exits agree with the start's
// side.
//
// Faces: those that the program numbers.
// Tests: tests/geometry/custom_test.cpp
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/geometry/custom/line.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class CalledShape final : public ShapeOfSinglePoints {
 public:
  explicit CalledShape(const Custom& custom);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return bounds_; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return middle_of(bounds_); }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override;
  std::uint32_t face_count() const override { return face_count_; }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  /// Returns only its own bytes, as nobody knows those of the program's shape.
  std::size_t bytes() const override { return sizeof *this; }

 private:
  /// Asks for what the line crosses, and refuses what cannot be.
  void ask(const Ray& ray, std::vector<CustomCrossing>& found) const;
  /// Asks for a point, and refuses what cannot be.
  CustomPoint ask(const Vec3& position, std::uint32_t face) const;
  /// Gives one of the crossings s = 0, as the ray starts there. Returns its place in the list.
  std::size_t put_start(const ObjectRay& ray, const CustomLine& line,
                        std::vector<CustomCrossing>& found) const;

  std::shared_ptr<const CustomShape> shape_;
  Bounds bounds_;
  std::uint32_t face_count_;
};

/// Returns the numbers that tell the surface of a face from those of all other custom shapes.
std::array<double, 3> identity_of(const CustomShape& shape, std::uint32_t face);

void validate(const Custom& custom);
inline bool is_solid(const Custom&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Custom& custom);
std::unique_ptr<const ExactShape> make_exact_shape(const Custom& custom);

}  // namespace crt::core
