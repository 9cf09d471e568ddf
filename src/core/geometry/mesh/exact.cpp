// Meshes of the exact tier find where the line meets each plane without rounding.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/mesh/mesh.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

namespace {

ExactPlane plane_of(const Triangle& triangle) {
  return ExactPlane::through(triangle.a, triangle.b, triangle.c);
}
ExactPlane plane_of(const MeshTriangles& mesh, std::uint32_t triangle) {
  return plane_of(mesh.triangle(mesh.plane_of(triangle).first));
}

class ExactTier final : public MeshTier {
 public:
  ExactTier(const MeshTriangles& mesh, const ExactRay& ray) : mesh_(mesh), ray_(ray) {}

  bool meet(const Triangle& triangle, Crossing& crossing) const override {
    const ExactPlane::Meeting meeting = plane_of(triangle).meet(ray_);
    crossing.t = meeting.t.hi;
    crossing.t_low = meeting.t.lo;
    crossing.error = meeting.error;
    return meeting.found();
  }

  int order(const Crossing& first, const Crossing& second) const override {
    if (mesh_.plane_of(first.face).first == mesh_.plane_of(second.face).first) return 0;
    const ExactPlane first_plane = plane_of(mesh_, first.face);
    const ExactPlane second_plane = plane_of(mesh_, second.face);
    return core::order(ray_, first_plane, first_plane.meet(ray_), second_plane,
                       second_plane.meet(ray_));
  }

 private:
  const MeshTriangles& mesh_;
  const ExactRay& ray_;
};

class ExactMeshShape final : public ExactShape {
 public:
  explicit ExactMeshShape(std::shared_ptr<const MeshTriangles> triangles)
      : triangles_(std::move(triangles)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    PassingLine line(ray);
    return append_crossings(*triangles_, line, ExactTier(*triangles_, ray), out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return place_on(plane_of(*triangles_, crossing.face), ray, crossing);
  }

  ExactSurface surface(std::uint32_t face) const override {
    return {.is_plane = true, .points = {}, .numbers = plane_of(*triangles_, face).numbers()};
  }

  std::size_t bytes() const override { return sizeof *this; }

 private:
  std::shared_ptr<const MeshTriangles> triangles_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Mesh& mesh) {
  return std::make_unique<ExactMeshShape>(mesh.triangles);
}

}  // namespace crt::core
