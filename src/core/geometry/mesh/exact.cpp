// Meshes of the exact tier find where the line meets each plane without rounding.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/mesh/exact_tier.hpp"
#include "core/geometry/mesh/mesh.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

namespace {

ExactPlane plane_of(const MeshTriangles& mesh, std::uint32_t triangle) {
  return plane_through(mesh.corners_of_plane(triangle));
}

class ExactMeshShape final : public ExactShape {
 public:
  explicit ExactMeshShape(std::shared_ptr<const MeshTriangles> triangles)
      : triangles_(std::move(triangles)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    PassingLine line(ray);
    return append_crossings(*triangles_, line, ExactMeshTier(*triangles_, ray), out);
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
