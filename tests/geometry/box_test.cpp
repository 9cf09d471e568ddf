#include "core/geometry/box/box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "crt/error.hpp"
#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Subject random_box(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const Vec3 a = center + size * random.in_cube();
  const Vec3 b = center + size * random.in_cube();
  const RealVec low(glm::min(a, b));
  const RealVec high(glm::max(a, b));
  return {.primitive = Box{.corner_a = a, .corner_b = b},
          .center = center,
          .size = size,
          .candidates =
              [=](const RealRay& ray) {
                std::vector<Real> result;
                for (int axis = 0; axis < 3; ++axis) {
                  if (ray.direction[axis] == 0) continue;
                  result.push_back((low[axis] - ray.origin[axis]) / ray.direction[axis]);
                  result.push_back((high[axis] - ray.origin[axis]) / ray.direction[axis]);
                }
                return result;
              },
          .field =
              [=](const RealVec& p) {
                Real result = low.x - p.x;
                for (int axis = 0; axis < 3; ++axis) {
                  result = std::max({result, low[axis] - p[axis], p[axis] - high[axis]});
                }
                return result;
              }};
}

core::CrossingList crossings(const Box& box, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(box)->crossings(ray, result);
  return result;
}

/// Returns one of each primitive that has a flat face, far from its edge, at height y.
std::vector<Primitive> faces_across_y(double y) {
  constexpr double wide = 1e9;
  std::vector<Primitive> result;
  result.emplace_back(Plane{.normal = {0, -0.7, 0}, .position = {3, y, -8}});
  result.emplace_back(Box{.corner_a = {-wide, y, -wide}, .corner_b = {wide, y + 5, wide}});
  result.emplace_back(HalfPlane{.normal = {0, 3, 0}, .position = {-wide, y, 0}});
  result.emplace_back(Disc{.center = {0.1, y, 0.2}, .normal = {0, 1, 0}, .radius = wide});
  result.emplace_back(Cylinder{.from = {0.3, y, 0}, .to = {0.3, y - 2, 0}, .radius = wide});
  result.emplace_back(
      Cone{.from = {0.3, y, 0}, .to = {0.3, y + 2, 0}, .radius = wide, .radius2 = wide / 2});
  result.emplace_back(
      Triangle{.a = {-wide, y, -wide}, .b = {3 * wide, y, -wide}, .c = {-wide, y, 3 * wide}});
  return result;
}

}  // namespace

TEST_CASE("box: crossings are the true ones within their error") {
  check_against_oracle(random_box, 100000);
}
TEST_CASE("box: powers of two scale it to the bit") {
  check_scaling(random_box, 2000);
}
TEST_CASE("box: a ray turned round meets the same points") {
  check_reversal(random_box, 20000);
}
TEST_CASE("box: points, normals and (u, v)") {
  check_surface_points(random_box, 10000, true);
}
TEST_CASE("box: a ray that starts on it obeys its side") {
  check_starts(random_box, 100000, true);
}

TEST_CASE("box: a ray within the plane of a face does not enter") {
  for (const double x : {-1.0, 1.0}) {
    CHECK(crossings(Box{}, {.origin = {x, 0, -5}, .direction = {0, 0, 1}}).empty());
    CHECK(crossings(Box{}, {.origin = {x, -5, -5}, .direction = {0, 1, 1}}).empty());
    CHECK(crossings(Box{}, {.origin = {x, 0, 0}, .direction = {0, 0, 1}}).empty());
  }
  CHECK(crossings(Box{}, {.origin = {1 - 0x1p-53, 0, -5}, .direction = {0, 0, 1}}).size() == 2);
}

TEST_CASE("box: rays through edges and corners go through once, or only touch") {
  // The first ray goes into an edge and out of the opposite one, the second from corner to corner.
  CHECK(crossings(Box{}, {.origin = {-5, -5, 0.3}, .direction = {1, 1, 0}}).size() == 2);
  const auto diagonal = crossings(Box{}, {.origin = {-3, -3, -3}, .direction = {1, 1, 1}});
  REQUIRE(diagonal.size() == 2);
  CHECK(diagonal[0].t == 2);
  CHECK(diagonal[1].t == 4);
  // These rays pass an edge and a corner.
  CHECK(crossings(Box{}, {.origin = {0, -2, 0.3}, .direction = {1, 1, 0}}).empty());
  CHECK(crossings(Box{}, {.origin = {0, -2, 1}, .direction = {1, 1, 0}}).empty());
}

TEST_CASE("box: a ray along its surface starts inside or outside as it says") {
  // The ray is in the plane of the face at y = 1.
  core::ObjectRay ray{
      .origin = {0, 1, 0}, .direction = {1, 0, 0}, .start = {3, core::Side::outside}};
  CHECK(crossings(Box{}, ray).empty());
  ray.start.side = core::Side::inside;
  const auto within = crossings(Box{}, ray);
  REQUIRE(within.size() == 2);
  CHECK(within[0].t == -1);
  CHECK(within[1].t == 1);
}

TEST_CASE("box: the order of the corners does not matter") {
  const core::ObjectRay ray{.origin = {0.2, 0.1, -4}, .direction = {0.1, -0.05, 1}};
  const auto expected = crossings(Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}}, ray);
  const auto found = crossings(Box{.corner_a = {1, -1, 1}, .corner_b = {-1, 1, -1}}, ray);
  REQUIRE(found.size() == 2);
  CHECK(found[0].t == expected[0].t);
  CHECK(found[1].face == expected[1].face);
}

TEST_CASE("box: directions with components that are nearly zero") {
  CHECK(crossings(Box{}, {.origin = {0, 0, -5}, .direction = {5e-324, -5e-324, 1}}).size() == 2);
  CHECK(crossings(Box{}, {.origin = {1, 0, -5}, .direction = {5e-324, 0, 1}}).empty());
  CHECK(crossings(Box{}, {.origin = {2, 0, -5}, .direction = {1e-310, 0, 1}}).empty());
}

TEST_CASE("box: faces across the axes have the same t in every primitive") {
  Random random(11);
  for (int i = 0; i < 20000; ++i) {
    const double y = random.uniform(-1, 1) * random.power_of_ten(-3, 3);
    const Vec3 target(random.uniform(-1, 1), y, random.uniform(-1, 1));
    const Vec3 direction = random.direction();
    if (direction.y == 0) continue;
    const core::ObjectRay ray{.origin = target - direction * random.power_of_ten(-1, 5),
                              .direction = direction};
    const std::vector<Primitive> primitives = faces_across_y(y);
    core::CrossingList plane;
    core::make_shape(primitives[0])->crossings(ray, plane);
    REQUIRE(plane.size() == 1);
    for (const Primitive& primitive : primitives) {
      core::CrossingList list;
      const auto shape = core::make_shape(primitive);
      shape->crossings(ray, list);
      CAPTURE(primitive.index());
      const auto same = std::find_if(list.begin(), list.end(),
                                     [&](const core::Crossing& c) { return c.t == plane[0].t; });
      REQUIRE(same != list.end());
      REQUIRE(same->root == 0);
      const core::Surface surface = shape->surface(same->face);
      REQUIRE(surface.kind == core::SurfaceKind::plane);
      REQUIRE(core::canonical_axis(surface.direction) == Vec3(0, 1, 0));
      REQUIRE(surface.position == Vec3(0, y, 0));
    }
  }
}

TEST_CASE("box: a ray that starts beside a face, on its plane, enters where it does") {
  // The ray starts on the plane of the top, on its side away from the box and on the other.
  core::ObjectRay ray{.origin = {-3, 1, 0}, .direction = {1, -0.25, 0}};
  ray.start = {.face = 3, .side = core::Side::inside, .on_face = false};
  const auto found = crossings(Box{}, ray);
  REQUIRE(found.size() == 2);
  CHECK(found[0].t == 2);
  CHECK(found[0].face == 0);
  CHECK(found[1].t == 4);
  ray.direction = {1, 0.25, 0};
  ray.start.side = core::Side::outside;
  CHECK(crossings(Box{}, ray).empty());
}

TEST_CASE(
    "a side of a box, or the length of a cylinder or a cone, below 1e-100 is refused with what is "
    "right") {
  const auto message = [](const Primitive& primitive) -> std::string {
    try {
      core::validate(primitive);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::invalid_argument);
      return error.what();
    }
    return {};
  };
  CHECK(message(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 5e-324, 1}}) ==
        "corner_b must differ from corner_a by at least 1e-100 in every coordinate");
  CHECK(message(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, -0.99e-100}}) ==
        "corner_b must differ from corner_a by at least 1e-100 in every coordinate");
  CHECK(message(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 0, 1}}) ==
        "corner_b must differ from corner_a in every coordinate");
  CHECK(message(Box{.corner_a = {0, 0, 0}, .corner_b = {1e-100, 1, -1e-100}}).empty());
  CHECK(message(Cylinder{.from = {0, 0, 0}, .to = {0, 5e-324, 0}}) ==
        "to must differ from from by at least 1e-100");
  CHECK(message(Cone{.from = {0, 0, 0}, .to = {0, 0, 1e-101}}) ==
        "to must differ from from by at least 1e-100");
  CHECK(message(Cone{.from = {0, 0, 0}, .to = {0, 0, 1e-100}}).empty());
}
