// Height fields of the exact tier find where the line meets each plane without rounding.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/height_field/height_field.hpp"
#include "core/geometry/mesh/exact_tier.hpp"
#include "core/geometry/mesh/find_met_triangles.hpp"

namespace crt::core {

namespace {

class ExactHeightFieldShape final : public ExactShape {
 public:
  explicit ExactHeightFieldShape(const HeightField& field) : facets_(field) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    PassingLine line(ray);
    return append_met_triangles(facets_, line, ExactMeshTier(facets_, ray), out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return place_on(plane_through(facets_.triangle(crossing.face)), ray, crossing);
  }

  ExactSurface surface(std::uint32_t face) const override {
    return {
        .is_plane = true, .points = {}, .numbers = plane_through(facets_.triangle(face)).numbers()};
  }

  std::size_t bytes() const override { return sizeof *this + facets_.more_bytes(); }

 private:
  HeightFacets facets_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const HeightField& field) {
  return std::make_unique<ExactHeightFieldShape>(field);
}

}  // namespace crt::core
