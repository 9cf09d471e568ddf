// What saves rays exact tests, such as conservative tests and packets, changes no answer.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/prepare/prepared_data.hpp"
#include "support/crowd.hpp"
#include "support/numbers.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261121;

/// Returns a ray along the surface of a torus or sphere, a little outside or inside.
WorldRay grazing_ray(const Target& target, Numbers& numbers) {
  const Vec3 radial = glm::normalize(glm::cross(target.axis, numbers.direction()));
  const bool is_cylinder = target.half_length > 0;
  const double turn = is_cylinder             ? 0
                      : numbers.below(3) == 0 ? 3.14159265358979
                                              : numbers.within(0, 6.3);
  const Vec3 normal = std::cos(turn) * radial + std::sin(turn) * target.axis;
  const double off = 1 + numbers.size(1e-12, 0.1) * (numbers.below(2) == 0 ? 1 : -1);
  const Vec3 along_cylinder = numbers.within(-1, 1) * target.half_length * target.axis;
  const Vec3 place =
      target.center + along_cylinder + target.ring * radial + off * target.tube * normal;
  const Vec3 along = numbers.below(2) == 0 && turn > 3.14 ? target.axis : numbers.direction();
  const Vec3 tangent = glm::normalize(along - glm::dot(along, normal) * normal);
  return {.origin = place - numbers.size(0.1, 100) * tangent, .direction = tangent};
}

/// Returns rays in nearly the same direction, some of them along the silhouette of what they are
/// aimed at, or from a surface.
std::vector<WorldRay> some_rays(const Crowd& crowd, const PreparedData& data, Numbers& numbers,
                                RayWorkspace& work) {
  const Vec3 eye = numbers.point(numbers.below(4) == 0 ? 1000 : 8);
  const Target& target =
      crowd
          .targets[static_cast<std::size_t>(numbers.below(static_cast<int>(crowd.targets.size())))];
  const double excess = numbers.size(1e-6, 2);
  std::vector<WorldRay> rays(
      static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
  for (WorldRay& ray : rays) {
    const Vec3 offset = target.center - eye;
    const Vec3 across = glm::normalize(glm::cross(offset, numbers.direction()));
    const double off = numbers.below(2) == 0
                           ? 1 + numbers.size(1e-17, 0.1) * (numbers.below(2) == 0 ? 1 : -1)
                           : numbers.within(0, 1 + excess);
    ray.origin = eye;
    ray.direction = glm::normalize(offset + off * target.reach * across);
    const int kind = numbers.below(4);
    if (kind == 2 && target.tube > 0) ray = grazing_ray(target, numbers);
    if (kind == 0) ray.t_max = numbers.within(0, 2) * glm::length(offset);
    if (kind != 1) continue;
    const RayHit hit = data.intersect(ray, work);
    if (!hit.found()) continue;
    const Side side = numbers.below(2) == 0 ? Side::outside : Side::inside;
    const HitPoint point = data.hit_point(ray, hit);
    const StartPoint start = data.start_point(ray, hit, side);
    ray.origin = point.position;
    ray.direction = numbers.direction();
    if ((glm::dot(ray.direction, point.normal) > 0) != (side == Side::outside))
      ray.direction = -ray.direction;
    ray.start = start;
  }
  return rays;
}

/// Checks packets in crowds of so many at most.
void check_packets(Precision precision, int packets, std::size_t largest = 1000) {
  Numbers numbers(seed);
  for (int round = 0; round < 4; ++round) {
    Crowd crowd = ::crowd(numbers, precision);
    keep(crowd, largest, numbers);
    const PreparedData data(crowd.scene);
    RayWorkspace work;
    std::vector<RayHit> line;
    std::array<RayHit, packet_size> hits;
    int met = 0;
    for (int i = 0; i < packets; ++i) {
      std::vector<WorldRay> rays = some_rays(crowd, data, numbers, work);
      intersect_as_packet(data, rays, hits, work);
      for (std::size_t k = 0; k < rays.size(); ++k) {
        const RayHit alone = data.intersect(rays[k], work);
        REQUIRE(same(alone, hits[k]));
        // The crossings are found without any conservative test.
        data.crossings(rays[k], line, work);
        REQUIRE(alone.found() == !line.empty());
        if (!alone.found()) continue;
        ++met;
        REQUIRE((alone.has_coincident ||
                 (alone.t == line.front().t && alone.leaf == line.front().leaf)));
      }
      for (WorldRay& ray : rays) {
        if (std::isfinite(ray.t_max)) ray.end_error = 1e-14;
      }
      const RayMask hidden = occluded_as_packet(data, rays, work);
      for (std::size_t k = 0; k < rays.size(); ++k) {
        data.crossings(rays[k], line, work);
        REQUIRE(data.occluded(rays[k], work) == !line.empty());
        REQUIRE(((hidden >> k & 1u) != 0) == !line.empty());
      }
    }
    CHECK(met > packets / 10);
  }
}

}  // namespace

TEST_CASE("a ray finds the same alone, in a packet, and without cheap tests") {
  check_packets(Precision::standard, 5000);
}

TEST_CASE("so it does in the exact tier") {
  check_packets(Precision::exact, 300);
}

TEST_CASE("so it does where there are few objects") {
  for (const std::size_t count : {3u, 14u, 60u, 70u}) {
    check_packets(Precision::standard, 1500, count);
    check_packets(Precision::exact, 100, count);
  }
}

namespace {

/// Returns a ray from anywhere to anywhere. Some are all but along an axis, and some begin behind
/// their origins.
WorldRay ray_anywhere(Numbers& numbers) {
  WorldRay ray{.origin = numbers.point(numbers.below(4) == 0 ? 1e6 : 5),
               .direction = numbers.direction()};
  if (numbers.below(3) == 0) ray.direction = glm::normalize(numbers.point(3) - ray.origin);
  if (numbers.below(5) == 0) ray.direction[numbers.below(3)] = numbers.below(2) == 0 ? 0 : 1e-305;
  if (numbers.below(5) == 0) ray.t_min = numbers.within(-5, 5);
  if (numbers.below(3) == 0) ray.t_max = ray.t_min + numbers.within(0, 10);
  return ray;
}

}  // namespace

TEST_CASE("so it does in a packet of rays that go anywhere") {
  Numbers numbers(seed);
  RayWorkspace work;
  std::array<RayHit, packet_size> hits;
  std::vector<RayHit> line;
  std::size_t met = 0;
  for (int round = 0; round < 20; ++round) {
    Crowd crowd = ::crowd(numbers, Precision::standard);
    keep(crowd, 2 + static_cast<std::size_t>(numbers.below(70)), numbers);
    const PreparedData data(crowd.scene);
    for (int i = 0; i < 300; ++i) {
      std::vector<WorldRay> rays(
          static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
      for (WorldRay& ray : rays) ray = ray_anywhere(numbers);
      const RayMask all = RayPacket::all(rays.size());
      const RayBatch batch = batch_of(rays, all);
      data.intersect_each(batch, all, hits, work);
      const RayMask hidden = data.occluded_each(batch, all, work);
      for (std::size_t k = 0; k < rays.size(); ++k) {
        REQUIRE(same(data.intersect(rays[k], work), hits[k]));
        data.crossings(rays[k], line, work);
        REQUIRE(hits[k].found() == !line.empty());
        REQUIRE(((hidden >> k & 1u) != 0) == !line.empty());
        met += line.empty() ? 0 : 1;
      }
    }
  }
  CHECK(met > 10000);
}

TEST_CASE("so does what starts on surfaces, in whichever lanes") {
  Numbers numbers(seed);
  RayWorkspace work;
  std::array<RayHit, packet_size> hits;
  int free = 0;
  int met = 0;
  for (int round = 0; round < 20; ++round) {
    Crowd crowd = ::crowd(numbers, Precision::standard);
    keep(crowd, 2 + static_cast<std::size_t>(numbers.below(200)), numbers);
    const PreparedData data(crowd.scene);
    for (int i = 0; i < 300; ++i) {
      std::vector<WorldRay> rays(packet_size);
      for (WorldRay& ray : rays) ray = ray_anywhere(numbers);
      const bool alike = numbers.below(2) == 0;
      const Vec3 direction = numbers.direction();
      go_on(data, numbers, work, rays, [&](const HitPoint&, WorldRay& ray) {
        if (alike) ray.direction = direction + 0.1 * numbers.direction();
        if (numbers.below(3) == 0) ray.t_max = numbers.within(0, 10);
        if (std::isfinite(ray.t_max)) ray.end_error = 1e-14;
      });
      const auto some = static_cast<RayMask>(numbers.below(1 << packet_size)) |
                        (numbers.below(2) == 0 ? 0u : RayMask{0xff});
      const RayBatch batch = batch_of(rays, some);
      const RayHit untouched{.t = -1};
      hits.fill(untouched);
      data.intersect_each(batch, some, hits, work);
      for_each_ray(~some & RayPacket::all(packet_size),
                   [&](std::size_t k) { REQUIRE(same(hits[k], untouched)); });
      const PacketStarts starts = data.noted_starts(batch, some);
      const RayMask hidden = data.shadowed_each(batch, starts, some, work);
      REQUIRE(hidden == data.occluded_each(batch, some, work));
      CHECK((hidden & ~some) == 0);
      for_each_ray(some, [&](std::size_t k) {
        REQUIRE(same(hits[k], data.intersect(rays[k], work)));
        const bool is_hidden = data.occluded(rays[k], work);
        REQUIRE(((hidden >> k & 1u) != 0) == is_hidden);
        ++(is_hidden ? met : free);
      });
    }
  }
  CHECK(met > 5000);
  CHECK(free > 5000);
}

TEST_CASE("so it does at lenses however far from the origin they are") {
  Numbers numbers(seed);
  RayWorkspace work;
  std::vector<RayHit> line;
  for (int exponent = 0; exponent <= 44; exponent += 4) {
    const double far = std::ldexp(1.0, exponent);
    const Vec3 center(far, -far, far);
    const Entity lens = Sphere{.center = center - Vec3(0.5, 0, 0), .radius = 1} ^
                        Sphere { .center = center + Vec3(0.5, 0, 0), .radius = 1 };
    const Entity sheet = Disc{.center = center + Vec3(0, 0.5, 0), .normal = {0, 1, 0}, .radius = 4};
    Scene scene;
    scene.entities = {lens, sheet};
    const PreparedData data(scene);
    int hidden = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 d = numbers.direction();
      const WorldRay ray{.origin = center + numbers.point(3) - numbers.size(1e-3, 100) * d,
                         .direction = d};
      const RayHit hit = data.intersect(ray, work);
      data.crossings(ray, line, work);
      REQUIRE(hit.found() == !line.empty());
      if (!hit.found()) continue;
      WorldRay onwards{.origin = data.hit_point(ray, hit).position,
                       .direction = numbers.direction()};
      onwards.start =
          data.start_point(ray, hit, numbers.below(2) == 0 ? Side::outside : Side::inside);
      data.crossings(onwards, line, work);
      REQUIRE(data.occluded(onwards, work) == !line.empty());
      hidden += line.empty() ? 0 : 1;
    }
    CHECK(hidden > 40);
  }
}

namespace {

/// Returns a ray that is difficult for spheres and for planes across an axis.
WorldRay ray_near(const Sphere& sphere, Numbers& numbers) {
  const Vec3 d = numbers.direction();
  const Vec3 across = glm::normalize(glm::cross(d, numbers.direction()));
  const int kind = numbers.below(4);
  const double off = kind == 0   ? numbers.within(0, 1)
                     : kind == 1 ? 1 + numbers.size(1e-17, 1e-3) * (numbers.below(2) == 0 ? 1 : -1)
                     : kind == 2 ? numbers.size(1e-17, 1)
                                 : numbers.within(0, 1.5);
  // Rays start inside, nearby, or so far away that the distance leaves no digits for the sphere.
  const double away = numbers.below(3) == 0 ? numbers.within(0, 1) : numbers.size(1, 1e20);
  WorldRay ray{.origin = sphere.center + sphere.radius * (off * across - away * d), .direction = d};
  if (numbers.below(4) == 0) {
    // Some are all but along the planes, or exactly along them.
    const int axis = numbers.below(3);
    ray.direction[axis] =
        numbers.below(3) == 0 ? 0 : ray.direction[axis] * numbers.size(1e-300, 1e-3);
    if (!(largest_component(ray.direction) > 0)) ray.direction = {0, 0, 1};
    ray.direction = glm::normalize(ray.direction);
  }
  if (numbers.below(4) == 0) ray.t_min = numbers.within(-1, 2) * sphere.radius * away;
  if (numbers.below(4) == 0) ray.t_max = ray.t_min + numbers.within(0, 2) * sphere.radius * away;
  return ray;
}

}  // namespace

TEST_CASE(
    "so it does at spheres and planes of any size, from inside, afar, all but beside, and from "
    "them") {
  Numbers numbers(seed);
  RayWorkspace work;
  int met = 0;
  for (int round = 0; round < 60; ++round) {
    const double scale = numbers.size(1e-90, 1e90);
    const Sphere sphere{.center = scale * numbers.point(numbers.below(2) == 0 ? 1 : 1e6),
                        .radius = scale * numbers.size(1e-3, 1)};
    Scene scene;
    scene.entities = {sphere};
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 normal(0);
      normal[axis] = numbers.below(2) == 0 ? numbers.size(1e-3, 1e3) : -numbers.size(1e-3, 1e3);
      const Vec3 beside = sphere.center + sphere.radius * numbers.point(3);
      if (numbers.below(2) == 0)
        scene.entities.emplace_back(Plane{.normal = normal, .position = beside});
    }
    const PreparedData data(scene);
    for (int i = 0; i < 100; ++i) {
      std::vector<WorldRay> rays(
          static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
      for (WorldRay& ray : rays) ray = ray_near(sphere, numbers);
      check_first_crossings(data, rays, work, met);
      for (WorldRay& ray : rays) {
        const RayHit hit = data.intersect(ray, work);
        if (!hit.found() || numbers.below(4) == 0) continue;
        const Vec3 place = data.hit_point(ray, hit).position;
        ray = {.origin = place,
               .direction = numbers.direction(),
               .start = data.start_point(ray, hit,
                                         numbers.below(2) == 0 ? Side::outside : Side::inside)};
      }
      check_first_crossings(data, rays, work, met);
    }
  }
  CHECK(met > 10000);
}

TEST_CASE("rays travel together that have nearly the same direction") {
  std::vector<WorldRay> rays(6);
  for (WorldRay& ray : rays) ray.direction = {0, 0, 1};
  const RayMask all = RayPacket::all(rays.size());
  const auto together = [&](RayMask some) { return go_together(batch_of(rays, some), some); };
  CHECK(together(all));
  rays[1].direction = {0.1, 0, 3};
  CHECK(together(all));
  rays[4].direction = {0, 0, -1};
  CHECK_FALSE(together(all));
  rays[4].direction = {1, 0, 1};
  CHECK_FALSE(together(all));
  CHECK(together(all & ~0b10000u));
  CHECK_FALSE(together(0b11u));
}
