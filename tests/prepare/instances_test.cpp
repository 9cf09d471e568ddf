// Rays find the same in a scene whose solids share what they are compiled to as in one where each
// is compiled for itself, to the last bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/prepare/prepared_data.hpp"
#include "crt/error.hpp"
#include "crt/query.hpp"
#include "crt/render.hpp"
#include "geometry/meshes.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using crt::test::Numbers;

namespace {

Transform turned(double angle, double scale, const Vec3& to) {
  const double c = scale * std::cos(angle);
  const double s = scale * std::sin(angle);
  return {.row_x = {c, -s, 0}, .row_y = {s, c, 0}, .row_z = {0, 0, scale}, .translation = to};
}

/// Returns a solid of 36 leaves, made anew. Some have been moved, some are cutters, of glass, or
/// have numbers of their own.
Entity make_solid() {
  const SharedMaterial glass{Material{.transparency = 0.75, .refractive_index = 1.5}};
  Entity body = Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}};
  std::vector<Entity> cutters;
  for (int i = 0; i < 16; ++i) {
    const double x = -0.9 + 0.12 * i;
    cutters.emplace_back(Cylinder{.from = {x, -2, 0.5}, .to = {x, 2, 0.5}, .radius = 0.05});
  }
  cutters.push_back(Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}})
                        .transformed(turned(0.25, 1, {0.125, 0.25, 0})));
  body = csg_difference(body, cutters);
  std::vector<Entity> parts{body};
  for (int i = 0; i < 16; ++i) {
    const Transform to = turned(0.4 * i, 0.3, {-1.5 + 0.2 * i, 0, 1});
    Entity part = Entity(Torus{.radius = 0.5, .thickness = 0.2}).transformed(to);
    if (i % 3 == 0) part = part.with_material(glass);
    if (i % 4 == 0) part = part.with_id(static_cast<std::uint32_t>(1000 + i));
    parts.push_back(part);
  }
  parts.emplace_back(Sphere{.center = {0, 0, -1}, .radius = 0.5, .material = glass});
  parts.push_back(Entity(Box{.corner_a = {-1, -1, 1}, .corner_b = {1, 1, 1.25}}).with_id(77));
  return csg_union(parts);
}

/// Returns a ball of triangles, made anew. It is open if it lacks one of them.
Entity make_ball(bool is_open = false) {
  test::Random random(1);
  test::TriangleList ball = test::ball_mesh(random, 6, 0);
  if (is_open) ball.triangles.pop_back();
  return ball.entity();
}

/// Places 961 solids, each of them make(), far enough apart.
template <class Make>
std::vector<Entity> placed(const Make& make) {
  Numbers numbers(7);
  std::vector<Entity> entities;
  for (int x = -15; x <= 15; ++x) {
    for (int y = -15; y <= 15; ++y) {
      Entity solid = make();
      const bool is_plain = x == 0 && y == 0;
      if (!is_plain) {
        solid = solid.transformed(
            turned(numbers.within(0, 6), numbers.within(0.5, 1.5), {5.1 * x, 5.1 * y, 0.1 * x}));
      }
      if (y == 3) solid = solid.transformed({.translation = {0, 0, 1.0 / 3}});
      if (x % 4 == 1) solid = solid.with_id(static_cast<std::uint32_t>(50'000 + y));
      entities.push_back(solid);
    }
  }
  return entities;
}

Scene scene_of(std::vector<Entity> entities, Precision precision) {
  Scene scene;
  scene.entities = std::move(entities);
  scene.entities.emplace_back(Box{.corner_a = {-90, -90, -9}, .corner_b = {90, 90, -2}});
  scene.settings.precision = precision;
  return scene;
}

template <class Make>
Scene shared_scene(Precision precision, const Make& make) {
  const Entity one = make();
  return scene_of(placed([&] { return one; }), precision);
}
Scene shared_scene(Precision precision) {
  return shared_scene(precision, make_solid);
}

Scene scene_of_copies(Precision precision) {
  return scene_of(placed(make_solid), precision);
}

void check_equal(const PreparedData& shared, const PreparedData& copies, const WorldRay& ray,
                 const RayHit& a, const RayHit& b) {
  REQUIRE(a.found() == b.found());
  CHECK(a.t == b.t);
  if (!a.found()) return;
  CHECK(a.t_low == b.t_low);
  CHECK(a.error == b.error);
  CHECK(a.face == b.face);
  CHECK(a.root == b.root);
  CHECK(a.entering == b.entering);
  CHECK(shared.ids(a).entity == copies.ids(b).entity);
  CHECK(shared.ids(a).part == copies.ids(b).part);
  if (!std::isfinite(a.t)) return;
  const HitPoint one = shared.hit_point(ray, a);
  const HitPoint other = copies.hit_point(ray, b);
  CHECK(one.position == other.position);
  CHECK(one.normal == other.normal);
  CHECK(one.object_position == other.object_position);
  CHECK(one.u == other.u);
  CHECK(one.entity_id == other.entity_id);
  CHECK(one.solid == other.solid);
  CHECK(shared.materials()[one.material].description->transparency ==
        copies.materials()[other.material].description->transparency);
}

/// Follows a ray through both scenes, which reflect it and let it pass by turns. Returns how often
/// it met something.
int follow(const PreparedData& shared, const PreparedData& copies, WorldRay ray) {
  RayWorkspace work_of_shared;
  RayWorkspace work_of_copies;
  std::vector<RayHit> all_of_shared;
  std::vector<RayHit> all_of_copies;
  WorldRay twin = ray;
  int met = 0;
  for (int bounce = 0; bounce < 8; ++bounce) {
    shared.crossings(ray, all_of_shared, work_of_shared);
    copies.crossings(twin, all_of_copies, work_of_copies);
    REQUIRE(all_of_shared.size() == all_of_copies.size());
    for (std::size_t i = 0; i < all_of_shared.size(); ++i)
      check_equal(shared, copies, ray, all_of_shared[i], all_of_copies[i]);
    shared.containing_solids(ray, all_of_shared, work_of_shared);
    copies.containing_solids(twin, all_of_copies, work_of_copies);
    REQUIRE(all_of_shared.size() == all_of_copies.size());
    for (std::size_t i = 0; i < all_of_shared.size(); ++i)
      CHECK(all_of_shared[i].t == all_of_copies[i].t);
    CHECK(shared.occluded(ray, work_of_shared) == copies.occluded(twin, work_of_copies));
    const RayHit hit = shared.intersect(ray, work_of_shared);
    const RayHit other = copies.intersect(twin, work_of_copies);
    check_equal(shared, copies, ray, hit, other);
    if (!hit.found()) return met;
    ++met;
    const HitPoint point = shared.hit_point(ray, hit);
    const bool passes = bounce % 3 == 1;
    const Side side = hit.entering != passes ? Side::outside : Side::inside;
    const StartPoint start = shared.start_point(ray, hit, side);
    twin.start = copies.start_point(twin, other, side);
    CHECK(start.t_error == twin.start.t_error);
    ray.start = start;
    ray.origin = twin.origin = point.position;
    if (!passes) ray.direction = glm::normalize(glm::reflect(ray.direction, point.normal));
    twin.direction = ray.direction;
  }
  return met;
}

void check_follows(const Scene& shared, const Scene& copies, int rays, double scale = 1,
                   const Vec3& offset = Vec3(0)) {
  const PreparedData data(shared);
  const PreparedData data_of_copies(copies);
  CHECK(data_of_copies.compiled().instances.empty());
  Numbers numbers(3);
  int met = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from = Vec3(80, 80, 4) * numbers.point(1) + Vec3(0, 0, 3);
    Vec3 direction = numbers.direction();
    if (i % 2 == 0) direction.z = -0.2 * std::abs(direction.z);
    if (i % 7 == 0) direction.y = 0;
    met += follow(data, data_of_copies,
                  {.origin = scale * from + offset, .direction = glm::normalize(direction)});
  }
  CHECK(met > rays);
}

}  // namespace

TEST_CASE("a solid that is placed often is compiled once") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const CompiledScene shared = compile(shared_scene(precision).entities, precision);
    CHECK(shared.instances.size() == 961);
    REQUIRE(shared.prototypes.size() == 1);
    CHECK(shared.prototypes[0].scene->leaves.size() == 36);
    CHECK(shared.leaves.size() == 1);
    CHECK(compile(scene_of_copies(precision).entities, precision).leaves.size() == 961 * 36 + 1);
  }
}

TEST_CASE("rays find the same to the last bit, whether solids share what they are made of or not") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const int rays = precision == Precision::standard ? 3000 : 300;
    check_follows(shared_scene(precision), scene_of_copies(precision), rays);
  }
}

TEST_CASE("rays find the same on small instances far from the origin, and on large ones") {
  struct Place {
    double scale;
    Vec3 offset;
  };
  const Place places[] = {{1, {3e8, -7e8, 1e9}}, {1e-4, {1e3, 0, -1e4}}, {1e9, {1e8, 0, 0}}};
  for (const Place& place : places) {
    const auto moved = [&](Scene scene) {
      for (Entity& entity : scene.entities)
        entity = entity.transformed(turned(0, place.scale, place.offset));
      return scene;
    };
    check_follows(moved(shared_scene(Precision::standard)),
                  moved(scene_of_copies(Precision::standard)), 500, place.scale, place.offset);
  }
}

TEST_CASE("rays find the same on meshes, closed or open, whether these are shared or not") {
  for (const bool is_open : {false, true}) {
    const auto make = [is_open] { return make_ball(is_open); };
    const Scene shared = shared_scene(Precision::standard, make);
    CHECK(compile(shared.entities).instances.size() == 961);
    check_follows(shared, scene_of(placed(make), Precision::standard), 500);
  }
}

TEST_CASE("parts of a union are shared where they are apart, and else are one solid") {
  for (const double step : {5.0, 2.5}) {
    const auto united = [step](const auto& make) {
      std::vector<Entity> parts;
      for (int i = 0; i < 1000; ++i) {
        const Vec3 to(step * (i % 32) - 40, step * (i / 32) - 40, 0);
        parts.push_back(make().transformed(Transform{.translation = to}));
      }
      return scene_of({csg_union(parts)}, Precision::standard);
    };
    const Entity one = make_solid();
    const Scene shared = united([&] { return one; });
    CHECK(compile(shared.entities).instances.size() == (step == 5.0 ? 1000 : 0));
    check_follows(shared, united(make_solid), 500);
  }
}

TEST_CASE("instances touch as copies do") {
  // Bricks of glass fill the ground. Each has a hole and a stud that fits into it.
  const auto make = [] {
    const SharedMaterial glass{Material{.transparency = 0.75, .refractive_index = 1.5}};
    const Entity brick = Box{.corner_a = {0, 0, 0}, .corner_b = {2, 1, 1}, .material = glass};
    const Entity hole = Cylinder{.from = {1, 0.5, 0}, .to = {1, 0.5, 0.5}, .radius = 0.25};
    const Entity stud = Cylinder{.from = {1, 0.5, 1}, .to = {1, 0.5, 1.5}, .radius = 0.25};
    return (brick - hole) + stud.with_material(glass);
  };
  const auto wall = [](const auto& brick) {
    std::vector<Entity> bricks;
    for (int i = 0; i < 16'384; ++i) {
      const Vec3 to(2 * (i % 32) - 32, i / 32 % 32 - 16, i / 1024);
      bricks.push_back(brick().transformed(Transform{.translation = to}));
    }
    return scene_of(bricks, Precision::standard);
  };
  const Entity one = make();
  check_follows(wall([&] { return one; }), wall(make), 500);
}

TEST_CASE("an instance counts as one primitive, and one at the same place is none") {
  const Entity one = make_solid();
  std::vector<Entity> entities = placed([&] { return one; });
  for (std::size_t i = 0; i < 961; ++i) entities.push_back(entities[i]);
  Scene scene;
  scene.entities = entities;
  CHECK(compile(entities).objects.size() == 961);
  CHECK_NOTHROW(prepare(scene, {.max_primitives = 2 * 961 + 36}));
  CHECK_THROWS_AS(prepare(scene, {.max_primitives = 2 * 961 + 35}), Error);
}

TEST_CASE("queries name the instances of a scene that has nothing else") {
  const Entity one = make_ball();
  Scene scene;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const Entity ball = one.transformed(Transform{.translation = {3.0 * i, 0, 0}});
    scene.entities.push_back(i % 2 == 0 ? ball : ball.with_id(1000 + i));
  }
  const PreparedScene prepared = prepare(scene);
  RayQueries queries(prepared);
  std::vector<Ray> rays;
  for (int i = 0; i < 401; ++i)
    rays.push_back({.origin = {3.0 * i, 0.1, -9}, .direction = {0, 0, 1}});
  std::vector<double> distances(rays.size());
  std::vector<std::uint32_t> ids(rays.size());
  std::vector<HitPart> parts(rays.size());
  queries.distances(rays, distances, ids);
  queries.parts(rays, parts);
  for (std::uint32_t i = 0; i < 400; ++i) {
    const std::uint32_t expected = i % 2 == 0 ? i : 1000 + i;
    CHECK(ids[i] == expected);
    CHECK(parts[i].entity_id == expected);
    CHECK(parts[i].part_id == expected);
    CHECK(distances[i] == doctest::Approx(8).epsilon(0.01));
  }
  CHECK(std::isinf(distances[400]));
}

TEST_CASE("rays find the same instances together as alone") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const PreparedData data(shared_scene(precision));
    Numbers numbers(5);
    RayWorkspace work;
    int met = 0;
    const auto some_ray = [&] {
      const Vec3 from = numbers.point(6) + Vec3(10, 10, 4);
      return WorldRay{.origin = from, .direction = numbers.direction()};
    };
    test::check_bounces(data, numbers, precision == Precision::standard ? 300 : 30, some_ray, met);
    CHECK(met > 300);
  }
}

TEST_CASE("pictures of instances are the same as those of copies") {
  const auto picture = [](Scene scene) {
    scene.camera = {.position = {-20, -30, 25}, .pointing = {0, 0, 0}};
    scene.lights = {PointLight{.origin = {-20, -30, 60}}};
    scene.settings.width = 160;
    scene.settings.height = 120;
    scene.settings.supersampling = 2;
    return render(prepare(scene));
  };
  const Image shared = picture(shared_scene(Precision::standard));
  const Image copies = picture(scene_of_copies(Precision::standard));
  CHECK(std::ranges::equal(shared.pixels(), copies.pixels()));
}
