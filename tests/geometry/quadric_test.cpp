#include "core/geometry/quadric/quadric.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "geometry/quadrics.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject any_quadric(Random& random) {
  return subject_of(random_quadric(random));
}
Subject any_ellipsoid(Random& random) {
  return subject_of(random_ellipsoid(random));
}

struct Found {
  core::CrossingList list;
  bool starts_inside = false;
};

Found crossings_of(const Quadric& quadric, const core::ObjectRay& ray) {
  Found result;
  result.starts_inside = core::make_shape(quadric)->crossings(ray, result.list);
  return result;
}

/// Returns the quadric times a number, which is the same set for a power of two.
Quadric times(Quadric quadric, double factor) {
  quadric.squares *= factor;
  quadric.products *= factor;
  quadric.linear *= factor;
  quadric.constant *= factor;
  return quadric;
}

std::vector<Hit> hits_of(const Entity& entity, Precision precision, const core::ObjectRay& ray) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  return crossings(prepare(scene), {.origin = ray.origin, .direction = ray.direction});
}

const Quadric saddle{
    .squares = {0, 0, 0}, .products = {1, 0, 0}, .linear = {0, 0, -1}, .constant = 0};
const Quadric waist{.squares = {1, 1, -1}, .constant = -1};
const Quadric double_cone{.squares = {1, 1, -1}, .constant = 0};

}  // namespace

TEST_CASE("quadric: crossings are the true ones within their error") {
  check_against_oracle(any_quadric, 100000);
}
TEST_CASE("quadric: powers of two scale it to the bit") {
  check_scaling(any_quadric, 2000);
}
TEST_CASE("quadric: a ray turned round meets the same points") {
  check_reversal(any_quadric, 20000);
}
TEST_CASE("quadric: points, normals and (u, v)") {
  check_surface_points(any_ellipsoid, 5000, false);
  check_surface_points(any_quadric, 10000, false);
}
TEST_CASE("quadric: a ray that starts on it obeys its side") {
  check_starts(any_ellipsoid, 50000, true);
  check_starts(any_quadric, 50000, false);
}

TEST_CASE("quadric: a ray parallel to the axis of a paraboloid meets it once") {
  const Quadric bowl{.squares = {1, 1, 0}, .linear = {0, 0, -1}, .constant = 0};
  const Found up = crossings_of(bowl, {.origin = {1, 2, -3}, .direction = {0, 0, 2}});
  REQUIRE(up.list.size() == 1);
  CHECK(up.list[0].t == 4);
  CHECK(up.list[0].entering);
  CHECK_FALSE(up.starts_inside);
  const Found down = crossings_of(bowl, {.origin = {1, 2, -3}, .direction = {0, 0, -2}});
  REQUIRE(down.list.size() == 1);
  CHECK(down.list[0].t == -4);
  CHECK_FALSE(down.list[0].entering);
  CHECK(down.starts_inside);
}

TEST_CASE("quadric: straight lines on a surface do not meet it, and those next to them do") {
  for (const double far : {0.0, 1.0, 1e6}) {
    const Vec3 along(0, 1, 1);
    const Found on =
        crossings_of(waist, {.origin = Vec3(1, 0, 0) - far * along, .direction = along});
    CHECK(on.list.empty());
    CHECK_FALSE(on.starts_inside);
    CHECK(crossings_of(saddle, {.origin = {-far, 0, 0}, .direction = {1, 0, 0}}).list.empty());
  }
  const Found above = crossings_of(saddle, {.origin = {3, 0, 0x1p-40}, .direction = {1, 0, 0}});
  CHECK(above.list.empty());
  CHECK(above.starts_inside);
  const Found beside = crossings_of(waist, {.origin = {1 - 0x1p-40, 0, 0}, .direction = {0, 1, 1}});
  CHECK(beside.list.empty());
  CHECK(beside.starts_inside);
}

TEST_CASE("quadric: a line through the apex of a cone is on one side of it") {
  for (const double far : {0.0, 3.0, 1e9}) {
    const Vec3 across(2, 1, 1);
    const Found out = crossings_of(double_cone, {.origin = -far * across, .direction = across});
    CHECK(out.list.empty());
    CHECK_FALSE(out.starts_inside);
    const Vec3 within(1, 1, 2);
    const Found in = crossings_of(double_cone, {.origin = -far * within, .direction = within});
    CHECK(in.list.empty());
    CHECK(in.starts_inside);
  }
  const Found both = crossings_of(double_cone, {.origin = {1, 0, -5}, .direction = {0, 0, 1}});
  REQUIRE(both.list.size() == 2);
  CHECK(both.starts_inside);
  CHECK(both.list[0].t == 4);
  CHECK_FALSE(both.list[0].entering);
  CHECK(both.list[1].t == 6);
  CHECK(both.list[1].entering);
}

TEST_CASE("quadric: two planes are the solid between them, or one that meets itself in a line") {
  const Quadric slab{.squares = {1, 0, 0}, .linear = {2, 0, 0}, .constant = -3};
  const Found through = crossings_of(slab, {.origin = {-5, 1, 1}, .direction = {1, 1, 0}});
  REQUIRE(through.list.size() == 2);
  CHECK(through.list[0].t == 2);
  CHECK(through.list[1].t == 6);
  CHECK(crossings_of(slab, {.origin = {0, 1, 1}, .direction = {0, 1, 3}}).starts_inside);
  CHECK_FALSE(crossings_of(slab, {.origin = {1, 1, 1}, .direction = {0, 1, 3}}).starts_inside);
  const Quadric wedges{.squares = {0, 0, 0}, .products = {1, 0, 0}, .constant = 0};
  CHECK(crossings_of(wedges, {.origin = {-1, 1, 0}, .direction = {1, -1, 7}}).list.empty());
  CHECK(crossings_of(wedges, {.origin = {-1, 1, 0}, .direction = {1, -1, 7}}).starts_inside);
  CHECK(crossings_of(wedges, {.origin = {-1, 2, 0}, .direction = {1, -1, 7}}).list.size() == 2);
  // What is between two planes that all but coincide, far from the origin and slanted, is thin.
  const Quadric sheet{.squares = {1, 4, 9},
                      .products = {4, 6, 12},
                      .linear = {-1024, -2048, -3072},
                      .constant = 262144 - 0x1p-30};
  const Found thin = crossings_of(sheet, {.origin = {0, 0, 0}, .direction = {1, 0, 0}});
  REQUIRE(thin.list.size() == 2);
  CHECK(thin.list[0].t == 512 - 0x1p-15);
  CHECK(thin.list[1].t == 512 + 0x1p-15);
}

TEST_CASE("quadric: a plane has the crossings of a Plane") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 normal = random.direction();
    const double offset = std::floor(random.uniform(-8, 8));
    const core::ObjectRay ray{.origin = 4.0 * random.in_cube(), .direction = random.direction()};
    const Found found =
        crossings_of({.squares = {0, 0, 0}, .linear = normal, .constant = -offset}, ray);
    const RealRay real(ray);
    const Real rate = dot(RealVec(normal), real.direction);
    if (rate == 0) {
      CHECK(found.list.empty());
      continue;
    }
    const Real t = (Real{offset} - dot(RealVec(normal), real.origin)) / rate;
    REQUIRE(found.list.size() == 1);
    REQUIRE(magnitude(t - found.list[0].t) <= found.list[0].error);
    REQUIRE(found.list[0].entering == (rate < 0));
    REQUIRE(found.starts_inside == (rate > 0));
  }
}

TEST_CASE("quadric: coefficients that all but cancel far from the origin keep their meaning") {
  // This is the sphere of radius 1 about (2^26, 0, 0), whose numbers need all 53 bits.
  const double at = 0x1p26;
  const Quadric sphere{.linear = {-2 * at, 0, 0}, .constant = at * at - 1};
  const Found found = crossings_of(sphere, {.origin = {0, 0.6, 0}, .direction = {1, 0, 0}});
  REQUIRE(found.list.size() == 2);
  CHECK(std::abs(found.list[0].t - (at - 0.8)) <= 0x1p-27);
  CHECK(std::abs(found.list[1].t - (at + 0.8)) <= 0x1p-27);
  const core::Bounds bounds = core::make_shape(sphere)->bounds();
  CHECK(bounds.lower.x <= at - 1);
  CHECK(bounds.lower.x >= at - 1 - 1e-6);
  CHECK(bounds.upper.z >= 1);
  CHECK(bounds.upper.z <= 1 + 1e-6);
}

TEST_CASE("quadric: the box of an ellipsoid is tight, and all others are infinite") {
  const Quadric axes{.squares = {1, 0.25, 0.0625}, .linear = {-6, 0, 0}, .constant = 8};
  const core::Bounds bounds = core::make_shape(axes)->bounds();
  const Vec3 lower(2, -2, -4);
  const Vec3 upper(4, 2, 4);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(bounds.lower[axis] <= lower[axis]);
    CHECK(bounds.lower[axis] >= lower[axis] - 1e-13);
    CHECK(bounds.upper[axis] >= upper[axis]);
    CHECK(bounds.upper[axis] <= upper[axis] + 1e-13);
  }
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const PlacedQuadric placed = random_ellipsoid(random);
    const auto shape = core::make_shape(placed.quadric);
    REQUIRE(shape->bounds().finite());
    REQUIRE(shape->is_convex());
    // A plane across an axis beside the box misses the ellipsoid, and one a little within does not:
    // f is lowest on it where its gradient is along the axis.
    for (int axis = 0; axis < 3; ++axis) {
      const auto lowest_at = [&](double place) {
        const Vec3 e[] = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
        RealVec p(placed.center);
        p[axis] = place;
        const int first = (axis + 1) % 3;
        const int second = (axis + 2) % 3;
        // These are steps of Newton's method in the plane, which is exact for a quadratic.
        for (int step = 0; step < 2; ++step) {
          const QuadricTerms u(placed.quadric, p, RealVec(e[first]));
          const QuadricTerms v(placed.quadric, p, RealVec(e[second]));
          const QuadricTerms both(placed.quadric, p, RealVec(e[first] + e[second]));
          const Real mixed = (both.a - u.a - v.a) / 2;
          const Real divisor = u.a * v.a - mixed * mixed;
          p[first] = p[first] - (u.b * v.a - v.b * mixed) / divisor;
          p[second] = p[second] - (v.b * u.a - u.b * mixed) / divisor;
        }
        return QuadricTerms(placed.quadric, p, RealVec()).c;
      };
      const double inset = 1e-9 * placed.size;
      REQUIRE(lowest_at(shape->bounds().upper[axis]) >= 0);
      REQUIRE(lowest_at(shape->bounds().lower[axis]) >= 0);
      REQUIRE(lowest_at(shape->bounds().upper[axis] - inset) < 0);
      REQUIRE(lowest_at(shape->bounds().lower[axis] + inset) < 0);
    }
  }
  for (const Quadric& infinite : {saddle, waist, double_cone, Quadric{.squares = {1, 1, 0}}}) {
    CHECK_FALSE(core::make_shape(infinite)->bounds().finite());
  }
  CHECK(core::make_shape(Quadric{.squares = {1, 1, 0}})->is_convex());
  CHECK_FALSE(core::make_shape(waist)->is_convex());
  CHECK_FALSE(core::make_shape(saddle)->is_convex());
}

TEST_CASE("quadric: the same but for a power of two or the sign is the same surface") {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Quadric quadric = random_quadric(random).quadric;
    const Entity solid(quadric);
    const Entity other = Entity(times(quadric, 0x1p37)).with_id(1);
    const Entity complement = Entity(times(quadric, -0.125)).with_id(2);
    const core::ObjectRay ray{.origin = 3.0 * random.in_cube(), .direction = random.direction()};
    for (const Precision precision : {Precision::standard, Precision::exact}) {
      CHECK(hits_of(solid - other, precision, ray).empty());
      CHECK(hits_of(solid ^ complement, precision, ray).empty());
      CHECK(hits_of(solid + complement, precision, ray).empty());
      const std::vector<Hit> expected = hits_of(solid, precision, ray);
      const std::vector<Hit> hits = hits_of(solid - complement, precision, ray);
      REQUIRE(hits.size() == expected.size());
      for (std::size_t k = 0; k < hits.size(); ++k) CHECK(hits[k].t == expected[k].t);
    }
  }
  const auto surface = [](const Quadric& quadric) { return core::make_shape(quadric)->surface(0); };
  CHECK(surface(waist).sizes == surface(times(waist, -4)).sizes);
  CHECK(surface(waist).is_hollow != surface(times(waist, -4)).is_hollow);
  CHECK(surface(waist).sizes != surface(double_cone).sizes);
  CHECK(surface({.constant = -4}).sizes != surface({.constant = -1}).sizes);
}

TEST_CASE("quadric: extreme coefficients give finite answers") {
  const Quadric needle{.squares = {1, 1e200, 1e200}, .constant = -1};
  const Found along = crossings_of(needle, {.origin = {0, 0, 0}, .direction = {1, 0, 0}});
  REQUIRE(along.list.size() == 2);
  CHECK(along.list[1].t == 1);
  const Quadric huge{.squares = {1e-200, 1e-200, 1e-200}, .constant = -0.5};
  CHECK(crossings_of(huge, {.origin = {0, 0, 0}, .direction = {1, 2, 3}}).list.size() == 2);
  const Quadric tiny{.squares = {1e190, 1e190, 1e190}, .constant = -1e-10};
  CHECK(crossings_of(tiny, {.origin = {0, 0, -1e-99}, .direction = {0, 0, 1e-200}}).list.size() ==
        2);
  CHECK(crossings_of(tiny, {.origin = {0, 1, -1}, .direction = {0, 0, 1}}).list.empty());
}

TEST_CASE("quadric: u is the angle about y, and v is y") {
  const Quadric cylinder{.squares = {1, 0, 1}};
  const auto shape = core::make_shape(cylinder);
  const core::ObjectRay ray{.origin = {5, 3, 0}, .direction = {-1, 0, 0}};
  const Found found = crossings_of(cylinder, ray);
  REQUIRE(found.list.size() == 2);
  const core::SurfacePoint point = shape->surface_point(ray, found.list[0]);
  CHECK(point.position == Vec3(1, 3, 0));
  CHECK(point.normal == Vec3(1, 0, 0));
  CHECK(point.u == 0.25);
  CHECK(point.v == 3);
}
