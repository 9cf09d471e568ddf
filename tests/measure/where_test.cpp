// Where solids are: whether points are in them, and how far they reach.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "crt/error.hpp"
#include "crt/field.hpp"
#include "crt/implicit_shapes.hpp"
#include "crt/measure.hpp"
#include "crt/primitives.hpp"
#include "crt/transform.hpp"
#include "geometry/random.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns where a point is by the definition of a solid: it is on the surface if some points next
/// to it are inside and others are not.
PointSide side_by_definition(const Solid& solid, const Vec3& point) {
  int inside = 0;
  int count = 0;
  const Quad step = Quad(0x1p-60);
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        // No two steps are the same, so that none follows a surface.
        const QuadPoint beside = {point.x + step * (Quad(x) + Quad(0.01) * y + Quad(0.003)),
                                  point.y + step * (Quad(y) + Quad(0.01) * z + Quad(0.005)),
                                  point.z + step * (Quad(z) + Quad(0.01) * x + Quad(0.007))};
        inside += solid.contains(beside) ? 1 : 0;
        ++count;
      }
    }
  }
  if (inside == 0) return PointSide::outside;
  return inside == count ? PointSide::inside : PointSide::on;
}

}  // namespace

TEST_CASE("points are in, out or on, by the definition of solids whose faces coincide") {
  std::size_t on = 0;
  std::size_t touching = 0;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = maker.tree(4);
    std::vector<Vec3> points;
    for (int i = 0; i < 40; ++i)
      points.emplace_back(maker.real(-4, 4), maker.real(-4, 4), maker.real(-4, 4));
    for (int i = 0; i < 40; ++i) points.push_back(maker.grid_point());
    for (int i = 0; i < 40; ++i)
      points.push_back(maker.grid_point() + Vec3(0.5 * maker.integer(0, 1), 0.5, 0));
    std::vector<PointSide> sides(points.size());
    contains(solid.entity(), points, sides);
    for (std::size_t i = 0; i < points.size(); ++i) {
      CAPTURE(points[i].x);
      CAPTURE(points[i].y);
      CAPTURE(points[i].z);
      const PointSide truth = side_by_definition(solid, points[i]);
      // Where surfaces touch, a point is on one that may be none of the solid.
      if (truth != PointSide::on && sides[i] == PointSide::on) {
        ++touching;
      } else {
        CHECK(sides[i] == truth);
      }
      on += sides[i] == PointSide::on ? 1 : 0;
    }
  }
  CHECK(on > 1000);
  CHECK(touching < 20);
}

TEST_CASE("points of ends, sides, edges and corners are on a surface") {
  const Contour corners = {{0, 0}, {2, 0}, {2, 1}, {0, 2}};
  const auto profile = make_profile(std::array{corners});
  const Entity prism = Extrusion{.profile = profile, .from = -1, .to = 1};
  const Entity wedge = Revolution{.profile = profile, .angle = std::numbers::pi / 2};
  const Entity field = HeightField{.heights = make_height_grid({0, 1, 0.5, 1}, 2, 2),
                                   .corner_a = {0, 0, 0},
                                   .corner_b = {2, 2, 2}};
  const Entity cut_ball = Implicit{
      .field = Field::x() * Field::x() + Field::y() * Field::y() + Field::z() * Field::z() - 2.0,
      .lower = Vec3(-1),
      .upper = Vec3(1)};
  const Entity pyramid =
      Mesh{.triangles = mesh_triangles(
               std::array<Vec3, 4>{Vec3(0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, 2)},
               std::array<TriangleIndices, 4>{{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}})};
  const auto check = [](const Entity& solid, std::initializer_list<Vec3> points) {
    for (const Vec3& point : points) {
      CAPTURE(point.x);
      CAPTURE(point.y);
      CAPTURE(point.z);
      CHECK(contains(solid, point) == PointSide::on);
    }
  };
  check(prism, {{1, 0.5, -1}, {1, 0.5, 1}, {0, 1, 0}, {1, 0, 0}, {2, 0.5, 0.5}, {2, 1, 1}});
  check(wedge, {{1, 0, 0}, {1, 0.5, 0}, {2, 0.5, 0}, {0, 0.5, 1}});
  check(field, {{1, 0, 1}, {2, 0.5, 1}, {1, 0.25, 2}, {0, 0, 0}, {0, 0, 1}, {2, 0, 2}, {2, 2, 2}});
  check(cut_ball, {{1, 0, 0}, {0, -1, 0.5}, {1, 1, 0}});
  check(pyramid, {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}, {1, 1, 0}, {0, 0, 2}});
}

TEST_CASE("one point is asked like many, and must be finite") {
  CHECK(contains(Sphere{}, Vec3(0, 0, 0)) == PointSide::inside);
  CHECK(contains(Sphere{}, Vec3(1, 0, 0)) == PointSide::on);
  CHECK(contains(Sphere{}, Vec3(1, 1e-3, 0)) == PointSide::outside);
  CHECK_THROWS_AS(contains(Sphere{}, Vec3(NAN, 0, 0)), Error);
  CHECK_THROWS_AS(contains(Disc{}, Vec3(0, 0, 0)), Error);
}

TEST_CASE("boxes around solids are tight") {
  const auto check = [](const Entity& solid, const Vec3& lower, const Vec3& upper, double size) {
    const BoundingBox box = tight_bounding_box(solid);
    for (int axis = 0; axis < 3; ++axis) {
      CHECK(box.lower[axis] <= lower[axis]);
      CHECK(box.upper[axis] >= upper[axis]);
      CHECK(box.lower[axis] >= lower[axis] - 1e-6 * size);
      CHECK(box.upper[axis] <= upper[axis] + 1e-6 * size);
    }
  };
  Transform turn;
  turn.row_x = {0.6, -0.8, 0};
  turn.row_y = {0.8, 0.6, 0};
  check(Sphere{}, Vec3(-1), Vec3(1), 1);
  check(Entity(Sphere{}).transformed(turn), Vec3(-1) + Vec3(1e-12), Vec3(1) - Vec3(1e-12), 1.4);
  const Entity half =
      Entity(Sphere{}) - Entity(Box{.corner_a = {0, -2, -2}, .corner_b = {2, 2, 2}});
  check(half, {-1, -1, -1}, {0, 1, 1}, 1);
  const double waist = std::sqrt(1 - 0.5625);
  check(Entity(Sphere{}) ^ Entity(Sphere{.center = {1.5, 0, 0}}),
        {0.5, -waist + 1e-12, -waist + 1e-12}, {1, waist - 1e-12, waist - 1e-12}, 1);
  // A corner is cut off, of which the box of what it is cut from knows nothing.
  check(Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}}) -
            Entity(Plane{.normal = {-1, -1, 0}, .position = {0.5, 0.5, 0}}),
        {0, 0, 0}, {1, 1, 1}, 1);
  check(Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}}) ^
            Entity(Plane{.normal = {1, 1, 0}, .position = {0.25, 0.25, 0}}),
        {0, 0, 0}, {0.5, 0.5, 1}, 1);
}

TEST_CASE("no point of a solid is out of the box around it") {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = in_room(maker.tree(4));
    const BoundingBox box = tight_bounding_box(solid.entity(), {.relative_width = 1e-3});
    for (int i = 0; i < 2000; ++i) {
      const Vec3 point(maker.real(-4, 4), maker.real(-4, 4), maker.real(-4, 4));
      if (!solid.contains({point.x, point.y, point.z})) continue;
      for (int axis = 0; axis < 3; ++axis) {
        CHECK(point[axis] >= box.lower[axis]);
        CHECK(point[axis] <= box.upper[axis]);
      }
    }
  }
}

TEST_CASE("what is empty or infinite has such a box") {
  const BoundingBox none = tight_bounding_box(Entity(Sphere{}) - Entity(Sphere{}));
  CHECK(none.lower.x > none.upper.x);
  const BoundingBox below = tight_bounding_box(Plane{});
  CHECK(std::isinf(below.lower.y));
  CHECK(tight_bounding_box(Disc{}).upper.x == bounding_box(Disc{}).upper.x);
}
