#include "core/geometry/height_field/height_field.hpp"

#include "core/geometry/box/box.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/height_field/functions.hpp"
#include "core/geometry/mesh/find_met_triangles.hpp"
#include "core/geometry/triangle/triangle.hpp"

namespace crt::core {

HeightFieldShape::HeightFieldShape(const HeightField& field)
    : heights_(field.heights), facets_(field) {}

bool standard_crossings(const HeightFacets& facets, const ObjectRay& ray, CrossingList& out) {
  PassingLine line(ray);
  return append_met_triangles(facets, line, StandardMeshTier(ray), out);
}

template <class Real>
void HeightFieldShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction,
                                   std::uint32_t face, bool with_uv,
                                   SurfacePointOf<Real>& point) const {
  const TriangleShape triangle(facets_.triangle(face));
  triangle.write_point<Real>(offset, direction, 0, false, point);
  if (!with_uv) return;
  const auto [lower, upper] = facets_.bounds();
  const Vec3Of<Real> share =
      (point.position - broadcast<Real>(lower)) / broadcast<Real>(upper - lower);
  const bool is_across_x = face / 2 == 0;
  const bool is_side = face < HeightFacets::side_count;
  const Real zero{};
  const Real one = broadcast<Real>(1);
  point.u = clamp(is_across_x ? share.z : share.x, zero, one);
  point.v = clamp(is_side ? share.y : share.z, zero, one);
}

Surface HeightFieldShape::surface(std::uint32_t face) const {
  return TriangleShape(facets_.triangle(face)).surface(0);
}

std::unique_ptr<const FaceFunctions> HeightFieldShape::face_functions() const {
  return face_functions_of(HeightFieldFunctions{std::make_shared<const HeightFacets>(facets_)});
}

void validate(const HeightField& field) {
  const HeightFacets facets(field);
}

std::unique_ptr<const Shape> make_shape(const HeightField& field) {
  return std::make_unique<HeightFieldShape>(field);
}

}  // namespace crt::core
