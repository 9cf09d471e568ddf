// What isolated solids and the tree for few objects save changes no answer.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/intersect/accelerator.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261122;

/// Returns solids of all kinds in a row, each in a box of half the size 1, with a gap between every
/// two.
std::vector<Entity> row_of_solids(double gap, int count) {
  std::vector<Entity> row;
  for (int i = 0; i < count; ++i) {
    const Vec3 center((2 + gap) * i, 0, 0);
    const Entity sphere = Sphere{.center = center, .radius = 1};
    const Entity box = Box{.corner_a = center - Vec3(1), .corner_b = center + Vec3(1)};
    const Entity bite = Sphere{.center = center + Vec3(0, 1, 0), .radius = 0.5};
    const Vec3 up(0, 1, 0);
    switch (i % 7) {
      case 0:
        row.push_back(sphere);
        break;
      case 1:
        row.push_back(box);
        break;
      case 2:
        row.push_back(sphere - bite);
        break;
      case 3:
        row.push_back(box ^ Sphere{.center = center, .radius = 1.2});
        break;
      case 4:
        row.emplace_back(Cylinder{.from = center - up, .to = center + up, .radius = 1});
        break;
      case 5:
        row.emplace_back(Cone{.from = center - up, .to = center + up, .radius = 1, .radius2 = 0});
        break;
      default:
        row.emplace_back(Torus{.center = center, .axis = up, .radius = 0.7, .thickness = 0.3});
    }
  }
  return row;
}

Entity placed(const Entity& entity, double size, const Vec3& place) {
  return entity.transformed(scale(Vec3(size))).transformed(translate(place));
}

/// Returns a ray that continues from a hit: into the solid or out of it, some along its surface.
WorldRay onwards(const PreparedData& data, const WorldRay& ray, const RayHit& hit,
                 Numbers& numbers) {
  const HitPoint point = data.hit_point(ray, hit);
  const Side side = numbers.below(4) == 0 ? Side::outside : Side::inside;
  const Vec3 normal = side == Side::outside ? point.normal : -point.normal;
  Vec3 direction = numbers.direction();
  if (numbers.below(3) == 0) {
    const Vec3 tangent = glm::normalize(glm::cross(normal, direction));
    direction = glm::normalize(tangent + std::pow(10, -numbers.within(1, 18)) * normal);
  }
  if (glm::dot(direction, normal) < 0) direction = -direction;
  WorldRay next{.origin = point.position, .direction = direction};
  next.start = data.start_point(ray, hit, side);
  return next;
}

/// Follows rays from surface to surface in two scenes of the same shapes. Returns how many surfaces
/// they met.
int check_alike(const Scene& first, const Scene& second, double size, const Vec3& place,
                int count) {
  const PreparedData data(first);
  const PreparedData other(second);
  Numbers numbers(seed);
  RayWorkspace work;
  RayWorkspace other_work;
  std::array<RayHit, packet_size> hits;
  int met = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 eye = size * (numbers.point(20) + Vec3(8, 0, 0)) + place;
    const Vec3 target = size * (numbers.point(1) + Vec3(numbers.within(0, 20), 0, 0)) + place;
    WorldRay ray{.origin = eye, .direction = glm::normalize(target - eye)};
    for (int bounce = 0; bounce < 6; ++bounce) {
      const RayHit hit = data.intersect(ray, work);
      REQUIRE(same(hit, other.intersect(ray, other_work)));
      const std::array rays = {ray, ray, ray};
      intersect_as_packet(data, rays, hits, work);
      for (const RayHit& in_packet : std::span(hits).first(rays.size()))
        REQUIRE(same(hit, in_packet));
      intersect_as_packet(other, rays, hits, other_work);
      for (const RayHit& in_packet : std::span(hits).first(rays.size()))
        REQUIRE(same(hit, in_packet));
      REQUIRE(data.occluded(ray, work) == hit.found());
      REQUIRE(other.occluded(ray, other_work) == hit.found());
      if (!hit.found()) break;
      ++met;
      ray = onwards(data, ray, hit, numbers);
    }
  }
  return met;
}

constexpr Material glass{.transparency = 1};
const std::array<Entity, 3> planes = {Plane{.normal = {0, 1, 0}, .position = {0, -1, 0}},
                                      Plane{.normal = {0.1, -1, 0.2}, .position = {0, 3, 0}},
                                      Plane{.normal = {0, 0, 1}, .position = {0, 0, -1 - 1e-7}}};

/// Returns the row, placed, of glass and not of glass.
std::array<Scene, 2> glass_and_opaque(double gap, double size, const Vec3& place,
                                      Precision precision) {
  std::array<Scene, 2> scenes;
  for (const bool is_glass : {true, false}) {
    Scene& scene = scenes[is_glass ? 0 : 1];
    scene.settings.precision = precision;
    for (Entity entity : row_of_solids(gap, 9)) {
      if (is_glass) entity = entity.with_material(glass);
      scene.entities.push_back(placed(entity, size, place));
    }
  }
  return scenes;
}

}  // namespace

TEST_CASE("a ray inside of a solid that keeps apart finds what it would find otherwise") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (const double gap : {-0.1, 0.0, 1e-15, 1e-9, 1e-6, 1e-4, 0.5}) {
      for (const double size : {1.0, 1e-30, 1e30}) {
        for (const double place : {0.0, 1e3, 1e12}) {
          const Vec3 moved = size * place * Vec3(1, -0.7, 0.3);
          const auto [of_glass, opaque] = glass_and_opaque(gap, size, moved, precision);
          CAPTURE(gap);
          CAPTURE(size);
          CAPTURE(place);
          const int rays = precision == Precision::standard ? 300 : 30;
          CHECK(check_alike(of_glass, opaque, size, moved, rays) > rays / 2);
        }
      }
    }
  }
}

TEST_CASE("so do rays side by side that go anywhere, inside of glass spheres and outside") {
  for (const double size : {1.0, 1e-30, 1e30}) {
    for (const double place : {0.0, 1e3, 1e12}) {
      const Vec3 moved = size * place * Vec3(1, -0.7, 0.3);
      std::array<Scene, 2> scenes;
      for (int i = 0; i < 9; ++i) {
        const Sphere sphere{.center = moved + size * Vec3(2.5 * i, 0, 0), .radius = size};
        scenes[0].entities.push_back(Entity(sphere).with_material(glass));
        scenes[1].entities.emplace_back(sphere);
      }
      CHECK(check_alike(scenes[0], scenes[1], size, moved, 300) > 150);

      const PreparedData data(scenes[0]);
      const PreparedData other(scenes[1]);
      Numbers numbers(seed);
      RayWorkspace work;
      RayWorkspace other_work;
      std::vector<WorldRay> rays(packet_size);
      std::array<RayHit, packet_size> hits;
      int exits = 0;
      for (int round = 0; round < 300; ++round) {
        rays.resize(static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
        for (WorldRay& ray : rays) {
          const Vec3 target = moved + size * (numbers.point(1) + Vec3(numbers.within(0, 20), 0, 0));
          const Vec3 eye = moved + size * (numbers.point(20) + Vec3(8, 0, 0));
          ray = {.origin = eye, .direction = glm::normalize(target - eye)};
          const RayHit hit = other.intersect(ray, other_work);
          if (hit.found() && numbers.below(4) != 0) ray = onwards(other, ray, hit, numbers);
          // Rays may start and end anywhere, and be of any length.
          if (numbers.below(4) == 0) ray.t_max = size * numbers.within(0, 4);
          if (numbers.below(8) == 0) ray.t_min = size * numbers.within(0, 2);
          if (numbers.below(4) == 0) ray.direction *= std::pow(2, numbers.within(-3, 3));
        }
        const RayMask all = RayPacket::all(rays.size());
        data.intersect_each(batch_of(rays, all), all, hits, work);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          REQUIRE(same(hits[i], other.intersect(rays[i], other_work)));
          REQUIRE(same(hits[i], data.intersect(rays[i], work)));
          if (hits[i].found() && rays[i].start.leaf == hits[i].leaf) ++exits;
        }
      }
      CHECK(exits > 100);
    }
  }
}

TEST_CASE("so it does where planes touch the solids") {
  for (const Entity& plane : planes) {
    auto [of_glass, opaque] = glass_and_opaque(0.5, 1, Vec3(0), Precision::standard);
    of_glass.entities.push_back(plane);
    opaque.entities.push_back(plane);
    CHECK(check_alike(of_glass, opaque, 1, Vec3(0), 1000) > 1000);
  }
}

TEST_CASE("a ray finds the same among few objects and many") {
  for (const double gap : {-0.1, 0.0, 1e-9, 0.5}) {
    for (const double place : {0.0, 1e3, 1e12}) {
      const Scene few = glass_and_opaque(gap, 1, Vec3(place), Precision::standard)[1];
      Scene many = few;
      for (int i = 0; i < 300; ++i) {
        const Vec3 out_of_sight = Vec3(place) + Vec3(0.01 * i, 1e6, 0);
        many.entities.emplace_back(Sphere{.center = out_of_sight, .radius = 0.001});
      }
      CHECK(check_alike(few, many, 1, Vec3(place), 500) > 500);
    }
  }
}

TEST_CASE("transparent solids keep apart whose boxes do not touch") {
  const auto is_isolated = [](std::vector<Entity> entities) {
    CompiledScene scene = compile(entities);
    const Accelerator accelerator(std::move(scene));
    RayWorkspace work;
    const WorldRay ray{.origin = {0, 0, -9}, .direction = {0, 0, 1}};
    const RayHit hit = accelerator.nearest(ray, work);
    StartPoint start{
        .leaf = hit.leaf, .face = hit.face, .surface = hit.surface, .side = Side::inside};
    const bool enters = accelerator.entered_isolated(start) == 0;
    start.side = Side::outside;
    CHECK(accelerator.entered_isolated(start) == invalid_index);
    return enters;
  };
  const Entity sphere = Entity(Sphere{}).with_material(glass);
  const auto next_to = [](double gap) { return Sphere{.center = {2 + gap, 0, 0}, .radius = 1}; };
  const auto above = [](double gap) {
    return Plane{.normal = {0.6, 0.8, 0}, .position = {0, -2 - gap, 0}};
  };
  CHECK(is_isolated({sphere}));
  CHECK_FALSE(is_isolated({Sphere{}}));
  CHECK(is_isolated({sphere, next_to(0.1)}));
  CHECK(is_isolated({sphere, next_to(1e-4)}));
  CHECK_FALSE(is_isolated({sphere, next_to(1e-9)}));
  CHECK_FALSE(is_isolated({sphere, next_to(-0.1)}));
  CHECK_FALSE(is_isolated({sphere, Sphere{.radius = 0.1}}));
  CHECK_FALSE(is_isolated({sphere, sphere.transformed({.translation = {0, 1e-9, 0}})}));
  CHECK(is_isolated({sphere, sphere}));  // which are one
  CHECK(is_isolated({sphere, above(0)}));
  CHECK_FALSE(is_isolated({sphere, above(-0.5)}));
  CHECK(is_isolated({sphere, Plane{.normal = {0, 1, 0}, .position = {0, -1.1, 0}}}));
  CHECK_FALSE(is_isolated({sphere, Plane{.normal = {0, 1, 0}, .position = {0, -1, 0}}}));
  std::vector<Entity> crowd{sphere};
  for (int i = 0; i < 1000; ++i)
    crowd.emplace_back(
        Sphere{.center = {3.0 * (i % 10 + 1), 3.0 * (i / 100), 3.0 * (i / 10 % 10)}});
  CHECK(is_isolated(crowd));
  crowd.emplace_back(Sphere{.center = {-1, 0, 0}, .radius = 0.5});
  CHECK_FALSE(is_isolated(crowd));
}

TEST_CASE("where all surfaces pass by a box, the same solids hold all of its points") {
  for (const double place : {0.0, 1e3, 1e9}) {
    Scene scene = glass_and_opaque(0.5, 1, Vec3(place), Precision::standard)[0];
    for (const Entity& plane : planes) scene.entities.push_back(placed(plane, 1, Vec3(place)));
    const PreparedData data(scene);
    Numbers numbers(seed);
    RayWorkspace work;
    std::vector<RayHit> exits;
    const auto holders_of = [&](const Vec3& point) {
      data.containing_solids({.origin = point, .direction = numbers.direction()}, exits, work);
      std::vector<std::uint32_t> objects;
      for (const RayHit& exit : exits) objects.push_back(exit.object);
      std::sort(objects.begin(), objects.end());
      return objects;
    };
    int passed_by = 0;
    int in_solids = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3 middle = Vec3(place) + Vec3(numbers.within(-2, 22), 0, 0) + numbers.point(4);
      Bounds box;
      box.include_around(middle, Vec3(std::pow(10, -numbers.within(0, 6))));
      if (!data.all_pass_by(box)) continue;
      ++passed_by;
      const std::vector<std::uint32_t> holders = holders_of(middle);
      in_solids += holders.empty() ? 0 : 1;
      for (unsigned corner = 0; corner < 8; ++corner) {
        const auto end = [&](unsigned axis) {
          return ((corner >> axis & 1u) != 0 ? box.lower : box.upper)[static_cast<int>(axis)];
        };
        REQUIRE(holders_of({end(0), end(1), end(2)}) == holders);
      }
    }
    CHECK(passed_by > 500);
    CHECK(in_solids > 100);
  }
}
