// What the primitives' enclose() says is certain holds for what their shapes find: where lines
// enter and leave, and what follows for the crossings that count.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/box/enclose.hpp"
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

/// Checks rays, alone and side by side, with a solid's shape and what encloses it.
template <class Solid>
void check_rays(const Primitive& primitive, const Solid& solid, const Vec3& center, double size,
                Random& random, Counts& counts) {
  const auto shape = make_shape(primitive);
  std::array<WorldRay, lane_count> rays;
  RayBatch batch;
  for (std::size_t i = 0; i < lane_count; ++i) {
    rays[i] = random_ray(random, center, size);
    batch.set(i, rays[i]);
  }
  const PacketStarts starts;
  const RayPacket packet(batch, starts, RayPacket::all(lane_count));
  Enclosure<Lanes> parts;
  const bool some = enclose(solid, packet.groups[0], lanes_with(15), parts);
  for (std::size_t i = 0; i < lane_count; ++i) {
    CrossingList crossings;
    shape->crossings({.origin = rays[i].origin, .direction = rays[i].direction}, crossings);
    const FilterLine<double> line = line_of(rays[i]);
    Enclosure<double> part;
    const bool alone = enclose(solid, line, true, part);
    if (!some) REQUIRE_FALSE(alone);
    if (!alone) {
      REQUIRE(crossings.empty());
      if (some) REQUIRE(lane_of(parts, i).is_outside(-1e300, 1e300));
      check_decision(crossings, rays[i], {.rejected = true, .accepted = false}, counts);
      continue;
    }
    check_enclosed(crossings, part);
    check_enclosed(crossings, lane_of(parts, i));
    check_decision(crossings, rays[i], decide(part, line, rays[i].t_max, true), counts);
  }
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
    check_rays(Sphere{.center = center, .radius = scale}, EnclosedSphere{center, scale}, center,
               scale, random, of_rays);
  });
  check_most_are_certain(counts);
}

TEST_CASE("a box is entered and left where its enclosure says") {
  const Counts counts = for_scales(41, 3000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 lower = 10 * scale * random.in_cube();
    const Vec3 upper = lower + scale * Vec3(random.uniform(0.1, 2), random.uniform(0.1, 2), 1);
    check_rays(Box{.corner_a = lower, .corner_b = upper}, EnclosedBox{lower, upper},
               0.5 * (lower + upper), scale, random, of_rays);
  });
  check_most_are_certain(counts);
}

TEST_CASE("a torus is entered and left where its enclosure says") {
  const Counts counts = for_scales(43, 5000, [](double scale, Random& random, Counts& of_rays) {
    const Vec3 center = 10 * scale * random.in_cube();
    const double ring = scale * random.uniform(0.5, 1);
    const double tube = ring * (random.one_in(4) ? random.uniform(1, 2) : random.uniform(0.01, 1));
    const Vec3 axis = random.direction();
    const EnclosedTorus solid{center, axis / std::sqrt(dot(axis, axis)), ring,
                              tube + 0x1p-30 * (ring + tube)};
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
    check_decision(crossings, ray, decide(enclosed, line, ray.t_max), of_rays);
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
