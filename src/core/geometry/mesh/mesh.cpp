#include "core/geometry/mesh/mesh.hpp"

#include "core/geometry/checks.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

namespace {

class StandardTier final : public MeshTier {
 public:
  StandardTier(const MeshTriangles& mesh, const ObjectRay& ray) : mesh_(mesh), ray_(ray) {
    ray_.start = {};
  }

  bool meet(std::uint32_t triangle, Crossing& crossing) const override {
    const PlaneFace::Meeting meeting = TriangleShape(mesh_.triangle(triangle)).meet(ray_);
    crossing.t = meeting.t;
    crossing.error = meeting.error;
    return meeting.found;
  }

  int order(const Crossing& first, const Crossing& second) const override {
    return first.t < second.t ? -1 : (first.t > second.t ? 1 : 0);
  }

 private:
  const MeshTriangles& mesh_;
  ObjectRay ray_;  ///< without where it starts
};

}  // namespace

bool MeshShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  PassingLine line(ray);
  return append_crossings(*triangles_, line, StandardTier(*triangles_, ray), out);
}

Surface MeshShape::surface(std::uint32_t face) const {
  const MeshTriangles::PlaneOf plane = triangles_->plane_of(face);
  Surface surface = facet(plane.first).surface(0);
  if (plane.turned) surface.direction = -surface.direction;
  return surface;
}

void validate(const Mesh& mesh) {
  if (!mesh.triangles) reject("triangles", "must be given (see mesh_triangles)");
}

bool is_solid(const Mesh& mesh) {
  return mesh.triangles->is_closed();
}

std::unique_ptr<const Shape> make_shape(const Mesh& mesh) {
  return std::make_unique<MeshShape>(mesh.triangles);
}

}  // namespace crt::core
