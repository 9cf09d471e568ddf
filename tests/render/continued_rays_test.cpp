// These tests go on from hits as programs do: from points that were computed, with rays that know
// nothing else. crt/query.hpp has the promise.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <crt/implicit_shapes.hpp>
#include <crt/query.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "continued_rays.hpp"
#include "support/numbers.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double u = std::numeric_limits<double>::epsilon() / 2;

/// Goes on from `count` hits on convex solids in all placements. Each way to ask is wrong if it
/// meets something.
void go_on_from(const ConvexSolid& solid, int count, std::uint64_t seed) {
  Numbers numbers(seed);
  for (const Placing& placing : placings(numbers)) {
    RayQueries queries(prepared({solid.entity.transformed(placing.transform)}));
    std::vector<Ray> outwards;
    std::vector<Ray> inwards;
    std::vector<Ray> back;
    std::vector<Ray> between;
    while (outwards.size() < static_cast<std::size_t>(count)) {
      const Ray ray = placing.ray_at(solid, numbers);
      const std::optional<Hit> hit = queries.intersect(ray);
      if (!hit) continue;
      const Vec3 start = ray.origin + hit->t * ray.direction;
      const double length = numbers.size(0.01, 100) * placing.size;
      Vec3 away = numbers.direction();
      if (glm::dot(away, hit->normal) < 0) away = -away;
      outwards.push_back({.origin = start, .direction = length * away});
      inwards.push_back({.origin = start, .direction = ray.direction});
      const Vec3 viewer = start + length * away;
      back.push_back({.origin = viewer, .direction = start - viewer, .t_max = 1});
      if (const std::optional<Hit> behind = queries.intersect(inwards.back())) {
        const Vec3 end = start + behind->t * ray.direction;
        between.push_back({.origin = start, .direction = end - start, .t_max = 1});
      }
    }
    const std::string name = solid.name + ", " + placing.name;
    check_nothing(queries, outwards, name + ": outwards");
    check_nothing(queries, back, name + ": to a point on it");
    check_nothing(queries, between, name + ": between two points on it");
    if (solid.is_closed) check_leaving(queries, inwards, name + ": inwards");
    // Rays that begin later on their line.
    for (Ray& ray : outwards) {
      ray.t_min = numbers.within(-2, 2) * (numbers.below(2) == 0 ? 1 : 1e-3);
      ray.origin = ray.origin - ray.t_min * ray.direction;
    }
    check_nothing(queries, outwards, name + ": outwards from t_min");
  }
}

}  // namespace

TEST_CASE(
    "a ray from a computed point of a convex solid does not meet that again, nor at its end") {
  std::uint64_t seed = 1;
  for (const ConvexSolid& solid : convex_solids()) go_on_from(solid, 40, ++seed);
}

TEST_CASE("the same for many rays" * doctest::skip()) {
  std::uint64_t seed = 1000;
  for (const ConvexSolid& solid : convex_solids()) go_on_from(solid, 20000, ++seed);
}

TEST_CASE("a box that ends at 0.1 does not block what starts on its top") {
  const PreparedScene scene = prepared({Box{.corner_a = {0, 0, 0}, .corner_b = {0.1, 0.1, 0.1}}});
  for (int i = 0; i < 162; ++i) {
    const double x = 0.1 * (i % 9 + 0.5) / 9;
    const Vec3 origin(0.03, 0.3 + 0.01 * i, 0.05);
    const Ray ray{.origin = origin, .direction = Vec3(x, 0.1, 0.04) - origin};
    const std::optional<Hit> hit = intersect(scene, ray);
    REQUIRE(hit);
    const Vec3 start = ray.origin + hit->t * ray.direction;
    CHECK_FALSE(occluded(scene, {.origin = start, .direction = {0, 1, 0}}));
  }
}

TEST_CASE("a film of 100 u behind the start is met") {
  Numbers numbers(5);
  for (int i = 0; i < 2000; ++i) {
    const double place = numbers.below(2) == 0 ? 0 : numbers.size(1, 1e7);
    const double size = numbers.size(1e-6, 1e6);
    const double thickness = 100 * u * (size + place + size);
    const Box film{.corner_a = Vec3(place - size, place - thickness, place - size),
                   .corner_b = Vec3(place + size, place, place + size)};
    const PreparedScene scene = prepared({film});
    const Vec3 target = Vec3(place) + Vec3(numbers.within(-1, 1), 0, numbers.within(-1, 1)) * size;
    const Vec3 origin = Vec3(place) + size * Vec3(0.2, numbers.within(0.5, 2), 0.1);
    Ray ray{.origin = origin, .direction = target - origin};
    const std::optional<Hit> hit = intersect(scene, ray);
    if (!hit) continue;
    CHECK(hit->entering);
    ray.origin = ray.origin + hit->t * ray.direction;
    const std::optional<Hit> behind = intersect(scene, ray);
    REQUIRE(behind);
    CHECK_FALSE(behind->entering);
  }
}

TEST_CASE("walks through plates that are turned and moved end, and miss none") {
  Numbers numbers(9);
  for (int i = 0; i < 60; ++i) {
    Transform turn = rotate_degrees(numbers.point(180));
    turn.translation = numbers.size(1, 1e4) * numbers.direction();
    std::vector<Entity> entities;
    const int plates = 5 + numbers.below(10);
    for (int plate = 0; plate < plates; ++plate) {
      entities.push_back(
          Entity(Box{.corner_a = Vec3(-5, plate, -5), .corner_b = Vec3(5, plate + 0.5, 5)})
              .transformed(turn));
    }
    RayQueries queries(prepared(entities));
    const Placing placing{.name = "", .transform = turn, .size = 1};
    const Vec3 from = placing.to_world(numbers.point(1) + Vec3(0, -2, 0));
    const Vec3 to = placing.to_world(numbers.point(1) + Vec3(0, plates + 1, 0));
    Ray ray{.origin = from, .direction = glm::normalize(to - from)};
    int met = 0;
    while (const std::optional<Hit> hit = queries.intersect(ray)) {
      CHECK(hit->entering == (met % 2 == 0));
      ray.origin = ray.origin + hit->t * ray.direction;
      if (++met > 2 * plates) break;
    }
    CHECK(met == 2 * plates);
  }
}

TEST_CASE("queries agree where t is among the smallest numbers") {
  Numbers numbers(31);
  const std::vector<double> ends = {5e-324, 1e-320, 2.2e-308, 1e-300, 0.0, 1e-200};
  RayQueries queries(prepared({Sphere{}, Box{.corner_a = {1, -1, -1}, .corner_b = {2, 1, 1}}}));
  for (int i = 0; i < 3000; ++i) {
    const auto end = [&] { return ends[static_cast<std::size_t>(numbers.below(6))]; };
    const double length = std::pow(10, numbers.within(-300, 300));
    Ray ray{.origin = numbers.direction(), .direction = length * numbers.direction()};
    if (i % 3 == 0) ray.origin = {1, numbers.within(-1, 1), 0};
    ray.t_max = end();
    ray.t_min = i % 2 == 0 ? -end() : -infinity;
    if (i % 5 == 0) std::swap(ray.t_min, ray.t_max);
    std::vector<Hit> all;
    queries.crossings(ray, all);
    const std::optional<Hit> hit = queries.intersect(ray);
    const FullHit full = queries.trace(ray);
    CHECK(queries.occluded(ray) == !all.empty());
    REQUIRE(hit.has_value() == !all.empty());
    REQUIRE(full.found() == !all.empty());
    for (const Hit& crossing : all) CHECK((crossing.t > ray.t_min && crossing.t < ray.t_max));
    if (hit) CHECK((hit->t == all[0].t && full.t == all[0].t));
  }
}

TEST_CASE(
    "of solids that touch, the one written first is named, at the t that all crossings there "
    "have") {
  for (const bool turned_round : {false, true}) {
    std::vector<Entity> boxes = {Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}},
                                 Box{.corner_a = {1, 0, 0}, .corner_b = {2, 1, 1}}};
    if (turned_round) std::swap(boxes[0], boxes[1]);
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      RayQueries queries(prepared(boxes, precision));
      // From within one of them, where both are crossed at one place.
      const Ray ray{.origin = {0.5, 0.3, 0.4}, .direction = {1, 0.1, 0.05}};
      std::vector<Hit> all;
      queries.crossings(ray, all);
      REQUIRE(all.size() == 3);
      CHECK(all[0].t == all[1].t);
      CHECK_FALSE(all[0].entering);
      CHECK(all[1].entering);
      const std::optional<Hit> hit = queries.intersect(ray);
      REQUIRE(hit);
      CHECK(hit->entity_id == 0);
      CHECK(hit->t == all[0].t);
      CHECK(queries.trace(ray).entity_id == 0);
      double t = 0;
      std::uint32_t id = 9;
      queries.distances(std::span(&ray, 1), std::span(&t, 1), std::span(&id, 1));
      CHECK(id == 0);
    }
  }
}
