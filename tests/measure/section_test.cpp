// Sections of solids, against closed forms, and against whether points of a grid are in the solid.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "crt/transform.hpp"
#include "measure/section_checks.hpp"

using namespace crt;
using namespace crt::test;

TEST_CASE("sections of boxes are polygons, and the frame says where they are") {
  const Entity box = Box{.corner_a = {0, 0, 0}, .corner_b = {1, 2, 3}};
  struct Side {
    Vec3 normal;
    double offset;
    double area;
    Vec3 x_axis;
    Vec3 y_axis;
  };
  // The world is left-handed. Whoever looks along z has x to the right and y up.
  const std::vector<Side> sides = {
      {along_z, 1, 2, {-1, 0, 0}, {0, 1, 0}},  {-along_z, -1, 2, {1, 0, 0}, {0, 1, 0}},
      {along_y, 1, 3, {1, 0, 0}, {0, 0, 1}},   {-along_y, -1, 3, {1, 0, 0}, {0, 0, -1}},
      {along_x, 0.5, 6, {0, 0, 1}, {0, 1, 0}}, {-along_x, -0.5, 6, {0, 0, -1}, {0, 1, 0}}};
  for (const Side& side : sides) {
    const Section found = check_known(box, 7.0 * side.normal, side.offset, side.area, 1);
    CHECK(found.frame.normal == side.normal);
    CHECK(found.frame.offset == side.offset);
    CHECK(found.frame.x_axis == side.x_axis);
    CHECK(found.frame.y_axis == side.y_axis);
    REQUIRE(found.contours[0].size() == 4);
    for (const ProfilePoint& corner : found.contours[0]) {
      CHECK(corner.bulge == 0);
      const Vec3 p = found.frame.at(corner.x, corner.y);
      for (int axis = 0; axis < 3; ++axis) {
        if (side.normal[axis] != 0) continue;
        CHECK((p[axis] == 0 || p[axis] == axis + 1));
      }
    }
    CHECK(signed_area(polygon_of(found.contours[0])) == doctest::Approx(side.area));
  }
  CHECK(check_known(box, {1, 1, 1}, 1.5 / std::sqrt(3.0), std::sqrt(3.0), 1).contours[0].size() ==
        4);
}

TEST_CASE("a plane in a face of a solid cuts what is against its normal") {
  const Entity box = Box{.corner_a = {0, 0, 0}, .corner_b = {1, 2, 3}};
  for (const auto& [normal, offset] :
       {std::pair(along_z, 3.0), std::pair(-along_z, 0.0), std::pair(along_x, 1.0)}) {
    const Section top = section(box, normal, offset, 1e-3);
    CHECK(top.contours.size() == 1);
    CHECK(top.deviation <= 1e-3);
    CHECK(top.area.contains(normal.z != 0 ? 2 : 6));
    CHECK(top.frame.offset < offset);
    CHECK(top.frame.offset > offset - 1e-9);
  }
  for (const auto& [normal, offset] :
       {std::pair(along_z, 0.0), std::pair(-along_z, -3.0), std::pair(along_x, 0.0)}) {
    const Section bottom = section(box, normal, offset, 1e-3);
    CHECK(bottom.empty());
    CHECK(bottom.deviation == 0);
    CHECK(bottom.area == Interval{0, 0});
  }
  // Of two that lie on each other, it is the one against the normal.
  const Entity steps = box + Entity(Box{.corner_a = {0, 0, 3}, .corner_b = {4, 4, 4}});
  CHECK(section(steps, along_z, 3, 1e-3).area.contains(2));
  CHECK(section(steps, -along_z, -3, 1e-3).area.contains(16));
  // An edge that lies in the plane is no hindrance either.
  const Entity spindle = Entity(Cone{.from = {0, 0, 0}, .to = {0, 0, 1}, .radius = 2}) +
                         Entity(Cone{.from = {0, 0, 0}, .to = {0, 0, -1}, .radius = 2});
  CHECK(section(spindle, along_z, 0, 1e-3).area.middle() == doctest::Approx(4 * std::numbers::pi));
}

TEST_CASE("sections are those of closed forms") {
  for (const double height : {0.0, 0.5, -0.99}) {
    const double squared = 1 - height * height;
    for (const Vec3& normal : {along_z, Vec3(1, 2, -3)}) {
      const Section found = check_known(Sphere{}, normal, height, std::numbers::pi * squared, 1);
      REQUIRE(found.contours[0].size() == 2);
      CHECK(found.contours[0][0].bulge == 1);
      CHECK(found.contours[0][1].bulge == 1);
      const double radius = 0.5 * (found.contours[0][0].x - found.contours[0][1].x);
      CHECK(radius == doctest::Approx(std::sqrt(squared)).epsilon(1e-12));
    }
  }
  const Entity cylinder = Cylinder{.from = {0, 0, -2}, .to = {0, 0, 2}, .radius = 1};
  check_known(cylinder, along_z, 0.3, std::numbers::pi, 1);
  CHECK(corner_count(check_known(cylinder, along_x, 0, 8, 1)) == 4);
  CHECK(corner_count(check_known(cylinder, along_y, 0.6, 6.4, 1)) == 4);
  check_known(cylinder, {1, 0, 1}, 0, std::numbers::pi * std::sqrt(2.0), 1);  // an ellipse
  const Entity cone = Cone{.from = {0, 0, 0}, .to = {0, 2, 0}};
  check_known(cone, along_y, 0.5, std::numbers::pi * 0.5625, 1);
  CHECK(corner_count(check_known(cone, along_x, 0, 2, 1)) == 3);
  // Where y = 1 - x / 4, seen from above: x^2 + z^2 = (1/2 + x/8)^2, an ellipse.
  constexpr double k = 63.0 / 64;
  const double seen = std::numbers::pi * (0.25 + 1 / (256 * k)) / std::sqrt(k);
  check_known(cone, {0.25, 1, 0}, 1 / std::sqrt(1.0625), seen * std::sqrt(1.0625), 1, 1e-4);
}

TEST_CASE("a torus has rings, ovals and circles") {
  const Torus torus{};
  const double radius = torus.radius;
  const double thickness = torus.thickness;
  for (const double height : {0.0, 0.1, 0.24}) {
    const double half = std::sqrt(thickness * thickness - height * height);
    const Section found =
        check_known(torus, along_y, height, 4 * std::numbers::pi * radius * half, 2);
    CHECK(corner_count(found) == 4);
    CHECK(signed_area(polygon_of(found.contours[0])) > 0);
    CHECK(signed_area(polygon_of(found.contours[1])) < 0);
  }
  check_known(torus, along_x, 0, 2 * std::numbers::pi * thickness * thickness, 2);
  for (const double place : {0.3, 0.74, 0.76, 1.2}) {
    const Section found = section(torus, along_z, place, 1e-3);
    CHECK(found.deviation <= 1e-3);
    CHECK(found.contours.size() == (place < 0.75 ? 2 : 1));
    check_section(torus, found, bounding_box(torus));
  }
  // Villarceau's circles, of the torus's radius, cross each other twice.
  const double sine = thickness / radius;
  const Vec3 normal(-sine, std::sqrt(1 - sine * sine), 0);
  const double apart = thickness / radius;
  const double lens =
      radius * radius * (2 * std::acos(apart) - 2 * apart * std::sqrt(1 - apart * apart));
  const Section found = section(torus, normal, 0, 1e-3);
  CHECK(found.deviation <= 1e-3);
  CHECK(found.area.contains(2 * (std::numbers::pi * radius * radius - lens)));
  CHECK(found.area.width() < 1e-4);
  check_section(torus, found, bounding_box(torus));
}

TEST_CASE("a drilled plate has lines and full circles") {
  const Entity plate = drilled_plate();
  const Section found = check_known(plate, along_y, 6, 6000 - 64 * std::numbers::pi, 5, 1e-2);
  CHECK(found.contours[0].size() == 4);
  for (std::size_t i = 1; i < 5; ++i) {
    const Contour& hole = found.contours[i];
    REQUIRE(hole.size() == 2);
    CHECK(hole[0].bulge == -1);
    CHECK(hole[1].bulge == -1);
    CHECK(0.5 * std::abs(hole[0].x - hole[1].x) == doctest::Approx(4).epsilon(1e-12));
    CHECK(0.5 * std::abs(hole[0].x + hole[1].x) == doctest::Approx(40).epsilon(1e-12));
  }
  CHECK(corner_count(check_known(plate, along_x, 40, 528, 3)) == 12);
  // Its contours are those of a profile.
  const Entity again = Extrusion{.profile = make_profile(found.contours), .from = 0, .to = 1};
  CHECK(volume(again).middle() == doctest::Approx(6000 - 64 * std::numbers::pi).epsilon(1e-6));
  // Turned in any way, it has as many lines and circles.
  const Transform turn = rotate_degrees({17, 31, -59});
  const Vec3 normal(turn.row_x.y, turn.row_y.y, turn.row_z.y);
  const Section turned =
      check_known(plate.transformed(turn), normal, 6, 6000 - 64 * std::numbers::pi, 5, 1e-2);
  CHECK(corner_count(turned) == 12);
}

TEST_CASE("lines and arcs that touch end where they touch") {
  const Entity slot = Entity(Box{.corner_a = {-1, -0.5, -1}, .corner_b = {1, 0.5, 1}}) +
                      Entity(Cylinder{.from = {-1, 0, -1}, .to = {-1, 0, 1}, .radius = 0.5}) +
                      Entity(Cylinder{.from = {1, 0, -1}, .to = {1, 0, 1}, .radius = 0.5});
  for (const Entity& solid :
       {slot, Entity(Capsule{.from = {-1, 0, 0}, .to = {1, 0, 0}, .radius = 0.5})}) {
    const Section found = check_known(solid, -along_z, 0, 2 + std::numbers::pi / 4, 1);
    REQUIRE(found.contours[0].size() == 4);
    for (const ProfilePoint& corner : found.contours[0]) {
      CHECK(std::abs(corner.x) == doctest::Approx(1).epsilon(1e-8));
      CHECK(std::abs(corner.y) == doctest::Approx(0.5).epsilon(1e-8));
      CHECK((corner.bulge == 0 || std::abs(corner.bulge - 1) < 1e-7));
    }
  }
  const Entity rounded = RoundedBox{.corner_a = {0, 0, 0}, .corner_b = {2, 1, 1}, .radius = 0.2};
  const Section found = check_known(rounded, along_z, 0.5, 2 - 0.04 * (4 - std::numbers::pi), 1);
  CHECK(found.contours[0].size() == 8);
}

TEST_CASE("profiles come back from extrusions and revolutions") {
  const Contour contour = {{1, 0}, {3, 0}, {3, 1}, {2, 2, 0.5}, {1, 2}};
  const auto profile = make_profile(std::vector<Contour>{contour});
  const Entity extrusion = Extrusion{.profile = profile, .from = -1, .to = 1};
  const double area = std::abs(signed_area(polygon_of(contour)));
  const Section across = section(extrusion, -along_z, 0.25, 1e-3);
  CHECK(across.contours.size() == 1);
  CHECK(across.contours[0].size() == contour.size());
  CHECK(across.area.middle() == doctest::Approx(area).epsilon(1e-5));
  check_section(extrusion, across, bounding_box(extrusion));

  const Entity revolution = Revolution{.profile = profile};
  const Section through = section(revolution, along_x, 0, 1e-3);
  CHECK(through.contours.size() == 2);
  CHECK(corner_count(through) == 2 * contour.size());
  CHECK(through.area.middle() == doctest::Approx(2 * area).epsilon(1e-5));
  check_section(revolution, through, bounding_box(revolution));
  const Section ring = check_known(revolution, along_y, 0.5, 8 * std::numbers::pi, 2);
  CHECK(corner_count(ring) == 4);
}

TEST_CASE("faces that coincide are decided by identity") {
  // A pocket that ends flush, two boxes that touch, and a peg in its own hole.
  const Entity box = Box{.corner_a = {0, 0, 0}, .corner_b = {4, 4, 4}};
  const Entity pocket = box - Entity(Box{.corner_a = {1, 1, 2}, .corner_b = {3, 3, 4}});
  check_known(pocket, along_x, 2, 12, 1);
  check_known(pocket, along_z, 3, 12, 2);
  const Entity beside = box + Entity(Box{.corner_a = {4, 0, 0}, .corner_b = {5, 4, 4}});
  CHECK(corner_count(check_known(beside, along_z, 1, 20, 1)) == 4);
  const Cylinder peg{.from = {2, 2, -1}, .to = {2, 2, 5}, .radius = 1};
  const Entity filled = (box - Entity(peg)) + Entity(peg);
  check_known(filled, along_z, 2, 16, 1);
  CHECK(section(Entity(peg) - Entity(peg), along_z, 2, 1e-3).empty());
  // Two that touch in an edge have that corner of the section twice.
  const Entity touching = box + Entity(Box{.corner_a = {4, 4, 0}, .corner_b = {5, 5, 4}});
  const Section corner = section(touching, along_z, 1, 1e-3);
  CHECK(corner.area.contains(17));
  CHECK(corner.contours.size() == 2);
  CHECK(corner.deviation <= 1e-3);
}

TEST_CASE("thin walls, small deviations and far places are no hindrance") {
  const Entity wall = Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}}) -
                      Entity(Box{.corner_a = {1e-4, -1, -1}, .corner_b = {0.9, 2, 2}});
  CHECK(section(wall, along_z, 0.5, 1e-2).contours.size() == 2);
  const Section fine = section(Sphere{}, along_z, 0.5, 1e-9, {.relative_width = 1e-9});
  CHECK(fine.deviation <= 1e-9);
  CHECK(fine.area.contains(0.75 * std::numbers::pi));
  CHECK(fine.area.width() < 3e-9);
  const Section finest = section(drilled_plate(), {1, 2, 3}, 1, 1e-300);
  CHECK(finest.deviation < 1e-5);
  CHECK(!finest.empty());
  const Vec3 far(1e6, -2e6, 3e6);
  const Section away = section(Sphere{.center = far}, along_z, 3e6, 1e-3);
  CHECK(away.deviation <= 1e-3);
  CHECK(away.area.middle() == doctest::Approx(std::numbers::pi).epsilon(1e-6));
}

TEST_CASE("where nothing is met, a section is empty") {
  CHECK(section(Sphere{}, along_z, 1.5, 1e-3).empty());
  CHECK(section(Sphere{}, along_z, 1.5, 1e-3).deviation == 0);
  const Entity apart = Entity(Sphere{}) ^ Entity(Sphere{.center = {3, 0, 0}});
  CHECK(section(apart, along_z, 0, 1e-3).area == Interval{0, 0});
  // Nobody knows whether a plane that touches a cylinder cuts it. That at a sphere is moved.
  const Section touch = section(Cylinder{}, along_x, 1, 1e-2);
  CHECK(touch.empty());
  CHECK(touch.deviation == std::numeric_limits<double>::infinity());
  CHECK(touch.area.upper < 0.1);
  const Section tip = section(Sphere{}, along_z, 1, 1e-3);
  CHECK(tip.frame.offset < 1);
  CHECK(tip.frame.offset > 1 - 1e-9);
  CHECK(tip.deviation <= 1e-3);
  CHECK(tip.area.upper < 1e-8);
}
