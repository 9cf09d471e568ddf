// A quadric has all points p with f(p) <= 0, for a polynomial f of degree 2 (form.hpp).
//
// Along a line f is a quadratic, which both tiers solve in twice the precision (line.hpp). So the
// rounding of its coefficients matters in neither, however far the quadric is from the origin and
// however much its terms cancel. The standard tier takes for a tangent what is left open by that.
//
// Face 0 is all of it. u is the angle about the y axis through the origin, from +z towards +x, as a
// share of a turn. v is y, in scene units.
// Tests: tests/geometry/quadric_test.cpp, tests/geometry/exact_quadric_test.cpp
#pragma once

#include "core/geometry/quadric/form.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class QuadricShape final : public ShapeOfPoints<QuadricShape> {
 public:
  explicit QuadricShape(const Quadric& quadric);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return extent_.is_convex; }
  Bounds bounds() const override { return extent_.bounds; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return Vec3(0); }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 1; }
  Surface surface(std::uint32_t) const override { return quadric_surface(form_); }
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

  /// Returns the whole surface. Quadrics that are the same but for a power of two or the sign have
  /// equal ones.
  static Surface quadric_surface(const QuadricForm& form);

 private:
  bool crossings_from_surface(const ObjectRay& ray, CrossingList& out) const;

  QuadricForm form_;
  QuadricExtent extent_;
};

void validate(const Quadric& quadric);
inline bool is_solid(const Quadric&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Quadric& quadric);
std::unique_ptr<const ExactShape> make_exact_shape(const Quadric& quadric);

}  // namespace crt::core
