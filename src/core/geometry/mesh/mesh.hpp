// A mesh is what triangles enclose or, where they enclose nothing, the surface that they make.
//
// Which triangles a line crosses is decided exactly in both tiers (passing_line.hpp), so that the
// crossings of a closed mesh are always even in number. Where it crosses them is as for a single
// triangle. Triangles of one plane are crossed at the same t, to the last bit.
//
// Face i is triangle i, of those that have an area. (u, v) are the weights of its second and third
// corner.
// Tests: tests/geometry/mesh_test.cpp
#pragma once

#include <memory>

#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/triangle/triangle.hpp"

namespace crt::core {

class MeshShape final : public Shape {
 public:
  explicit MeshShape(std::shared_ptr<const MeshTriangles> triangles)
      : triangles_(std::move(triangles)) {}

  bool is_solid() const override { return triangles_->is_closed(); }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return triangles_->bounds(); }
  EnclosedSolid enclosed() const override { return NoEnclosure{}; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t face) const override { return triangles_->triangle(face).a; }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override {
    return facet(face).point_on(offset, direction, 0, with_uv);
  }
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t face,
                 bool with_uv, SurfacePointLanes& points) const override {
    facet(face).points_on(offsets, directions, 0, with_uv, points);
  }
  std::uint32_t face_count() const override { return triangles_->size(); }
  Surface surface(std::uint32_t face) const override;
  /// Returns only its own bytes and those of the triangles, which others may share.
  std::size_t bytes() const override { return sizeof *this + triangles_->bytes(); }

 private:
  TriangleShape facet(std::uint32_t face) const {
    return TriangleShape(triangles_->triangle(face));
  }

  std::shared_ptr<const MeshTriangles> triangles_;
};

void validate(const Mesh& mesh);
bool is_solid(const Mesh& mesh);
std::unique_ptr<const Shape> make_shape(const Mesh& mesh);
std::unique_ptr<const ExactShape> make_exact_shape(const Mesh& mesh);

}  // namespace crt::core
