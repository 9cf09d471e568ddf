// How far a point is from the helix along its axis follows from the cosine of the angle between
// both about it, without a function that has no slope at the wire's middle: the square of an angle
// is a power series in 1 minus its cosine.
// Source: Borwein and Chamberland, Integer powers of arcsin, 2007 (the series of arcsin^2).
// Tests: tests/csg/helix_test.cpp
#include "crt/helix.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/entity/placed.hpp"
#include "core/entity/turns.hpp"
#include "core/geometry/angles.hpp"
#include "core/geometry/check_fields.hpp"
#include "crt/field.hpp"
#include "crt/schema_primitives.hpp"

namespace crt {

namespace {

/// Returns the cosine of the angle at which the helix rises.
double cosine_of_rise(const Helix& helix) {
  const double around = 2 * std::numbers::pi * helix.radius;
  return around / std::sqrt(around * around + helix.pitch * helix.pitch);
}

void check_helix(const Helix& helix) {
  core::check_fields(helix);
  constexpr double share = 0.9;
  if (!(helix.thickness <= share * helix.radius))
    core::reject("thickness", "must be at most 0.9 of the radius");
  if (!(2 * helix.thickness <= share * helix.pitch * cosine_of_rise(helix)))
    core::reject("pitch", "must leave a tenth of it between the turns");
  core::check_turns(glm::length(helix.to - helix.from), helix.pitch);
}

/// Returns the square of the angle whose cosine is 1 - w.
Field squared_angle(const Field& w) {
  // The terms are 2 (2 w)^n / (n^2 choose(2 n, n)).
  constexpr int terms = 16;
  std::array<double, terms + 1> numbers{};
  double power = 1;
  double choices = 1;
  for (int n = 1; n <= terms; ++n) {
    power *= 2;
    choices *= 2.0 * (2 * n - 1) / n;
    numbers[static_cast<std::size_t>(n)] = 2 * power / (n * n * choices);
  }
  Field sum = numbers[terms];
  for (std::size_t n = terms; n-- > 1;) sum = sum * w + numbers[n];
  return sum * w;
}

/// Returns the helix along z in units of its pitch. Angles are from x towards y.
Implicit upright_helix(const Helix& helix, double length) {
  const double radius = helix.radius / helix.pitch;
  const double thickness = helix.thickness / helix.pitch;
  const Field distance = core::distance_from_axis();
  const Field cosine = core::cosine_to_helix(distance, helix.left, 0.5 * (radius - thickness));
  const double scale = cosine_of_rise(helix) / (2 * std::numbers::pi);
  // Half of the angle is at most a right one, where the series is short. Where turns are farthest
  // away, its cosine has no slope.
  constexpr double least = 1e-6;
  const Field half = sqrt(max(0.5 + 0.5 * cosine, least));
  const Field along = 4 * scale * scale * squared_angle(1 - half);
  const Field beside = distance - radius;
  const double reach = radius + 1.0625 * thickness;
  return {.field = beside * beside + along - thickness * thickness,
          .lower = {-reach, -reach, 0},
          .upper = {reach, reach, length}};
}

}  // namespace

Helix::operator Entity() const {
  check_helix(*this);
  const auto& [zero, quarter, along] = core::frame_about(to - from);
  const Entity solid = core::placed(upright_helix(*this, glm::length(to - from) / pitch),
                                    pitch * zero, pitch * quarter, pitch * along, from);
  return material ? solid.with_material(*material) : solid;
}

}  // namespace crt
