// Polyhedra hold what their faces enclose, and hulls what all half-spaces through their points do.
#include "crt/polyhedron.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "crt/measure.hpp"
#include "csg/made_solids.hpp"
#include "geometry/random.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Polyhedron cube() {
  return {
      .points =
          {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
      .faces = {
          {0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
}

/// Returns a prism over a contour that goes around once, in any plane of the three axes.
Polyhedron prism(const std::vector<std::array<double, 2>>& contour, double height, int axis) {
  Polyhedron solid;
  const auto count = static_cast<std::uint32_t>(contour.size());
  std::vector<std::uint32_t> lower;
  std::vector<std::uint32_t> upper;
  for (const double level : {0.0, height}) {
    for (const auto& [s, t] : contour) {
      Vec3 point(0, 0, 0);
      point[axis] = level;
      point[(axis + 1) % 3] = s;
      point[(axis + 2) % 3] = t;
      solid.points.push_back(point);
    }
  }
  for (std::uint32_t i = 0; i < count; ++i) {
    lower.push_back(i);
    upper.push_back(count + i);
    const std::uint32_t next = (i + 1) % count;
    solid.faces.push_back({i, next, count + next, count + i});
  }
  solid.faces.push_back(lower);
  solid.faces.push_back(upper);
  return solid;
}

}  // namespace

TEST_CASE("a polyhedron is what its faces enclose, whichever way these go") {
  check_volume(cube(), 1);
  Polyhedron turned = cube();
  turned.faces[2] = {4, 5, 1, 0};
  check_volume(turned, 1);
  CHECK(contains(Entity(turned), {0.5, 0.25, 0.125}) == PointSide::inside);
  CHECK(contains(Entity(turned), {0.5, 1.25, 0.125}) == PointSide::outside);
}

TEST_CASE("faces that are not convex are what is in them") {
  // Letters have notches, corners on straight edges, and teeth that hide one another.
  const std::vector<std::array<double, 2>> letter_e = {{0, 0}, {3, 0}, {3, 1},  {1, 1}, {1, 2},
                                                       {2, 2}, {2, 3}, {1, 3},  {1, 4}, {3, 4},
                                                       {3, 5}, {0, 5}, {0, 2.5}};
  for (int axis = 0; axis < 3; ++axis) {
    const Entity solid = prism(letter_e, 2, axis);
    check_volume(solid, 2 * (15 - 2 - 1 - 2));
    Vec3 gap(0, 0, 0);
    gap[axis] = 1;
    gap[(axis + 1) % 3] = 2.5;
    gap[(axis + 2) % 3] = 1.5;
    CHECK(contains(solid, gap) == PointSide::outside);
    gap[(axis + 2) % 3] = 0.5;
    CHECK(contains(solid, gap) == PointSide::inside);
  }
  std::vector<std::array<double, 2>> spiral;
  for (int i = 0; i <= 60; ++i)
    spiral.push_back({(2 + 0.05 * i) * std::cos(0.2 * i), (2 + 0.05 * i) * std::sin(0.2 * i)});
  for (int i = 60; i >= 0; --i)
    spiral.push_back({(1.8 + 0.05 * i) * std::cos(0.2 * i), (1.8 + 0.05 * i) * std::sin(0.2 * i)});
  double area = 0;
  for (std::size_t i = 0; i < spiral.size(); ++i) {
    const auto& a = spiral[i];
    const auto& b = spiral[(i + 1) % spiral.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
  }
  check_volume(prism(spiral, 1, 2), std::abs(area));
}

TEST_CASE("what a polyhedron can't be is said with its place") {
  Polyhedron open = cube();
  open.faces.pop_back();
  CHECK(fault_of(open) ==
        "faces must enclose a solid: the edge from point 0 to 3 belongs to 1 of them");
  Polyhedron wrong = cube();
  wrong.faces[1] = {4, 5, 8};
  CHECK(fault_of(wrong) == "faces face 1 has the corner 8, but there are 8 points");
  wrong.faces[1] = {4, 5};
  CHECK(fault_of(wrong) == "faces face 1 must have at least 3 corners");
  wrong.faces[1] = {4, 5, 6, 4};
  CHECK(fault_of(wrong) == "faces face 1 has the corner 4 twice");
  Polyhedron crossed = prism({{0, 0}, {2, 2}, {2, 0}, {0, 1}}, 1, 2);
  CHECK(fault_of(crossed).find("crosses or touches itself") != std::string::npos);
  CHECK(fault_of(Polyhedron{}) == "faces must not be empty");
  Polyhedron far = cube();
  far.points[3].x = std::numeric_limits<double>::infinity();
  CHECK(fault_of(far).find("points") == 0);
}

TEST_CASE("a hull holds its points and is convex, however they lie") {
  Random random(4);
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Vec3> points;
    const bool on_grid = trial % 2 == 0;
    for (int i = 0; i < 60; ++i) {
      Vec3 point = random.in_cube();
      // On a grid most are in planes with others, on lines and at one place.
      if (on_grid) point = glm::floor(2.5 * point);
      points.push_back(point);
    }
    const Entity hull = Hull{.points = points};
    Vec3 middle(0, 0, 0);
    for (const Vec3& point : points) middle += (1.0 / 60) * point;
    const auto inwards = [&](const Vec3& point) { return point + 1e-9 * (middle - point); };
    for (const Vec3& point : points) CHECK(contains(hull, inwards(point)) == PointSide::inside);
    for (int i = 0; i < 60; ++i) {
      // A point between any of them is inside, and one beyond all of them along some way is not.
      const Vec3& a = points[random.bits() % points.size()];
      const Vec3& b = points[random.bits() % points.size()];
      const Vec3& c = points[random.bits() % points.size()];
      const Vec3& d = points[random.bits() % points.size()];
      CHECK(contains(hull, inwards(0.25 * (a + b + c + d))) == PointSide::inside);
      const Vec3 way = glm::normalize(random.direction());
      Vec3 farthest = points[0];
      for (const Vec3& point : points)
        if (glm::dot(point, way) > glm::dot(farthest, way)) farthest = point;
      CHECK(contains(hull, farthest + 1e-9 * way) == PointSide::outside);
    }
  }
  std::vector<Vec3> corners = cube().points;
  corners.push_back({0.5, 0.5, 0.5});
  corners.push_back({0.5, 0.5, 1});
  corners.push_back({0.5, 1, 1});
  check_volume(Hull{.points = corners}, 1);
}

TEST_CASE("what a hull can't be is said") {
  CHECK(fault_of(Hull{.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}}) ==
        "points must not all be in one plane");
  CHECK(fault_of(Hull{}) == "points must not all be in one plane");
  CHECK(fault_of(Hull{.points = std::vector<Vec3>(2000)}).find("the hull has 2000 points") == 0);
}
