// The flanks of a thread are a function of the height and of the angle about its axis: the radius
// falls evenly from where a crest would be sharp, as far as half of the pitch away. So the cosine
// of the turn since then has all that is needed, and its arc is a triangle wave.
// Source: ISO 68-1:1998, General purpose screw threads, Basic profile.
// Tests: tests/csg/thread_test.cpp
#include "crt/thread.hpp"

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

void check(const Thread& thread) {
  core::check_fields(thread);
  constexpr double most_of_diameter = 0.9;
  if (!(thread.pitch <= most_of_diameter * thread.diameter))
    core::reject("pitch", "must be at most 0.9 diameters");
  core::check_turns(glm::length(thread.to - thread.from), thread.pitch);
}

/// Returns the thread along z in units of its pitch. Angles are from x towards y.
Implicit upright_thread(double diameter, double length, bool is_left) {
  const double radius = 0.5 * diameter;
  const double height = 0.5 * std::numbers::sqrt3;  // of the triangle
  const Field distance = core::distance_from_axis();
  // Near the axis, where there is no angle, the core is solid anyway.
  const double inner = radius - 5.0 / 8 * height;
  const Field cosine = core::cosine_to_helix(distance, is_left, 0.5 * inner);
  const Field share = acos(min(max(cosine, -1), 1)) / std::numbers::pi;
  const Field flank = radius + height / 8 - height * share;
  const Field surface = min(max(flank, inner), radius);
  // The box leaves room around the crests, so that it crosses nothing but the ends.
  const double reach = 1.0625 * radius;
  return {
      .field = distance - surface, .lower = {-reach, -reach, 0}, .upper = {reach, reach, length}};
}

}  // namespace

Thread::operator Entity() const {
  check(*this);
  const auto& [zero, quarter, along] = core::frame_about(to - from);
  const Entity solid =
      core::placed(upright_thread(diameter / pitch, glm::length(to - from) / pitch, left),
                   pitch * zero, pitch * quarter, pitch * along, from);
  return material ? solid.with_material(*material) : solid;
}

}  // namespace crt
