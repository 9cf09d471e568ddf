// A height field is a solid below a surface over a grid of heights, in a box.
//
// Its surface is made of triangles. Which of them a line crosses is decided exactly in both tiers,
// and where it does so is as for a mesh (mesh/find_met_triangles.hpp): a height field is met as a
// mesh of the same triangles is. The bottom and the sides are those of a box. Only the cells that a
// line comes near are looked at (facets.hpp), from near to far.
//
// Faces are numbered in facets.hpp.
// Tests: tests/geometry/height_field_test.cpp
#pragma once

#include <memory>

#include "core/geometry/height_field/facets.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// Appends the crossings of a ray, as Shape::crossings() has them.
bool standard_crossings(const HeightFacets& facets, const ObjectRay& ray, CrossingList& out);

class HeightFieldShape final : public ShapeOfPoints<HeightFieldShape> {
 public:
  explicit HeightFieldShape(const HeightField& field);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return facets_.bounds(); }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override {
    return standard_crossings(facets_, ray, out);
  }
  Vec3 anchor(std::uint32_t face) const override { return facets_.triangle(face).a; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return facets_.face_count(); }
  Surface surface(std::uint32_t face) const override;
  std::vector<Triangle> own_triangles() const override { return facets_.closed_triangles(); }
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::uint32_t listed_face_count() const override {
    return face_count() > max_compared_faces ? HeightFacets::first_of_cells : face_count();
  }
  void faces_near(const Vec3& normal, double offset, const Bounds& box,
                  std::vector<std::uint32_t>& faces) const override {
    facets_.append_near({normal, offset}, box, faces);
  }
  /// Returns only its own bytes and those of the heights, which others may share.
  std::size_t bytes() const override {
    return sizeof *this + facets_.more_bytes() + heights_->bytes();
  }

 private:
  std::shared_ptr<const HeightGrid> heights_;
  HeightFacets facets_;
};

void validate(const HeightField& field);
inline bool is_solid(const HeightField&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const HeightField& field);
std::unique_ptr<const ExactShape> make_exact_shape(const HeightField& field);

}  // namespace crt::core
