// A mesh is what triangles enclose or, where they enclose nothing, the surface that they make.
//
// Which triangles a line crosses is decided exactly in both tiers (passing_line.hpp), so that the
// crossings of a closed mesh are always even in number. Where it crosses them is as for a single
// triangle. Triangles of one plane are crossed at the same t, to the last bit.
//
// Face i is triangle i, of those that have an area. (u, v) are those of its corners, if these have
// any, or else the weights of its second and third corner.
// Tests: tests/geometry/mesh_test.cpp
#pragma once

#include <memory>

#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/triangle/triangle.hpp"

namespace crt::core {

class MeshShape final : public Shape {
 public:
  explicit MeshShape(std::shared_ptr<const MeshTriangles> triangles)
      : triangles_(std::move(triangles)),
        has_uv_(facet_attributes() != nullptr && facet_attributes()->has_uv()) {}

  bool is_solid() const override { return triangles_->is_closed(); }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return triangles_->bounds(); }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override { return triangles_->triangle(face).a; }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override {
    SurfacePoint point = facet(face).point_on(offset, direction, 0, with_uv);
    if (with_uv && has_uv_) facet_attributes()->weights_to_uv(face, point.u, point.v);
    return point;
  }
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override {
    facet(face).points_on(offsets, directions, some, 0, with_uv, points);
    if (with_uv && has_uv_) facet_attributes()->weights_to_uv(face, points.u, points.v);
  }
  /// Returns the normal for shading at a point of a facet with normals. `normal` is the facet's, of
  /// either sign, and the result is on that side.
  ShadingNormal shading_normal(std::uint32_t face, const Vec3& position,
                               const Vec3& normal) const override;
  std::uint32_t face_count() const override { return triangles_->size(); }
  Surface surface(std::uint32_t face) const override;
  SurfacePieces pieces() const override;
  std::vector<Triangle> own_triangles() const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  const FacetAttributes* facet_attributes() const override { return triangles_->attributes(); }
  const MeshTriangles& triangles() const { return *triangles_; }
  const std::shared_ptr<const MeshTriangles>& shared_triangles() const { return triangles_; }
  /// Returns only its own bytes and those of the triangles, which others may share.
  std::size_t bytes() const override { return sizeof *this + triangles_->bytes(); }

 private:
  TriangleShape facet(std::uint32_t face) const {
    return TriangleShape(triangles_->triangle(face));
  }

  std::shared_ptr<const MeshTriangles> triangles_;
  bool has_uv_;
};

/// Returns what the facets of a primitive have beyond what rays meet, or null.
const FacetAttributes* facet_attributes(const Primitive& primitive);

bool is_solid(const Mesh& mesh);
std::unique_ptr<const Shape> make_shape(const Mesh& mesh);
std::unique_ptr<const ExactShape> make_exact_shape(const Mesh& mesh);

}  // namespace crt::core
