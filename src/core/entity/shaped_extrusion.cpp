// A point is in the solid if its place across the axis, turned and scaled back as its height says,
// is in the profile. How far it is from the profile's boundary there cuts or rounds the edges.
// Tests: tests/csg/shaped_extrusion_test.cpp
#include "crt/shaped_extrusion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/geometry/check_fields.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/profile_contours.hpp"
#include "crt/field.hpp"
#include "crt/schema_primitives.hpp"

namespace crt {

namespace {

void check_shape(const ShapedExtrusion& solid) {
  core::check_fields(solid);
  constexpr double most_turns = 1000;
  constexpr double largest_taper = 1000;
  if (!(std::abs(solid.twist) <= most_turns * 2 * std::numbers::pi))
    core::reject("twist", "must be at most 1000 turns");
  if (!(solid.taper >= 1 / largest_taper && solid.taper <= largest_taper))
    core::reject("taper", "must be from 0.001 to 1000");
  if (!(solid.bevel <= 0.5 * solid.height))
    core::reject("bevel", "must be at most half of the height");
  if (!(solid.rounding <= 0.5 * solid.height))
    core::reject("rounding", "must be at most half of the height");
  if (solid.bevel > 0 && solid.rounding > 0)
    core::reject("rounding", "must be 0 if there is a bevel");
}

/// Returns the distance from the profile at a height, in the units of the solid.
Field distance_across(const ShapedExtrusion& solid) {
  Field u = Field::x();
  Field v = Field::y();
  if (solid.twist != 0) {
    const Field turn = solid.twist / solid.height * Field::z();
    u = cos(turn) * Field::x() + sin(turn) * Field::y();
    v = cos(turn) * Field::y() - sin(turn) * Field::x();
  }
  if (solid.taper == 1) return profile_distance(solid.profile, u, v);
  const Field scale = 1 + (solid.taper - 1) / solid.height * Field::z();
  return scale * profile_distance(solid.profile, u / scale, v / scale);
}

Field field_of(const ShapedExtrusion& solid) {
  Field across = distance_across(solid);
  const double half = 0.5 * solid.height;
  const Field beyond_ends = abs(Field::z() - half) - half;
  if (solid.bevel > 0) return max(across, across + beyond_ends + solid.bevel);
  if (solid.rounding == 0) return across;
  const double radius = solid.rounding;
  const Field sideways = max(across + radius, 0);
  const Field upwards = max(beyond_ends + radius, 0);
  return max(across, (sideways * sideways + upwards * upwards) / radius - radius);
}

/// Returns how far the solid reaches across the axis, with room around it, so that only its ends
/// are in faces of the box.
core::Bounds bounds_across(const ShapedExtrusion& solid) {
  core::Bounds box = core::bounds_of(*solid.profile);
  const core::Bounds lower = box;
  box.include(solid.taper * lower.lower);
  box.include(solid.taper * lower.upper);
  if (solid.twist != 0) {
    const double x = std::max(std::abs(box.lower.x), std::abs(box.upper.x));
    const double y = std::max(std::abs(box.lower.y), std::abs(box.upper.y));
    const double reach = std::sqrt(x * x + y * y);
    box.include({-reach, -reach, 0});
    box.include({reach, reach, 0});
  }
  constexpr double room = 1.0 / 16;
  return box.grown(room * std::max(box.upper.x - box.lower.x, box.upper.y - box.lower.y));
}

Entity shaped(const ShapedExtrusion& solid) {
  const bool is_plain =
      solid.twist == 0 && solid.taper == 1 && solid.bevel == 0 && solid.rounding == 0;
  if (is_plain) return Extrusion{.profile = solid.profile, .from = 0, .to = solid.height};
  const core::Bounds box = bounds_across(solid);
  return Implicit{.field = field_of(solid),
                  .lower = {box.lower.x, box.lower.y, 0},
                  .upper = {box.upper.x, box.upper.y, solid.height}};
}

}  // namespace

ShapedExtrusion::operator Entity() const {
  check_shape(*this);
  const Entity solid = shaped(*this);
  return material ? solid.with_material(*material) : solid;
}

}  // namespace crt
