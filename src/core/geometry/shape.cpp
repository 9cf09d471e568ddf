// The public description of a primitive becomes its shape here. The variant Primitive is the one
// list of all primitives. Each has overloads of is_solid(), make_shape() and make_exact_shape() of
// its own, and of validate() if its rules in crt/schema_primitives.hpp do not say all.
#include "core/geometry/shape.hpp"

#include <bit>

#include "core/geometry/box/box.hpp"
#include "core/geometry/capsule/capsule.hpp"
#include "core/geometry/check_fields.hpp"
#include "core/geometry/cone/cone.hpp"
#include "core/geometry/custom/custom.hpp"
#include "core/geometry/cylinder/cylinder.hpp"
#include "core/geometry/disc/disc.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/extrusion/extrusion.hpp"
#include "core/geometry/half_plane/half_plane.hpp"
#include "core/geometry/height_field/height_field.hpp"
#include "core/geometry/implicit/implicit.hpp"
#include "core/geometry/mesh/mesh.hpp"
#include "core/geometry/plane/plane.hpp"
#include "core/geometry/quadric/quadric.hpp"
#include "core/geometry/revolution/revolution.hpp"
#include "core/geometry/rounded_box/rounded_box.hpp"
#include "core/geometry/sphere/sphere.hpp"
#include "core/geometry/torus/torus.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/validate.hpp"

namespace crt {

void validate(const Primitive& primitive) {
  core::validate(primitive);
}

namespace core {

namespace {

/// Says whether all functions of a primitive are declared for its own struct. If an overload were
/// missing, those for a Primitive below would be taken, which would call themselves.
template <class Description>
constexpr bool has_all_functions = requires {
  static_cast<bool (*)(const Description&)>(&is_solid);
  static_cast<std::unique_ptr<const Shape> (*)(const Description&)>(&make_shape);
  static_cast<std::unique_ptr<const ExactShape> (*)(const Description&)>(&make_exact_shape);
};

template <class... Descriptions>
constexpr bool have_all_functions(std::variant<Descriptions...>*) {
  return (has_all_functions<Descriptions> && ...);
}

static_assert(have_all_functions(static_cast<Primitive*>(nullptr)),
              "a primitive lacks one of is_solid, make_shape, make_exact_shape");

template <class Description>
constexpr bool has_own_validate = requires {
  static_cast<void (*)(const Description&)>(&validate);
};

}  // namespace

void ShapeOfSinglePoints::points_on(const VectorLanes& offsets, const VectorLanes& directions,
                                    std::uint32_t some, std::uint32_t face, bool with_uv,
                                    SurfacePointLanes& points) const {
  for (std::uint32_t left = some; left != 0; left &= left - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(left));
    const SurfacePoint point = point_on(offsets.lane(lane), directions.lane(lane), face, with_uv);
    points.position.set(lane, point.position);
    points.normal.set(lane, point.normal);
    points.u[lane] = point.u;
    points.v[lane] = point.v;
  }
}

void validate(const Primitive& primitive) {
  std::visit(
      []<class Description>(const Description& description) {
        check_fields(description);
        if constexpr (has_own_validate<Description>) validate(description);
      },
      primitive);
}

bool is_solid(const Primitive& primitive) {
  return std::visit([](const auto& description) { return is_solid(description); }, primitive);
}

std::unique_ptr<const Shape> make_shape(const Primitive& primitive) {
  return std::visit([](const auto& description) { return make_shape(description); }, primitive);
}

std::unique_ptr<const ExactShape> make_exact_shape(const Primitive& primitive) {
  return std::visit([](const auto& description) { return make_exact_shape(description); },
                    primitive);
}

}  // namespace core
}  // namespace crt
