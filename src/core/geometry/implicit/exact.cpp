// Implicit solids of the exact tier have the faces of the exact tier's box. The field's own face is
// found as in the standard tier, with a higher limit on the work and the errors of the ray.
#include "core/geometry/box/box.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/implicit/implicit.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

class ExactImplicitShape final : public ExactShape {
 public:
  explicit ExactImplicitShape(const Implicit& implicit)
      : box_(make_exact_shape(Box{.corner_a = implicit.lower, .corner_b = implicit.upper})),
        program_(FieldProgram::of(implicit.field)),
        corners_{exactly(implicit.lower), exactly(implicit.upper)} {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    const ObjectRay near = as_box_sees(ray.near);
    const std::size_t before = out.size();
    box_->crossings(ray.seen_as(near), out);
    // The low parts of the ray have roundings, too.
    constexpr double low_parts = 0x1p-104;
    return replace_by_field_crossings(
        *program_,
        {.ray = ray.near,
         .is_exact = true,
         .origin_error = ray.origin_error + low_parts * largest_component(ray.near.origin),
         .direction_error =
             ray.direction_error + low_parts * largest_component(ray.near.direction)},
        before, out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    // No polynomial says where a field is 0.
    if (crossing.face < first_box_face) return std::nullopt;
    const ObjectRay near = as_box_sees(ray.near);
    Crossing of_box = crossing;
    of_box.face -= first_box_face;
    return box_->place(ray.seen_as(near), of_box);
  }

  ExactSurface surface(std::uint32_t face) const override {
    if (face >= first_box_face) return box_->surface(face - first_box_face);
    ExactSurface result{.points = {exactly(Vec3(0))}, .numbers = program_->numbers()};
    for (const DyadicVector& corner : corners_) {
      for (const Dyadic& coordinate : corner) result.numbers.push_back(coordinate);
    }
    return result;
  }

  std::size_t bytes() const override { return sizeof *this + box_->bytes() + program_->bytes(); }

 private:
  std::unique_ptr<const ExactShape> box_;
  std::shared_ptr<const FieldProgram> program_;
  std::array<DyadicVector, 2> corners_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Implicit& implicit) {
  return std::make_unique<ExactImplicitShape>(implicit);
}

}  // namespace crt::core
