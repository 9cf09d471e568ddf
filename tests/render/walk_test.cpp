// These tests walk through scenes by the starts that hits give, in both tiers: nothing is met twice
// or lost, and every walk ends. crt/query.hpp has the promise.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/error.hpp>
#include <crt/query.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "continued_rays.hpp"
#include "support/numbers.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the places that crossings are at. Those at one place have one t.
std::vector<double> places_of(const std::vector<FullHit>& crossings) {
  std::vector<double> places;
  for (const FullHit& crossing : crossings) {
    if (places.empty() || places.back() != crossing.t) places.push_back(crossing.t);
  }
  return places;
}

/// Walks along a line from hit to hit, with the position of each as the next origin.
std::vector<double> walked(RayQueries& queries, Ray ray, std::size_t most) {
  std::vector<double> places;
  const Ray line = ray;
  RayStart start;
  while (places.size() <= most) {
    const FullHit hit = queries.trace(ray, start);
    if (!hit.found()) break;
    places.push_back(glm::dot(hit.position - line.origin, line.direction) /
                     glm::dot(line.direction, line.direction));
    ray.origin = hit.position;
    start = hit.start;
  }
  return places;
}

/// Walks along a line with its origin where it is.
std::vector<double> walked_by_t(RayQueries& queries, Ray ray, std::size_t most) {
  std::vector<double> places;
  RayStart start;
  while (places.size() <= most) {
    const FullHit hit = queries.trace(ray, start);
    if (!hit.found()) break;
    places.push_back(hit.t);
    ray.t_min = hit.t;
    start = hit.start;
  }
  return places;
}

void check_walk(RayQueries& queries, const Ray& ray) {
  std::vector<FullHit> crossings;
  queries.trace_all(ray, {}, crossings);
  const std::vector<double> places = places_of(crossings);
  CHECK(walked_by_t(queries, ray, places.size()) == places);
  const std::vector<double> found = walked(queries, ray, places.size());
  REQUIRE(found.size() == places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    CHECK(found[i] == doctest::Approx(places[i]).epsilon(1e-6));
  }
}

Ray ray_through(Numbers& numbers, double size) {
  const Vec3 from = 3 * size * numbers.direction();
  return {.origin = from, .direction = numbers.point(size) - from};
}

/// Makes a square tile of a floor or wall, as a mesh of facets.
Entity bumpy(Numbers& numbers) {
  std::vector<double> heights(49);
  for (double& height : heights) height = numbers.within(0, 1);
  return HeightField{
      .heights = make_height_grid(heights, 7, 7), .corner_a = {-2, -1, -2}, .corner_b = {2, 1, 2}};
}

}  // namespace

TEST_CASE("a walk by starts meets each place that crossings have: trees whose faces coincide") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    SolidMaker random(11);
    Numbers numbers(12);
    for (int i = 0; i < 60; ++i) {
      std::vector<Entity> entities;
      const int count = 1 + i % 3;
      for (int k = 0; k < count; ++k) entities.push_back(random.tree(2).entity());
      RayQueries queries(prepared(entities, precision));
      for (int k = 0; k < 20; ++k) check_walk(queries, ray_through(numbers, 4));
    }
  }
}

TEST_CASE("a walk by starts meets each place that crossings have: all kinds of solids") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Numbers numbers(13);
    std::vector<Entity> entities = {bumpy(numbers),
                                    Entity(Torus{}).transformed(rotate_degrees(numbers.point(90))),
                                    // Two that share a face with others.
                                    Box{.corner_a = {1, -1, -1}, .corner_b = {2, 1, 1}},
                                    Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}}};
    for (const ConvexSolid& solid : convex_solids()) {
      if (solid.is_closed)
        entities.push_back(solid.entity.transformed(translate(numbers.point(1))));
    }
    RayQueries all(prepared(entities, precision));
    for (int i = 0; i < 200; ++i) check_walk(all, ray_through(numbers, 1.5));
    for (const Entity& entity : entities) {
      RayQueries one(prepared({entity}, precision));
      for (int i = 0; i < 60; ++i) check_walk(one, ray_through(numbers, 1));
    }
  }
}

TEST_CASE("a walk by starts meets each place that crossings have: instances") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Numbers numbers(14);
    const Entity die =
        (Entity(Box{}) - Entity(Sphere{.radius = 1.3})) + Entity(Sphere{.radius = 0.4});
    std::vector<Entity> entities;
    for (int i = 0; i < 40; ++i) {
      entities.push_back(die.transformed(rotate_degrees(numbers.point(180)))
                             .transformed(translate(numbers.point(5))));
    }
    RayQueries queries(prepared(entities, precision));
    for (int i = 0; i < 400; ++i) check_walk(queries, ray_through(numbers, 5));
  }
}

TEST_CASE("light that is mirrored in a closed room never leaves it") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Numbers numbers(15);
    Transform turn = rotate_degrees(numbers.point(180));
    turn.translation = {1e3, -1e2, 30};
    const Entity room =
        (Entity(Box{.corner_a = Vec3(-2), .corner_b = Vec3(2)}) -
         Entity(Box{.corner_a = Vec3(-1.3), .corner_b = Vec3(1.3)})) +
        Entity(Cylinder{.from = {0.3, -1.3, 0.2}, .to = {0.3, 1.3, 0.2}, .radius = 0.3}) +
        Entity(Sphere{.center = {-0.6, -0.7, -0.6}, .radius = 0.6});
    RayQueries queries(prepared({room.transformed(turn)}, precision));
    Ray ray{.origin = Vec3(turn.translation) + Vec3(0.1, 0.2, -0.1),
            .direction = numbers.direction()};
    RayStart start;
    for (int step = 0; step < 20000; ++step) {
      const FullHit hit = queries.trace(ray, start);
      REQUIRE(hit.found());
      REQUIRE(hit.side == HitSide::entering);
      ray.origin = hit.position;
      ray.direction =
          glm::normalize(ray.direction - 2 * glm::dot(ray.direction, hit.normal) * hit.normal);
      start = hit.start;
    }
  }
}

TEST_CASE("between points on the walls of a convex room nothing lies, also not on one wall") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Numbers numbers(16);
    const Transform turn = rotate_degrees(numbers.point(180));
    for (const Entity& hollow :
         {Entity(Box{.corner_a = Vec3(-1, -0.7, -1.3), .corner_b = Vec3(1.2, 1, 1)}),
          Entity(Sphere{.center = {0.1, 0, 0.2}, .radius = 1.4}),
          Entity(Cylinder{.from = {0, -1, 0}, .to = {0, 1.2, 0}, .radius = 1.1})}) {
      const Entity room =
          (Entity(Box{.corner_a = Vec3(-3), .corner_b = Vec3(3)}) - hollow).transformed(turn);
      RayQueries queries(prepared({room}, precision));
      const auto wall_point = [&] {
        return queries.trace({.origin = numbers.point(0.3), .direction = numbers.direction()});
      };
      std::vector<Ray> rays;
      std::vector<RayStart> starts;
      std::vector<RayStart> ends;
      for (int i = 0; i < 500; ++i) {
        const FullHit from = wall_point();
        const FullHit to = wall_point();
        rays.push_back(
            {.origin = from.position, .direction = to.position - from.position, .t_max = 1});
        starts.push_back(from.start);
        ends.push_back(to.start);
        CHECK_FALSE(queries.blocked(rays.back(), starts.back(), ends.back()));
      }
      const std::unique_ptr<bool[]> blocked(new bool[rays.size()]);
      queries.blocked(rays, starts, ends, std::span(blocked.get(), rays.size()));
      CHECK(std::count(blocked.get(), blocked.get() + rays.size(), true) == 0);
    }
  }
}

TEST_CASE("what lies between is found, also on the surface of the end") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    RayQueries queries(prepared(
        {Sphere{.radius = 1}, Box{.corner_a = {-1, -3, -1}, .corner_b = {1, -2, 1}}}, precision));
    const FullHit top = queries.trace({.origin = {0.1, 5, 0.2}, .direction = {0, -1, 0}});
    const FullHit bottom = queries.trace({.origin = {0.1, -1.5, 0.2}, .direction = {0, 1, 0}});
    const FullHit box = queries.trace({.origin = {0.1, -1.5, 0.2}, .direction = {0, -1, 0}});
    const auto between = [&](const FullHit& from, const FullHit& to) {
      return queries.blocked(
          {.origin = from.position, .direction = to.position - from.position, .t_max = 1},
          from.start, to.start);
    };
    CHECK_FALSE(between(bottom, box));
    CHECK_FALSE(between(box, bottom));
    CHECK_FALSE(between(top, bottom));  // through the ball
    CHECK(between(top, box));
    CHECK(between(box, top));
    // From outside to the far side of the ball, whose near side is in between.
    CHECK(queries.blocked(
        {.origin = {0.1, 5, 0.2}, .direction = bottom.position - Vec3(0.1, 5, 0.2), .t_max = 1}, {},
        bottom.start));
  }
}

TEST_CASE("many rays with starts get what each of them gets alone") {
  Numbers numbers(17);
  std::vector<Entity> entities;
  for (int i = 0; i < 100; ++i) {
    const Vec3 center = numbers.point(3);
    const double size = numbers.within(0.1, 0.6);
    entities.push_back(i % 2 == 0 ? Entity(Sphere{.center = center, .radius = size})
                                  : Entity(Box{center - Vec3(size), center + Vec3(size)}));
    entities.back() = entities.back().with_user(1000 + static_cast<std::uint64_t>(i));
  }
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    RayQueries queries(prepared(entities, precision));
    std::vector<Ray> rays;
    for (int i = 0; i < 300; ++i) {
      rays.push_back({.origin = Vec3(-5, 0.01 * i - 1.5, 0.3),
                      .direction = Vec3(1, 0.001 * i, numbers.within(-0.1, 0.1))});
    }
    std::vector<RayStart> starts(rays.size());
    std::vector<FullHit> hits(rays.size());
    for (int step = 0; step < 6; ++step) {
      queries.trace(rays, starts, hits);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const FullHit alone = queries.trace(rays[i], starts[i]);
        CHECK(alone.t == hits[i].t);
        CHECK(alone.position == hits[i].position);
        CHECK(alone.normal == hits[i].normal);
        CHECK(alone.start == hits[i].start);
        CHECK(alone.user == hits[i].user);
        if (!alone.found()) continue;
        CHECK(alone.user == 1000 + alone.entity_id);
        rays[i].origin = hits[i].position;
        starts[i] = hits[i].start;
      }
    }
  }
}

TEST_CASE("a full hit has what the other queries have") {
  Numbers numbers(18);
  const Entity part =
      (Entity(Box{}).with_id(7) - Entity(Sphere{.radius = 1.2}).with_id(8)).with_user(5);
  RayQueries queries(prepared({part.with_id(3), Entity(Sphere{}).with_user(9)}));
  int met = 0;
  for (int i = 0; i < 300; ++i) {
    const Ray ray = ray_through(numbers, 1);
    const FullHit full = queries.trace(ray);
    const std::optional<Hit> hit = queries.intersect(ray);
    HitPart on;
    queries.parts(std::span(&ray, 1), std::span(&on, 1));
    REQUIRE(full.found() == hit.has_value());
    CHECK(full.entity_id == on.entity_id);
    CHECK(full.part_id == on.part_id);
    CHECK(full.face == on.face);
    if (!hit) continue;
    ++met;
    CHECK(full.t == hit->t);
    CHECK(full.position == hit->position);
    CHECK(full.normal == hit->normal);
    CHECK(full.u == hit->u);
    CHECK(full.v == hit->v);
    CHECK((full.side == HitSide::entering) == hit->entering);
    CHECK(full.user == (full.entity_id == 3 ? 5 : 9));
  }
  CHECK(met > 100);
}

TEST_CASE("a start of another scene is refused, whatever is in it") {
  RayQueries queries(prepared({Sphere{}}));
  const PreparedScene other = prepared({Sphere{}, Box{}});
  const Ray ray{.origin = {0, 0, -5}, .direction = {0, 0, 1}};
  const FullHit hit = trace(other, {.origin = {0.9, 0.9, -5}, .direction = {0, 0, 1}});
  REQUIRE(hit.entity_id == 1);
  CHECK_THROWS_AS(queries.trace(ray, hit.start), Error);
  CHECK_THROWS_AS(queries.blocked(ray, {}, hit.start), Error);
  Numbers numbers(19);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    RayStart start;
    for (std::uint64_t& bits : start.bits) {
      bits = (static_cast<std::uint64_t>(numbers.below(1 << 30)) << numbers.below(34)) ^
             static_cast<std::uint64_t>(numbers.below(4));
    }
    try {
      queries.trace(ray, start);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      ++refused;
    }
  }
  CHECK(refused > 1000);
}

TEST_CASE("points are located in the innermost solid, by part and user number") {
  const Entity nut =
      (Entity(Cylinder{.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = 2}).with_id(21).with_user(4) -
       Entity(Cylinder{.from = {0, -2, 0}, .to = {0, 2, 0}, .radius = 1}).with_id(22));
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    RayQueries queries(prepared(
        {Entity(Sphere{.radius = 10}).with_user(1), nut.with_id(2),
         Entity(Box{.corner_a = {1.2, -0.3, -0.3}, .corner_b = {1.6, 0.3, 0.3}}).with_user(6),
         Plane{.normal = {0, 1, 0}, .position = {0, -20, 0}}},
        precision));
    const std::array<Vec3, 6> points = {Vec3(1.5, 0.8, 0), Vec3(0, 0, 0.2), Vec3(1.4, 0, 0),
                                        Vec3(0, -21, 0),   Vec3(0, 15, 0),  Vec3(-1.5, 0.2, 0.1)};
    std::array<Location, 6> found;
    queries.locate(points, found);
    const std::array<std::uint32_t, 6> entities = {2, 0, 2, 3, no_entity_id, 2};
    CHECK(found[0].entity_id == 2);
    CHECK(found[0].part_id == 21);
    CHECK(found[0].user == 4);
    CHECK(found[1].entity_id == 0);
    CHECK(found[1].user == 1);
    CHECK(found[2].user == 6);
    CHECK(found[3].entity_id == 3);
    CHECK(found[4].entity_id == no_entity_id);
    CHECK(found[4].part_id == no_entity_id);
    CHECK(found[5].entity_id == entities[5]);
  }
}

TEST_CASE("a point is located where the crossings of a ray from it say") {
  SolidMaker random(21);
  Numbers numbers(22);
  int inside = 0;
  for (int i = 0; i < 40; ++i) {
    const Entity tree = random.tree(3).entity();
    RayQueries queries(prepared({tree}));
    std::vector<Hit> crossings;
    for (int k = 0; k < 50; ++k) {
      const Vec3 point = numbers.point(4);
      queries.crossings({.origin = point, .direction = numbers.direction()}, crossings);
      Location found;
      queries.locate(std::span(&point, 1), std::span(&found, 1));
      const bool is_inside = !crossings.empty() && !crossings[0].entering;
      if (crossings.empty()) continue;
      CHECK((found.entity_id == 0) == is_inside);
      inside += is_inside;
    }
  }
  CHECK(inside > 100);
}
