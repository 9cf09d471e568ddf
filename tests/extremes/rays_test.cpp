// These tests ask rays that start on faces, edges, corners, apexes and centres, and directions of
// any length.
#include <doctest/doctest.h>
#include <crt/error.hpp>

#include <limits>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

RayQueries queries_of(const Entity& entity, Precision precision) {
  Scene scene;
  scene.settings.precision = precision;
  scene.entities = {entity};
  return RayQueries(prepare(scene));
}

std::vector<Hit> crossings_of(RayQueries& queries, const Ray& ray) {
  std::vector<Hit> hits;
  queries.crossings(ray, hits);
  return hits;
}

constexpr Precision both[] = {Precision::standard, Precision::exact};

}  // namespace

TEST_CASE("a ray from a box's face, edge or corner crosses what is ahead of it") {
  for (const Precision precision : both) {
    RayQueries queries = queries_of(Box{}, precision);
    for (int i = 0; i < 27; ++i) {
      const Vec3 start(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
      if (start == Vec3(0)) continue;
      for (int k = 0; k < 125; ++k) {
        const Vec3 direction(k % 5 - 2, k / 5 % 5 - 2, k / 25 - 2);
        if (direction == Vec3(0)) continue;
        // The point just after the start is inside if it is along every axis, and not along a face.
        double leave = std::numeric_limits<double>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
          const double to_face = (direction[axis] < 0 ? -1 : 1) - start[axis];
          if (direction[axis] != 0) leave = std::min(leave, to_face / direction[axis]);
          if (direction[axis] == 0 && std::abs(start[axis]) == 1) leave = 0;
        }
        const std::vector<Hit> hits =
            crossings_of(queries, {.origin = start, .direction = direction});
        CAPTURE(i);
        CAPTURE(k);
        CHECK(hits.size() == (leave > 0 ? 1 : 0));
        if (hits.size() == 1) {
          CHECK(hits[0].t == leave);
          CHECK_FALSE(hits[0].entering);
        }
      }
    }
  }
}

TEST_CASE("a ray from a ball's surface or centre crosses what is ahead of it") {
  for (const Precision precision : both) {
    RayQueries queries = queries_of(Sphere{.center = {1, 2, 3}, .radius = 5}, precision);
    const Vec3 center(1, 2, 3);
    for (const Vec3& out :
         {Vec3(5, 0, 0), Vec3(0, -5, 0), Vec3(3, 4, 0), Vec3(0, 3, -4), Vec3(-4, 0, 3)}) {
      const std::vector<Hit> inwards =
          crossings_of(queries, {.origin = center + out, .direction = -out});
      REQUIRE(inwards.size() == 1);
      CHECK(inwards[0].t == 2);
      CHECK(crossings_of(queries, {.origin = center + out, .direction = out}).empty());
      CHECK(crossings_of(queries, {.origin = center + out,
                                   .direction = Vec3(out.y, -out.x, 0) + Vec3(0, out.z, -out.y)})
                .empty());
      const std::vector<Hit> outwards = crossings_of(queries, {.origin = center, .direction = out});
      REQUIRE(outwards.size() == 1);
      CHECK(outwards[0].t == 1);
      CHECK_FALSE(outwards[0].entering);
    }
  }
}

TEST_CASE("a ray from a cone's apex, axis or rim crosses what is ahead of it") {
  for (const Precision precision : both) {
    // The slope is 45 degrees: the radius is 4 at y = 0, and the apex is at y = 4.
    RayQueries queries =
        queries_of(Cone{.from = {0, 0, 0}, .to = {0, 4, 0}, .radius = 4}, precision);
    const Vec3 apex(0, 4, 0);
    for (const Vec3& down : {Vec3(0, -1, 0), Vec3(0.5, -1, 0), Vec3(0.25, -1, -0.5)}) {
      const std::vector<Hit> hits = crossings_of(queries, {.origin = apex, .direction = down});
      REQUIRE(hits.size() == 1);
      CHECK(hits[0].t == 4);
      CHECK(hits[0].normal == Vec3(0, -1, 0));
      CHECK(crossings_of(queries, {.origin = apex, .direction = -down}).empty());
    }
    for (const Vec3& past : {Vec3(1, 0, 0), Vec3(2, -1, 0), Vec3(1, 1, 1)}) {
      CHECK(crossings_of(queries, {.origin = apex, .direction = past}).empty());
    }
    // This ray goes from a point of the base's edge across its middle, just above and below the
    // base's plane.
    CHECK(crossings_of(queries, {.origin = {4, 0, 0}, .direction = {-1, 0.25, 0}}).size() == 1);
    CHECK(crossings_of(queries, {.origin = {4, 0, 0}, .direction = {-1, -0.25, 0}}).empty());
    CHECK(crossings_of(queries, {.origin = {4, 0, 0}, .direction = {1, 0.25, 0}}).empty());
    // This ray starts within.
    CHECK(crossings_of(queries, {.origin = {0, 2, 0}, .direction = {1, 0, 0}}).at(0).t ==
          doctest::Approx(2));
    CHECK(crossings_of(queries, {.origin = {0, 1, 0}, .direction = {0, 1, 0}}).size() == 1);
  }
}

TEST_CASE("a ray from a cylinder's cap, rim or axis crosses what is ahead of it") {
  for (const Precision precision : both) {
    RayQueries queries =
        queries_of(Cylinder{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 5}, precision);
    CHECK(crossings_of(queries, {.origin = {0, 0, 0}, .direction = {0, 1, 0}}).at(0).t == 2);
    CHECK(crossings_of(queries, {.origin = {3, 2, 1}, .direction = {0, 1, 0}}).empty());
    CHECK(crossings_of(queries, {.origin = {0, 1, 0}, .direction = {1, 0, 0}}).at(0).t == 5);
    CHECK(crossings_of(queries, {.origin = {3, 1, 4}, .direction = {-3, 0, -4}}).size() == 1);
    CHECK(crossings_of(queries, {.origin = {3, 1, 4}, .direction = {3, 0, 4}}).empty());
    CHECK(crossings_of(queries, {.origin = {3, 2, 4}, .direction = {3, 1, 4}}).empty());
    CHECK(crossings_of(queries, {.origin = {3, 2, 4}, .direction = {-3, -0.125, -4}}).size() == 1);
  }
}

TEST_CASE(
    "a ray from a ring's middle crosses nothing along its axis and the ring twice across it") {
  for (const Precision precision : both) {
    RayQueries queries = queries_of(Torus{.radius = 2, .thickness = 0.5}, precision);
    CHECK(crossings_of(queries, {.origin = {0, 0, 0}, .direction = {0, 1, 0}}).empty());
    const std::vector<Hit> hits =
        crossings_of(queries, {.origin = {0, 0, 0}, .direction = {0.6, 0, 0.8}});
    REQUIRE(hits.size() == 2);
    CHECK(hits[0].t == doctest::Approx(1.5).epsilon(1e-15));
    CHECK(hits[1].t == doctest::Approx(2.5).epsilon(1e-15));
    // These rays start on the ring's own middle line.
    CHECK(crossings_of(queries, {.origin = {2, 0, 0}, .direction = {0, 1, 0}}).size() == 1);
    CHECK(crossings_of(queries, {.origin = {2, 0, 0}, .direction = {0, 0, 1}}).size() == 1);
    CHECK(crossings_of(queries, {.origin = {2, 0, 0}, .direction = {-1, 0, 0}}).size() == 3);
  }
}

TEST_CASE("a direction's length changes t by a power of two and nothing else") {
  const std::vector<Entity> entities = {Sphere{},
                                        Box{},
                                        Cylinder{.from = {0, -1, 0}},
                                        Cone{.from = {0, -1, 0}, .radius = 3},
                                        Torus{},
                                        Plane{},
                                        Entity(Box{}) - Entity(Sphere{.radius = 0.9}),
                                        Entity(Sphere{}).transformed(rotate_degrees({10, 20, 30}))};
  const Ray ray{.origin = {0.25, 3, -4}, .direction = {0.1875, -0.75, 1}};
  for (const Precision precision : both) {
    for (const Entity& entity : entities) {
      RayQueries queries = queries_of(entity, precision);
      const std::vector<Hit> expected = crossings_of(queries, ray);
      REQUIRE_FALSE(expected.empty());
      for (int exponent = -1021; exponent <= 1023; exponent += 7) {
        const double factor = std::ldexp(1.0, exponent);
        const std::vector<Hit> hits =
            crossings_of(queries, {.origin = ray.origin, .direction = factor * ray.direction});
        CAPTURE(exponent);
        REQUIRE(hits.size() == expected.size());
        for (std::size_t i = 0; i < hits.size(); ++i) {
          CHECK(hits[i].t == std::ldexp(expected[i].t, -exponent));
          CHECK(hits[i].position == expected[i].position);
          CHECK(hits[i].normal == expected[i].normal);
        }
      }
    }
  }
}

TEST_CASE("directions with tiny, huge and zero components are taken for what they are") {
  constexpr double denormal = std::numeric_limits<double>::denorm_min();
  constexpr double largest = std::numeric_limits<double>::max();
  for (const Precision precision : both) {
    RayQueries ball = queries_of(Sphere{}, precision);
    RayQueries block = queries_of(Box{}, precision);
    RayQueries pillar = queries_of(Cylinder{.from = {0, -1, 0}}, precision);
    for (RayQueries* queries : {&ball, &block, &pillar}) {
      for (const Vec3& direction :
           {Vec3(0, 0, 1), Vec3(denormal, 0, 1), Vec3(-denormal, denormal, 1),
            Vec3(1e-308, -1e-308, 1), Vec3(0, 1, 1e308), Vec3(1e-300, 1e-200, 1e-100),
            Vec3(-0.0, -0.0, largest), Vec3(denormal, 0, largest)}) {
        const std::optional<Hit> hit =
            queries->intersect({.origin = {0, 0, -3}, .direction = direction});
        REQUIRE(hit);
        CHECK(hit->position.z == -1);
        CHECK(std::hypot(hit->position.x, hit->position.y) < 1e-90);
        CHECK(hit->t == doctest::Approx(2 / direction.z).epsilon(1e-15));
        CHECK_FALSE(queries->intersect({.origin = {0, 0, -3}, .direction = -direction}));
      }
      // t would be beyond the largest number, so that there is no hit to report.
      CHECK_FALSE(queries->intersect({.origin = {0, 0, -3}, .direction = {0, 0, denormal}}));
      CHECK_THROWS_AS(queries->intersect({.origin = {0, 0, -3}, .direction = {0, 0, 0}}), Error);
      CHECK_THROWS_AS(queries->intersect({.origin = {0, 0, -3}, .direction = {0, std::nan(""), 1}}),
                      Error);
      CHECK_THROWS_AS(
          queries->intersect(
              {.origin = {0, 0, -3}, .direction = {0, std::numeric_limits<double>::infinity(), 1}}),
          Error);
    }
  }
}
