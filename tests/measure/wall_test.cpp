// How thin solids are, and which pieces of lines are in them.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "crt/error.hpp"
#include "crt/measure.hpp"
#include "crt/primitives.hpp"
#include "crt/transform.hpp"
#include "geometry/random.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void check_end(const Interval& end, double truth) {
  const double rounding = 1e-11 * (1 + std::abs(truth));
  CHECK(end.lower <= truth);
  CHECK(end.upper >= truth);
  CHECK(end.width() <= rounding);
}

Entity box(const Vec3& a, const Vec3& b) {
  return Box{.corner_a = a, .corner_b = b};
}
Entity turned(const Vec3& degrees, const Entity& entity) {
  return entity.transformed(rotate_degrees(degrees));
}
Entity moved(const Vec3& by, const Entity& entity) {
  return entity.transformed(translate(by));
}
Entity tube(double outer, double inner) {
  return Entity(Cylinder{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = outer}) -
         Entity(Cylinder{.from = {0, -1, 0}, .to = {0, 2, 0}, .radius = inner});
}

/// Checks that a wall is as thin as is said, and that the chord is in the solid from side to side.
Wall check_wall(const Entity& entity, double truth, double width = 1e-3) {
  const Wall wall = least_wall(entity, {.measure = {.relative_width = width}});
  CHECK(wall.thickness.lower <= truth * (1 + 1e-9));
  CHECK(wall.thickness.upper >= truth * (1 - 1e-9));
  CHECK(wall.thickness.width() <= 1.001 * width * truth);
  const Vec3 way = wall.to - wall.from;
  CHECK(std::abs(glm::length(way) - wall.thickness.upper) <= 1e-9 * truth);
  for (const double share : {1e-6, 0.3, 0.5, 0.7, 1 - 1e-6})
    CHECK(contains(entity, wall.from + share * way) == PointSide::inside);
  for (const double share : {-1e-6, 1 + 1e-6})
    CHECK(contains(entity, wall.from + share * way) == PointSide::outside);
  return wall;
}

}  // namespace

TEST_CASE("a line through a ball is in it between two distances") {
  const std::vector<LinePiece> pieces =
      thickness_along(Sphere{.center = {5, 0, 0}, .radius = 2}, {0, 1, 0}, {7, 0, 0});
  REQUIRE(pieces.size() == 1);
  check_end(pieces[0].from, 5 - std::sqrt(3));
  check_end(pieces[0].to, 5 + std::sqrt(3));
  CHECK(thickness_along(Sphere{}, {0, 1.01, 0}, {1, 0, 0}).empty());
  // What is behind the origin is before it.
  const std::vector<LinePiece> behind = thickness_along(Sphere{}, {3, 0, 0}, {3, 0, 0});
  REQUIRE(behind.size() == 1);
  check_end(behind[0].from, -4);
}

TEST_CASE("a line through a tube is in it twice, and oblique lines are measured along themselves") {
  const std::vector<LinePiece> pieces = thickness_along(tube(2, 1), {-5, 0.5, 0}, {1, 0, 0});
  REQUIRE(pieces.size() == 2);
  check_end(pieces[0].from, 3);
  check_end(pieces[0].to, 4);
  check_end(pieces[1].from, 6);
  check_end(pieces[1].to, 7);
  const std::vector<LinePiece> oblique =
      thickness_along(box({0, 0, 0}, {3, 3, 3}), {-1, -1, -1}, {1, 1, 1});
  REQUIRE(oblique.size() == 1);
  check_end(oblique[0].from, std::sqrt(3));
  check_end(oblique[0].to, 4 * std::sqrt(3));
}

TEST_CASE("parts of a union that touch are one piece, and those apart are two") {
  const Entity stack =
      box({0, 0, 0}, {1, 1, 1}) + box({1, 0, 0}, {2, 1, 1}) + box({2.5, 0, 0}, {3, 1, 1});
  const std::vector<LinePiece> pieces = thickness_along(stack, {-1, 0.3, 0.4}, {1, 0, 0});
  REQUIRE(pieces.size() == 2);
  check_end(pieces[0].from, 1);
  check_end(pieces[0].to, 3);
  check_end(pieces[1].from, 3.5);
  check_end(pieces[1].to, 4);
}

TEST_CASE("a line within a face ends, and says where it may be in the solid") {
  const std::vector<LinePiece> pieces =
      thickness_along(box({0, 0, 0}, {1, 1, 1}), {-1, 1, 0.5}, {1, 0, 0});
  for (const LinePiece& piece : pieces) {
    CHECK(piece.from.lower <= 2);
    CHECK(piece.to.upper >= 1);
    CHECK(piece.from.lower > 0.9);
    CHECK(piece.to.upper < 2.1);
  }
}

TEST_CASE("pieces of lines in trees of solids hold the points that are in them") {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = in_room(maker.tree(3));
    const Vec3 origin(maker.real(-5, 5), maker.real(-5, 5), maker.real(-5, 5));
    const Vec3 direction(maker.real(-1, 1), maker.real(-1, 1), maker.real(-1, 1));
    const Vec3 unit = glm::normalize(direction);
    const std::vector<LinePiece> pieces = thickness_along(solid.entity(), origin, direction);
    for (double distance = -20; distance < 20; distance += 0.0317) {
      const Vec3 point = origin + distance * unit;
      bool is_in = false;
      bool may_be_in = false;
      for (const LinePiece& piece : pieces) {
        is_in = is_in || (piece.from.upper + 1e-9 < distance && distance + 1e-9 < piece.to.lower);
        may_be_in =
            may_be_in || (piece.from.lower - 1e-9 < distance && distance - 1e-9 < piece.to.upper);
      }
      const bool truth = solid.contains({point.x, point.y, point.z});
      CHECK((truth ? may_be_in : !is_in));
    }
  }
}

TEST_CASE("plates, tubes and shells are as thin as formulas say") {
  check_wall(box({0, 0, 0}, {10, 0.5, 20}), 0.5);
  check_wall(turned({20, 30, 40}, box({0, 0, 0}, {10, 0.5, 20})), 0.5);
  check_wall(tube(2, 1.5), 0.5, 2e-3);
  check_wall(Entity(Sphere{.radius = 2}) - Entity(Sphere{.radius = 1.5}), 0.5, 1e-2);
  check_wall(Sphere{.radius = 2}, 4, 1e-2);
  check_wall(Torus{.radius = 3, .thickness = 0.5}, 1, 5e-2);
}

TEST_CASE("the wall beside a bore is found where it is thinnest") {
  const Entity part = box({0, 0, 0}, {10, 4, 10}) -
                      Entity(Cylinder{.from = {2.25, -1, 5}, .to = {2.25, 5, 5}, .radius = 2});
  const Wall wall = check_wall(part, 0.25);
  CHECK(std::min(wall.from.x, wall.to.x) == doctest::Approx(0));
  CHECK(std::max(wall.from.x, wall.to.x) == doctest::Approx(0.25).epsilon(1e-3));
  CHECK(std::abs(wall.from.z - 5) < 0.2);
}

TEST_CASE("the shell of a cone is as thin as it is across its slope") {
  const auto cone = [](double moved) {
    return Entity(Cone{.from = {0, -moved, 0},
                       .to = {0, 2 + moved, 0},
                       .radius = 3 + 0.5 * moved,
                       .radius2 = 2 - 0.5 * moved});
  };
  const auto inner =
      Entity(Cone{.from = {0, -1, 0}, .to = {0, 3, 0}, .radius = 3.2, .radius2 = 1.2});
  // The radii differ by 0.3 in every height, and the slope is 1 in 2.
  check_wall(cone(0) - inner, 0.3 * 2 / std::sqrt(5), 1e-2);
}

TEST_CASE("faces that coincide within a solid are no sides of walls") {
  check_wall(box({0, 0, 0}, {5, 1, 5}) + box({0, 1, 0}, {5, 2, 5}), 2);
  // Each of the two is thinner than what they are together.
  check_wall(box({0, 0, 0}, {5, 1, 5}) + box({0, 0.5, 0}, {5, 1.75, 5}), 1.75);
  // A pocket leaves its bottom.
  check_wall(box({0, 0, 0}, {5, 2, 5}) - box({1, 0.75, 1}, {4, 2, 4}), 0.75);
}

TEST_CASE("gaps and edges are no walls") {
  // The slot is 0.1 wide. What is beside it is 2 wide, and 1 high below it.
  check_wall(box({0, 0, 0}, {4.1, 3, 5}) - box({2, 1, -1}, {2.1, 4, 6}), 1);
  // The ends of the prism are 4 apart, and its sides meet at angles of 45 and 90 degrees.
  const Entity prism = box({0, 0, 0}, {2, 3, 4}) -
                       moved({0, -0.5, 0}, turned({0, 0, 45}, box({0, 0, -1}, {9, 9, 9})));
  check_wall(prism, 4);
}

TEST_CASE("where a fillet or a rounded edge ends, what rounding leaves of a face is no side") {
  const auto rod = [](double radius, const Vec3& middle) {
    return Entity(
        Cylinder{.from = middle - Vec3{0, 0, 9}, .to = middle + Vec3{0, 0, 29}, .radius = radius});
  };
  // The wall is thinnest where the rounding is 5 degrees steep: its own normal goes to the bottom.
  const double steep = std::numbers::pi / 36;
  check_wall(box({0, 0, 0}, {10, 4, 10}) - (box({8, 2, -1}, {11, 5, 11}) - rod(2, {8, 2, 0})),
             4 - 2 * (1 - std::cos(steep)), 1e-2);
  const Entity bracket = box({0, 0, 0}, {60, 14, 20}) + box({0, 0, 0}, {14, 60, 20}) +
                         (box({14, 14, 0}, {20, 20, 20}) - rod(6, {20, 20, 0}));
  check_wall(bracket, 14, 1e-2);
  const double quarter = std::sqrt(2.0) - 1;
  const Contour contour{{.x = 0, .y = 0},
                        {.x = 60, .y = 0},
                        {.x = 60, .y = 14},
                        {.x = 20, .y = 14},
                        {.x = 14, .y = 20, .bulge = -quarter},
                        {.x = 14, .y = 60},
                        {.x = 0, .y = 60}};
  const Entity drawn = Extrusion{.profile = make_profile(std::vector<Contour>{contour}), .to = 20};
  check_wall(drawn, 14, 1e-2);
  check_wall(turned({10, 20, 30}, drawn), 14, 1e-2);
  // A face that is narrow, but no less than a millionth, is a side.
  check_wall(box({0, 0, 0}, {100, 10, 100}) - box({50, 3, -1}, {50.01, 11, 101}), 3);
}

TEST_CASE("the apex of a cone is no wall") {
  const Entity cone = Cone{.from = {5, 1, 5}, .to = {5, 9, 5}, .radius = 3, .radius2 = 0};
  CHECK(least_wall(cone).thickness.lower == infinity);
  check_wall(box({0, 0, 0}, {10, 2, 10}) + cone, 2, 1e-2);
}

TEST_CASE("what narrows by less than the angle is a wall, and by more is none") {
  // The sides are 1 to 2 apart over a length of 10: they meet at 5.7 degrees.
  const double angle = 45 * std::atan(0.1) / std::atan(1.0);
  const Entity wedge = box({0, 0, 0}, {10, 3, 3}) -
                       moved({0, 1, 0}, turned({0, 0, angle}, box({-5, 0, -1}, {20, 9, 9})));
  const Wall thin = least_wall(wedge, {.angle = 10, .measure = {.relative_width = 1e-2}});
  CHECK(thin.thickness.lower <= 1);
  CHECK(thin.thickness.upper >= 0.99);
  CHECK(thin.thickness.upper < 1.02);
  CHECK(least_wall(wedge, {.angle = 2}).thickness.contains(3));
}

TEST_CASE("a solid without parallel sides has no wall, and what is not bounded is refused") {
  // A corner of a box is a tetrahedron.
  const Entity corner =
      box({0, 0, 0}, {1, 1, 1}) ^ Entity(Plane{.normal = {1, 1, 1}, .position = {0.3, 0.3, 0.3}});
  CHECK(volume(corner).upper < 0.2);
  CHECK(least_wall(corner).thickness.lower == infinity);
  CHECK_THROWS_AS(least_wall(Plane{}), Error);
  CHECK_THROWS_AS(least_wall(Disc{}), Error);
  CHECK_THROWS_AS(least_wall(Box{}, {.angle = -1}), Error);
  CHECK_THROWS_AS(least_wall(Box{}, {.measure = {.relative_width = 0}}), Error);
  CHECK_THROWS_AS(thickness_along(Box{}, {0, 0, 0}, {0, 0, 0}), Error);
  CHECK_THROWS_AS(thickness_along(Box{}, {0, 0, std::nan("")}, {0, 0, 1}), Error);
  CHECK(least_wall(empty_entity()).thickness.lower == infinity);
  CHECK(thickness_along(empty_entity(), {0, 0, 0}, {0, 0, 1}).empty());
}
