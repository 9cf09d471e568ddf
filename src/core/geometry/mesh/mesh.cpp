#include "core/geometry/mesh/mesh.hpp"

#include "core/geometry/mesh/functions.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

bool MeshShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  return standard_crossings(*triangles_, ray, out);
}

ShadingNormal MeshShape::shading_normal(std::uint32_t face, const Vec3& position,
                                        const Vec3& normal) const {
  const FacetAttributes* const attributes = facet_attributes();
  if (attributes == nullptr || !attributes->has_normals()) return {normal};
  const Triangle triangle = triangles_->triangle(face);
  double u = 0;
  double v = 0;
  write_weights(triangle, position - triangle.a, u, v);
  return attributes->normal(face, u, v, normal);
}

Surface MeshShape::surface(std::uint32_t face) const {
  const MeshTriangles::PlaneOf plane = triangles_->plane_of(face);
  Surface surface = facet(plane.first).surface(0);
  if (plane.turned) surface.direction = -surface.direction;
  return surface;
}

std::unique_ptr<const FaceFunctions> MeshShape::face_functions() const {
  if (!is_solid()) return nullptr;
  return face_functions_of(MeshFunctions{triangles_});
}

SurfacePieces MeshShape::pieces() const {
  SurfacePieces pieces;
  pieces.reserve(face_count());
  for (std::uint32_t face = 0; face < face_count(); ++face)
    pieces.push_back(facet(face).pieces().front());
  return pieces;
}

std::vector<Triangle> MeshShape::own_triangles() const {
  std::vector<Triangle> triangles;
  triangles.reserve(face_count());
  for (std::uint32_t face = 0; face < face_count(); ++face) {
    const Facing facing = triangles_->plane_of(face).faces();
    if (facing != Facing::outwards && facing != Facing::inwards) return {};
    Triangle triangle = triangles_->triangle(face);
    if (facing == Facing::inwards) std::swap(triangle.b, triangle.c);
    triangles.push_back(triangle);
  }
  return triangles;
}

const FacetAttributes* facet_attributes(const Primitive& primitive) {
  const auto* mesh = std::get_if<Mesh>(&primitive);
  return mesh == nullptr ? nullptr : mesh->triangles->attributes();
}

bool is_solid(const Mesh& mesh) {
  return mesh.triangles->is_closed();
}

std::unique_ptr<const Shape> make_shape(const Mesh& mesh) {
  return std::make_unique<MeshShape>(mesh.triangles);
}

}  // namespace crt::core
