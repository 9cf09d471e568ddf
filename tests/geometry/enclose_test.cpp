// What the primitives' enclose() says is certain holds for what their shapes find: where lines
// enter and leave, and what follows for the crossings that count.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/geometry/box/enclose.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/frustum/enclose.hpp"
#include "core/geometry/plane/enclose.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/geometry/torus/enclose.hpp"
#include "core/ray/ray_packet.hpp"
#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

/// Returns a ray towards a solid of about that size around a center. Some are along a coordinate
/// axis, some end within the solid, and some start there.
WorldRay random_ray(Random& random, const Vec3& center, double size) {
  const Vec3 aim = center + 1.5 * size * random.in_cube();
  Vec3 direction = random.direction();
  if (random.one_in(4)) direction = {0, 0, random.one_in(2) ? 1.0 : -1.0};
  const double distance = random.uniform(-1, 6) * size;
  WorldRay ray{.origin = aim - distance * direction, .direction = direction};
  if (random.one_in(3)) ray.t_max = random.uniform(0, 8) * size;
  return ray;
}

/// Counts what is certain of lines.
struct Counts {
  int rejected = 0;
  int accepted = 0;
  int missing = 0;
  int meeting = 0;
};

/// Checks that crossings are where the enclosure of a solid has them. What is NaN says nothing.
void check_enclosed(const CrossingList& crossings, const Enclosure<double>& part) {
  if (crossings.empty()) {
    REQUIRE_FALSE(part.is_met());
    return;
  }
  const Crossing& first = crossings.front();
  const Crossing& last = crossings.back();
  REQUIRE_FALSE(first.t - first.error < part.enter_from);
  REQUIRE_FALSE(last.t + last.error > part.leave_to);
  if (!part.is_met()) return;
  REQUIRE_FALSE(first.t + first.error > part.enter_to);
  REQUIRE_FALSE(last.t - last.error < part.leave_from);
  for (const Crossing& crossing : crossings) {
    REQUIRE_FALSE((crossing.t > part.enter_to && crossing.t < part.leave_from));
  }
}

/// Checks what is decided of the crossings that count.
void check_decision(const CrossingList& crossings, const WorldRay& ray,
                    const Decision<bool>& decision, Counts& counts) {
  bool one_counts = false;
  for (const Crossing& crossing : crossings) {
    one_counts = one_counts || (crossing.t > ray.t_min && crossing.t <= ray.t_max);
  }
  REQUIRE_FALSE((decision.rejected && one_counts));
  REQUIRE_FALSE((decision.accepted && !one_counts));
  ++(one_counts ? counts.meeting : counts.missing);
  counts.rejected += decision.rejected ? 1 : 0;
  counts.accepted += decision.accepted ? 1 : 0;
}

Enclosure<double> lane_of(const Enclosure<Lanes>& part, std::size_t lane) {
  return {part.enter_from[lane], part.enter_to[lane], part.leave_from[lane], part.leave_to[lane]};
}

/// Checks rays, alone and side by side, with a solid's shape in both tiers and what encloses it.
void check_these(const Primitive& primitive, const PlacedSolid& solid,
                 const std::array<WorldRay, lane_count>& rays, Counts& counts) {
  const auto shape = make_shape(primitive);
  const auto exact_shape = make_exact_shape(primitive);
  RayBatch batch;
  for (std::size_t i = 0; i < lane_count; ++i) batch.set(i, rays[i]);
  const PacketStarts starts;
  const RayPacket packet(batch, starts, RayPacket::all(lane_count));
  Enclosure<Lanes> parts;
  const bool some = solid.enclose(packet.groups[0], lanes_with(15), nullptr, parts);
  for (std::size_t i = 0; i < lane_count; ++i) {
    const ObjectRay ray{.origin = rays[i].origin, .direction = rays[i].direction};
    CrossingList crossings;
    shape->crossings(ray, crossings);
    CrossingList exact;
    exact_shape->crossings(
        {.near = ray, .world_origin = ray.origin, .world_direction = ray.direction}, exact);
    const FilterLine<double> line = line_of(rays[i]);
    Enclosure<double> part;
    const bool alone = solid.enclose(line, true, nullptr, part);
    if (!some) REQUIRE_FALSE(alone);
    if (!alone) {
      REQUIRE(crossings.empty());
      REQUIRE(exact.empty());
      if (some) REQUIRE(lane_of(parts, i).is_outside(-1e300, 1e300));
      check_decision(crossings, rays[i], {.rejected = true, .accepted = false}, counts);
      continue;
    }
    check_enclosed(crossings, part);
    check_enclosed(crossings, lane_of(parts, i));
    check_enclosed(exact, part);
    check_decision(crossings, rays[i], decide(part, line, rays[i].t_max, true), counts);
  }
}

/// Checks random rays.
void check_rays(const Primitive& primitive, const PlacedSolid& solid, const Vec3& center,
                double size, Random& random, Counts& counts) {
  std::array<WorldRay, lane_count> rays;
  for (WorldRay& ray : rays) ray = random_ray(random, center, size);
  check_these(primitive, solid, rays, counts);
}

/// Calls check(scale, random, counts) so often, for scales of 36 decades, and returns the counts.
template <class Check>
Counts for_scales(std::uint64_t seed, int times, const Check& check) {
  Random random(seed);
  Counts counts;
  for (int i = 0; i < times; ++i) check(std::exp2(random.uniform(-60, 60)), random, counts);
  return counts;
}

void check_most_are_certain(const Counts& counts) {
  CHECK(counts.missing > 1000);
  CHECK(counts.meeting > 1000);
  CHECK(counts.rejected > counts.missing * 9 / 10);
  CHECK(counts.accepted > counts.meeting * 9 / 10);
}

}  // namespace

TEST_CASE("a sphere is entered and left where its enclosure says") {
  const Counts counts = for_scales(41, 3000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 center = 10 * scale * random.in_cube();
    check_rays(Sphere{.center = center, .radius = scale},
               PlacedSolidOf(EnclosedSphere{center, scale}), center, scale, random, of_rays);
  });
  check_most_are_certain(counts);
}

TEST_CASE("a box is entered and left where its enclosure says") {
  const Counts counts = for_scales(41, 3000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 lower = 10 * scale * random.in_cube();
    const Vec3 upper = lower + scale * Vec3(random.uniform(0.1, 2), random.uniform(0.1, 2), 1);
    check_rays(Box{.corner_a = lower, .corner_b = upper}, PlacedSolidOf(EnclosedBox{lower, upper}),
               0.5 * (lower + upper), scale, random, of_rays);
  });
  check_most_are_certain(counts);
}

namespace {

/// A RoundSolid is a cylinder or a cone, at random: short or long, with an apex or none, along a
/// coordinate axis or not.
struct RoundSolid {
  Vec3 from;
  Vec3 to;
  double from_radius = 0;
  double to_radius = 0;

  RoundSolid(double scale, Random& random) {
    from = scale * random.in_cube();
    if (random.one_in(3)) from *= 1000;
    const double height = scale * std::exp2(random.uniform(-6, 6));
    to = from + height * (random.one_in(2) ? Vec3(0, 0, 1) : random.direction());
    from_radius = scale * std::exp2(random.uniform(-3, 1));
    to_radius = from_radius;
    if (random.one_in(2)) to_radius = random.one_in(2) ? 0 : from_radius * random.uniform(0, 3);
  }

  Primitive primitive() const {
    if (from_radius == to_radius) return Cylinder{.from = from, .to = to, .radius = from_radius};
    return Cone{.from = from, .to = to, .radius = from_radius, .radius2 = to_radius};
  }
  std::unique_ptr<const PlacedSolid> enclosed() const {
    return make_shape(primitive())->placed(Placement());
  }
  Vec3 axis() const { return to - from; }

  /// Returns a vector of length 1 across the axis.
  Vec3 across(Random& random) const {
    while (true) {
      const Vec3 v = random.direction();
      const Vec3 side = v - axis() * (dot(v, axis()) / dot(axis(), axis()));
      if (dot(side, side) > 0.01) return side / std::sqrt(dot(side, side));
    }
  }
  /// Returns a place on the side, or on one of the rims.
  Vec3 on_side(Random& random, const Vec3& across) const {
    const double share = random.one_in(4) ? (random.one_in(2) ? 0 : 1) : random.uniform(0, 1);
    return from + share * axis() + (from_radius + share * (to_radius - from_radius)) * across;
  }
};

/// Returns a ray next to what is hard: along the axis, a cap or a ruling, grazing, or through the
/// rim or the apex.
WorldRay hard_ray(const RoundSolid& solid, Random& random) {
  const double size = std::sqrt(dot(solid.axis(), solid.axis())) + solid.from_radius;
  const Vec3 across = solid.across(random);
  const Vec3 place = solid.on_side(random, across);
  const Vec3 ruling = solid.axis() + (solid.to_radius - solid.from_radius) * across;
  const Vec3 tangent = cross(solid.axis(), across);
  Vec3 aim = place;
  Vec3 direction = random.direction();
  const auto nearly = [&](const Vec3& v) {
    const double tilt = random.one_in(2) ? 0 : std::exp2(random.uniform(-60, -1));
    return v / std::sqrt(dot(v, v)) + tilt * random.direction();
  };
  switch (static_cast<int>(random.uniform(0, 6))) {
    case 0:
      direction = nearly(solid.axis());
      aim += solid.from_radius * random.uniform(-2, 0) * across;
      break;
    case 1:
      direction = nearly(across);
      break;
    case 2:
      direction = nearly(ruling);
      if (random.one_in(2)) aim += std::exp2(random.uniform(-55, 0)) * size * random.direction();
      break;
    case 3:
      direction = nearly(tangent + random.uniform(-1, 1) * ruling);
      break;
    case 4:
      aim = solid.to;
      break;
    default:
      break;
  }
  direction /= std::sqrt(dot(direction, direction));
  if (random.one_in(2)) direction *= random.uniform(0.5, 2);
  const double distance = random.one_in(3) ? 0 : std::exp2(random.uniform(-10, 14)) * size;
  return {.origin = aim - distance * direction, .direction = direction};
}

}  // namespace

TEST_CASE("a cylinder or a cone is entered and left where its enclosure says") {
  const Counts counts = for_scales(46, 8000, [](double scale, Random& random, Counts& of_rays) {
    const RoundSolid solid(scale, random);
    const Vec3 middle = 0.5 * (solid.from + solid.to);
    const double size = std::max(scale, 0.5 * std::sqrt(dot(solid.axis(), solid.axis())));
    check_rays(solid.primitive(), *solid.enclosed(), middle, size, random, of_rays);
  });
  check_most_are_certain(counts);
}

TEST_CASE("what is hard to say of a cylinder or a cone is not said wrongly") {
  const Counts counts = for_scales(47, 100'000, [](double scale, Random& random, Counts& of_rays) {
    const RoundSolid solid(scale, random);
    std::array<WorldRay, lane_count> rays;
    for (WorldRay& ray : rays) ray = hard_ray(solid, random);
    check_these(solid.primitive(), *solid.enclosed(), rays, of_rays);
  });
  CHECK(counts.rejected > counts.missing / 10);
  CHECK(counts.accepted > counts.meeting / 4);
}

TEST_CASE("rays that start into a cylinder or a cone leave it where its enclosure says") {
  int known = 0;
  int all = 0;
  for_scales(48, 100'000, [&](double scale, Random& random, Counts&) {
    const RoundSolid solid(scale, random);
    const auto enclosed = solid.enclosed();
    const auto shape = make_shape(solid.primitive());
    const auto exact_shape = make_exact_shape(solid.primitive());
    const WorldRay first = hard_ray(solid, random);
    CrossingList crossings;
    shape->crossings({.origin = first.origin, .direction = first.direction}, crossings);
    for (const Crossing& hit : crossings) {
      WorldRay ray;
      ray.origin = first.origin + hit.t * first.direction;
      ray.direction = random.one_in(2) ? hard_ray(solid, random).direction : first.direction;
      ray.start.t_error = start_rounding * largest_component(ray.origin);
      const FilterLine<double> line = line_of(ray);
      Enclosure<double> part;
      ++all;
      if (!enclosed->enclose(line, true, nullptr, part) ||
          !enclosed->starts_inwards(hit.face, line))
        continue;
      if (!(part.enter_to <= line.certain_from && part.leave_from > line.certain_from)) continue;
      ++known;
      const ObjectRay start{.origin = ray.origin,
                            .direction = ray.direction,
                            .start = {.face = hit.face, .side = Side::inside}};
      const auto check = [&](const CrossingList& ends) {
        REQUIRE(ends.size() == 2);
        REQUIRE(ends[0].t <= 0);
        REQUIRE(ends[1].t - ends[1].error >= part.leave_from);
        REQUIRE(ends[1].t + ends[1].error <= part.leave_to);
      };
      CrossingList ends;
      shape->crossings(start, ends);
      check(ends);
      ends.clear();
      exact_shape->crossings(
          {.near = start, .world_origin = ray.origin, .world_direction = ray.direction}, ends);
      check(ends);
    }
  });
  CHECK(known > all / 4);
}

TEST_CASE("a half-space is entered or left where its enclosure says") {
  const Counts counts = for_scales(49, 3000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 position = 10 * scale * random.in_cube();
    const Plane plane{.normal = random.direction(), .position = position};
    const auto solid = make_shape(plane)->placed(Placement());
    const WorldRay ray = random_ray(random, position, scale);
    Enclosure<double> part;
    solid->enclose(line_of(ray), true, nullptr, part);
    CrossingList crossings;
    const bool inside =
        make_shape(plane)->crossings({.origin = ray.origin, .direction = ray.direction}, crossings);
    for (const Crossing& crossing : crossings) {
      REQUIRE(inside != crossing.entering);
      REQUIRE_FALSE(crossing.t - crossing.error < (inside ? part.leave_from : part.enter_from));
      REQUIRE_FALSE(crossing.t + crossing.error > (inside ? part.leave_to : part.enter_to));
      ++(part.enter_from <= part.leave_to ? of_rays.accepted : of_rays.rejected);
    }
  });
  CHECK(counts.accepted > 2000);
}

TEST_CASE("a torus is entered and left where its enclosure says") {
  const Counts counts = for_scales(43, 5000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 center = 10 * scale * random.in_cube();
    const double ring = scale * random.uniform(0.5, 1);
    const double tube = ring * (random.one_in(4) ? random.uniform(1, 2) : random.uniform(0.01, 1));
    const Vec3 axis = random.direction();
    const PlacedSolidOf solid(EnclosedTorus{center, axis / std::sqrt(dot(axis, axis)), ring,
                                            tube + 0x1p-30 * (ring + tube)});
    check_rays(Torus{.center = center, .axis = axis, .radius = ring, .thickness = tube}, solid,
               center, ring + tube, random, of_rays);
  });
  CHECK(counts.rejected > counts.missing * 3 / 4);
  CHECK(counts.accepted > counts.meeting / 3);
}

TEST_CASE("a plane is crossed where its enclosure says") {
  const Counts counts = for_scales(44, 3000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 position = 10 * scale * random.in_cube();
    Vec3 normal = random.direction();
    normal /= std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    const auto shape = make_shape(Plane{.normal = normal, .position = position});
    const WorldRay ray = random_ray(random, position, scale);
    const FilterLine<double> line = line_of(ray);
    CrossingList crossings;
    shape->crossings({.origin = ray.origin, .direction = ray.direction}, crossings);
    const EnclosedCrossing<double> enclosed = enclose(EnclosedPlane{position, normal}, line);
    for (const Crossing& crossing : crossings) {
      REQUIRE_FALSE(crossing.t - crossing.error < enclosed.from);
      REQUIRE_FALSE(crossing.t + crossing.error > enclosed.to);
    }
    Enclosure<double> part;
    enclose(EnclosedPlane{position, normal}, line, true, part);
    check_decision(crossings, ray, decide(part, line, ray.t_max, true), of_rays);
  });
  // Lines along the plane are among them, of which nothing is said.
  CHECK(counts.rejected > counts.missing * 3 / 4);
  CHECK(counts.accepted > counts.meeting * 9 / 10);
}

TEST_CASE("only lines that miss an endless cylinder are outside of it") {
  Random random(45);
  int missing = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double scale = std::exp2(random.uniform(-60, 60));
    const Vec3 place = 10 * scale * random.in_cube();
    const WorldRay ray = random_ray(random, place, 2 * scale);
    Enclosure<double> part;
    const EndlessCylinder cylinder{place, {0, 0, 1}, scale};
    const bool is_near = enclose(cylinder, line_of(ray), true, part);
    // Seen along the axis it is a circle.
    const double length = std::hypot(ray.direction.x, ray.direction.y);
    const Vec3 offset = place - ray.origin;
    const double distance =
        length > 0 ? std::abs(offset.x * ray.direction.y - offset.y * ray.direction.x) / length
                   : std::hypot(offset.x, offset.y);
    if (!is_near) REQUIRE(distance > scale);
    if (length > 0 && distance > 1.001 * scale) REQUIRE_FALSE(is_near);
    if (is_near) REQUIRE_FALSE(part.is_outside(-1e300, 1e300));
    missing += is_near ? 0 : 1;
  }
  CHECK(missing > 1000);
}
