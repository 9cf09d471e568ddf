#include "core/geometry/implicit/implicit.hpp"

#include <bit>

#include "core/geometry/box/box.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/implicit/field_line.hpp"
#include "core/geometry/implicit/functions.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Returns the surface of a field in a box. Others than equal ones differ in 128 bits of a hash.
Surface surface_of(const Implicit& implicit, const FieldProgram& program) {
  std::array<std::uint64_t, 2> hash = {0xcbf29ce484222325u, 0x9ae16a3b2f90404fu};
  const auto mix = [&](std::uint64_t word) {
    hash[0] = (hash[0] ^ word) * 0x9e3779b97f4a7c15u;
    hash[0] ^= hash[0] >> 32;
    hash[1] = (hash[1] + word) * 0xc2b2ae3d27d4eb4fu;
    hash[1] ^= hash[1] >> 29;
  };
  const auto mix_number = [&](double number) { mix(std::bit_cast<std::uint64_t>(number + 0.0)); };
  for (const Vec3& corner : {implicit.lower, implicit.upper}) {
    for (int axis = 0; axis < 3; ++axis) mix_number(corner[axis]);
  }
  for (const FieldStep& step : program.steps()) {
    mix(static_cast<std::uint64_t>(step.operation) | std::uint64_t{step.result} << 8 |
        std::uint64_t{step.a} << 24 | std::uint64_t{step.b} << 40);
    mix_number(step.number);
  }
  // The position is that of the field's own origin, which a placement may move.
  return {.kind = SurfaceKind::field,
          .sizes = {std::bit_cast<double>(hash[0]), std::bit_cast<double>(hash[1])}};
}

}  // namespace

ImplicitShape::ImplicitShape(const Implicit& implicit)
    : box_(make_shape(Box{.corner_a = implicit.lower, .corner_b = implicit.upper})),
      program_(FieldProgram::of(implicit.field)),
      surface_(surface_of(implicit, *program_)) {}

bool ImplicitShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const std::size_t before = out.size();
  box_->crossings(as_box_sees(ray), out);
  return replace_by_field_crossings(*program_, {.ray = ray}, before, out);
}

ImplicitShape::Slope ImplicitShape::slope_at(const Vec3& place) const {
  const std::array<Interval, 3> at = {Interval::of(place.x), Interval::of(place.y),
                                      Interval::of(place.z)};
  Slope result;
  for (int axis = 0; axis < 3; ++axis) {
    std::array<Interval, 3> direction{};
    direction[static_cast<std::size_t>(axis)] = Interval::of(1);
    const FieldLine::Values values = FieldLine(*program_, at, direction).evaluate(0, 0);
    const double slope = values.slope.middle();
    result.gradient[axis] = std::isfinite(slope) ? slope : 0;
    result.value = values.middle.middle();
  }
  return result;
}

SurfacePoint ImplicitShape::point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                                     bool with_uv) const {
  if (face >= first_box_face) {
    return box_->point_on(offset, direction, face - first_box_face, with_uv);
  }
  const auto [lower, upper] = box_->bounds();
  const Vec3 size = upper - lower;
  const Vec3 within = glm::clamp(offset, Vec3(0), size);
  SurfacePoint point;
  const Vec3 place = glm::min(lower + within, upper);
  const auto [value, up] = slope_at(place);
  // The rounding of t has put a point that is far from the ray's origin off the surface.
  constexpr double farthest = 0x1p-20;
  const Vec3 step = up * (value / glm::dot(up, up));
  const bool is_near = largest_component(step) < farthest * largest_component(size);
  point.position = is_near ? glm::clamp(place - step, lower, upper) : place;
  // Where the field is flat, or has a corner, the normal is against the ray.
  point.normal = unit_vector(largest_component(up) > 0 ? up : -direction);
  point.u = within.x / size.x;
  point.v = within.y / size.y;
  return point;
}

void ImplicitShape::points_on(const VectorLanes& offsets, const VectorLanes& directions,
                              std::uint32_t some, std::uint32_t face, bool with_uv,
                              SurfacePointLanes& points) const {
  if (face >= first_box_face) {
    box_->points_on(offsets, directions, some, face - first_box_face, with_uv, points);
    return;
  }
  ShapeOfSinglePoints::points_on(offsets, directions, some, face, with_uv, points);
}

Surface ImplicitShape::surface(std::uint32_t face) const {
  return face >= first_box_face ? box_->surface(face - first_box_face) : surface_;
}

std::unique_ptr<const FaceFunctions> ImplicitShape::face_functions() const {
  const auto [lower, upper] = box_->bounds();
  return face_functions_of(ImplicitFunctions{program_, {.lower = lower, .upper = upper}});
}

void validate(const Implicit& implicit) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(implicit.upper[axis] - implicit.lower[axis] >= smallest_length)) {
      reject("upper", "must be above lower by at least 1e-100 in every coordinate");
    }
  }
  FieldProgram::of(implicit.field);
}

std::unique_ptr<const Shape> make_shape(const Implicit& implicit) {
  return std::make_unique<ImplicitShape>(implicit);
}

}  // namespace crt::core
