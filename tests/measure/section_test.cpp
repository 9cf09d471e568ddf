// Sections of solids, against closed forms, and against whether points of a grid are in the solid.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "crt/cutters.hpp"
#include "crt/error.hpp"
#include "crt/section.hpp"
#include "crt/svg_path.hpp"
#include "crt/transform.hpp"
#include "geometry/random_instances.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;
constexpr Vec3 along_x(1, 0, 0);
constexpr Vec3 along_y(0, 1, 0);
constexpr Vec3 along_z(0, 0, 1);

struct DrawnPoint {
  double x = 0;
  double y = 0;
};

/// Returns a contour as a polygon of many corners, in the coordinates of the drawing.
std::vector<DrawnPoint> polygon_of(const Contour& contour) {
  std::vector<DrawnPoint> polygon;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ProfilePoint& from = contour[i];
    const ProfilePoint& to = contour[(i + 1) % contour.size()];
    const double b = to.bulge;
    const int count = b == 0 ? 1 : 256;
    for (int k = 0; k < count; ++k) {
      // Along the chord from -1 to 1, and to its right, with half a chord as the unit.
      double s = -1;
      double right = 0;
      if (b != 0) {
        const double half = 2 * std::atan(b);
        const double angle = half * (-1 + 2.0 * k / count);
        s = std::sin(angle) / std::sin(half);
        right = (std::cos(angle) - std::cos(half)) / std::sin(half);
      }
      const double hx = 0.5 * (to.x - from.x);
      const double hy = 0.5 * (to.y - from.y);
      polygon.push_back({from.x + hx + s * hx + right * hy, from.y + hy + s * hy - right * hx});
    }
  }
  return polygon;
}

double signed_area(const std::vector<DrawnPoint>& polygon) {
  double sum = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DrawnPoint& a = polygon[i];
    const DrawnPoint& b = polygon[(i + 1) % polygon.size()];
    sum += 0.5 * ((a.x - polygon[0].x) * (b.y - polygon[0].y) -
                  (a.y - polygon[0].y) * (b.x - polygon[0].x));
  }
  return sum;
}

/// Says how often polygons go around a point, and how far it is from them.
struct Surroundings {
  int winding = 0;
  double distance = std::numeric_limits<double>::infinity();

  Surroundings(const std::vector<std::vector<DrawnPoint>>& polygons, const DrawnPoint& p) {
    for (const std::vector<DrawnPoint>& polygon : polygons) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const DrawnPoint& a = polygon[i];
        const DrawnPoint& b = polygon[(i + 1) % polygon.size()];
        const double x = b.x - a.x;
        const double y = b.y - a.y;
        const double turn = x * (p.y - a.y) - y * (p.x - a.x);
        if (a.y <= p.y && b.y > p.y && turn > 0) ++winding;
        if (a.y > p.y && b.y <= p.y && turn < 0) --winding;
        const double squared = x * x + y * y;
        double share = squared > 0 ? ((p.x - a.x) * x + (p.y - a.y) * y) / squared : 0;
        share = std::clamp(share, 0.0, 1.0);
        distance = std::min(distance, std::hypot(a.x + share * x - p.x, a.y + share * y - p.y));
      }
    }
  }
};

/// Checks that contours say of points of a grid whether they are in the solid, that they are on its
/// surface, and that the area is that within them.
void check_section(const Entity& solid, const Section& section, const BoundingBox& box,
                   int lines = 48) {
  std::vector<std::vector<DrawnPoint>> polygons;
  double area = 0;
  double length = 0;
  for (const Contour& contour : section.contours) {
    polygons.push_back(polygon_of(contour));
    area += signed_area(polygons.back());
    for (std::size_t i = 0; i < polygons.back().size(); ++i) {
      const DrawnPoint& a = polygons.back()[i];
      const DrawnPoint& b = polygons.back()[(i + 1) % polygons.back().size()];
      length += std::hypot(b.x - a.x, b.y - a.y);
    }
  }
  const Vec3 size = box.upper - box.lower;
  const double largest = std::max({size.x, size.y, size.z});
  // Polygons of 256 chords an arc are so near to it.
  const double rough = section.deviation + 1e-4 * largest;
  CHECK(section.area.lower <= area + rough * length);
  CHECK(section.area.upper >= area - rough * length);

  // The corners of the box, as the drawing has them, say where the grid is.
  DrawnPoint lower{1e300, 1e300};
  DrawnPoint upper{-1e300, -1e300};
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p((corner & 1) != 0 ? box.upper.x : box.lower.x,
                 (corner & 2) != 0 ? box.upper.y : box.lower.y,
                 (corner & 4) != 0 ? box.upper.z : box.lower.z);
    const double x = glm::dot(p - section.frame.origin, section.frame.x_axis);
    const double y = glm::dot(p - section.frame.origin, section.frame.y_axis);
    lower = {std::min(lower.x, x), std::min(lower.y, y)};
    upper = {std::max(upper.x, x), std::max(upper.y, y)};
  }
  std::vector<Vec3> points;
  std::vector<DrawnPoint> drawn;
  for (int i = 0; i < lines; ++i) {
    for (int j = 0; j < lines; ++j) {
      const DrawnPoint p{lower.x + (upper.x - lower.x) * (i + 0.4871) / lines,
                         lower.y + (upper.y - lower.y) * (j + 0.5213) / lines};
      drawn.push_back(p);
      points.push_back(section.frame.at(p.x, p.y));
    }
  }
  std::vector<PointSide> sides(points.size());
  contains(solid, points, sides);
  int wrong = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Surroundings around(polygons, drawn[i]);
    if (sides[i] == PointSide::on || around.distance <= rough) continue;
    wrong += around.winding != (sides[i] == PointSide::inside ? 1 : 0) ? 1 : 0;
  }
  CHECK(wrong == 0);

  std::vector<Vec3> on_contours;
  for (const SectionPolyline& line : section_polylines(section, 1e-3 * largest)) {
    for (std::size_t i = 0; i < line.size(); i += 1 + line.size() / 8)
      on_contours.push_back(line[i]);
  }
  if (on_contours.size() > 32) on_contours.resize(32);
  std::vector<NearestPoint> nearest(on_contours.size());
  if (!on_contours.empty()) nearest_points(solid, on_contours, nearest, {.relative_width = 1e-2});
  for (const NearestPoint& found : nearest) {
    const double least = std::max(found.distance.lower, -found.distance.upper);
    CHECK(least <= section.deviation + 1e-11 * largest);
  }
}

/// Checks the area of a section, how near its contours are, and how many there are.
Section check_known(const Entity& solid, const Vec3& normal, double offset, double area,
                    std::size_t contours, double deviation = 1e-3) {
  const Section found = section(solid, normal, offset, deviation);
  CHECK(found.deviation <= deviation);
  CHECK(found.area.lower <= area + 1e-13 * area);
  CHECK(found.area.upper >= area - 1e-13 * area);
  CHECK(found.area.width() <= 1.5e-6 * area);
  CHECK(found.contours.size() == contours);
  check_section(solid, found, bounding_box(solid));
  return found;
}

Entity drilled_plate() {
  Entity plate = Box{.corner_a = {-50, 0, -30}, .corner_b = {50, 12, 30}};
  for (const double x : {-40.0, 40.0}) {
    for (const double z : {-20.0, 20.0})
      plate = plate - Entity(Cylinder{.from = {x, -1, z}, .to = {x, 13, z}, .radius = 4});
  }
  return plate;
}

std::size_t corner_count(const Section& section) {
  std::size_t count = 0;
  for (const Contour& contour : section.contours) count += contour.size();
  return count;
}

}  // namespace

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
  CHECK(section(spindle, along_z, 0, 1e-3).area.middle() == doctest::Approx(4 * pi));
}

TEST_CASE("sections are those of closed forms") {
  for (const double height : {0.0, 0.5, -0.99}) {
    const double squared = 1 - height * height;
    for (const Vec3& normal : {along_z, Vec3(1, 2, -3)}) {
      const Section found = check_known(Sphere{}, normal, height, pi * squared, 1);
      REQUIRE(found.contours[0].size() == 2);
      CHECK(found.contours[0][0].bulge == 1);
      CHECK(found.contours[0][1].bulge == 1);
      const double radius = 0.5 * (found.contours[0][0].x - found.contours[0][1].x);
      CHECK(radius == doctest::Approx(std::sqrt(squared)).epsilon(1e-12));
    }
  }
  const Entity cylinder = Cylinder{.from = {0, 0, -2}, .to = {0, 0, 2}, .radius = 1};
  check_known(cylinder, along_z, 0.3, pi, 1);
  CHECK(corner_count(check_known(cylinder, along_x, 0, 8, 1)) == 4);
  CHECK(corner_count(check_known(cylinder, along_y, 0.6, 6.4, 1)) == 4);
  check_known(cylinder, {1, 0, 1}, 0, pi * std::sqrt(2.0), 1);  // an ellipse
  const Entity cone = Cone{.from = {0, 0, 0}, .to = {0, 2, 0}};
  check_known(cone, along_y, 0.5, pi * 0.5625, 1);
  CHECK(corner_count(check_known(cone, along_x, 0, 2, 1)) == 3);
  // Where y = 1 - x / 4, seen from above: x^2 + z^2 = (1/2 + x/8)^2, an ellipse.
  constexpr double k = 63.0 / 64;
  const double seen = pi * (0.25 + 1 / (256 * k)) / std::sqrt(k);
  check_known(cone, {0.25, 1, 0}, 1 / std::sqrt(1.0625), seen * std::sqrt(1.0625), 1, 1e-4);
}

TEST_CASE("a torus has rings, ovals and circles") {
  const Torus torus{};
  const double radius = torus.radius;
  const double thickness = torus.thickness;
  for (const double height : {0.0, 0.1, 0.24}) {
    const double half = std::sqrt(thickness * thickness - height * height);
    const Section found = check_known(torus, along_y, height, 4 * pi * radius * half, 2);
    CHECK(corner_count(found) == 4);
    CHECK(signed_area(polygon_of(found.contours[0])) > 0);
    CHECK(signed_area(polygon_of(found.contours[1])) < 0);
  }
  check_known(torus, along_x, 0, 2 * pi * thickness * thickness, 2);
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
  CHECK(found.area.contains(2 * (pi * radius * radius - lens)));
  CHECK(found.area.width() < 1e-4);
  check_section(torus, found, bounding_box(torus));
}

TEST_CASE("a drilled plate has lines and full circles") {
  const Entity plate = drilled_plate();
  const Section found = check_known(plate, along_y, 6, 6000 - 64 * pi, 5, 1e-2);
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
  CHECK(volume(again).middle() == doctest::Approx(6000 - 64 * pi).epsilon(1e-6));
  // Turned in any way, it has as many lines and circles.
  const Transform turn = rotate_degrees({17, 31, -59});
  const Vec3 normal(turn.row_x.y, turn.row_y.y, turn.row_z.y);
  const Section turned = check_known(plate.transformed(turn), normal, 6, 6000 - 64 * pi, 5, 1e-2);
  CHECK(corner_count(turned) == 12);
}

TEST_CASE("lines and arcs that touch end where they touch") {
  const Entity slot = Entity(Box{.corner_a = {-1, -0.5, -1}, .corner_b = {1, 0.5, 1}}) +
                      Entity(Cylinder{.from = {-1, 0, -1}, .to = {-1, 0, 1}, .radius = 0.5}) +
                      Entity(Cylinder{.from = {1, 0, -1}, .to = {1, 0, 1}, .radius = 0.5});
  for (const Entity& solid :
       {slot, Entity(Capsule{.from = {-1, 0, 0}, .to = {1, 0, 0}, .radius = 0.5})}) {
    const Section found = check_known(solid, -along_z, 0, 2 + pi / 4, 1);
    REQUIRE(found.contours[0].size() == 4);
    for (const ProfilePoint& corner : found.contours[0]) {
      CHECK(std::abs(corner.x) == doctest::Approx(1).epsilon(1e-8));
      CHECK(std::abs(corner.y) == doctest::Approx(0.5).epsilon(1e-8));
      CHECK((corner.bulge == 0 || std::abs(corner.bulge - 1) < 1e-7));
    }
  }
  const Entity rounded = RoundedBox{.corner_a = {0, 0, 0}, .corner_b = {2, 1, 1}, .radius = 0.2};
  const Section found = check_known(rounded, along_z, 0.5, 2 - 0.04 * (4 - pi), 1);
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
  const Section ring = check_known(revolution, along_y, 0.5, 8 * pi, 2);
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
  CHECK(fine.area.contains(0.75 * pi));
  CHECK(fine.area.width() < 3e-9);
  const Vec3 far(1e6, -2e6, 3e6);
  const Section away = section(Sphere{.center = far}, along_z, 3e6, 1e-3);
  CHECK(away.deviation <= 1e-3);
  CHECK(away.area.middle() == doctest::Approx(pi).epsilon(1e-6));
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

TEST_CASE("sections of random solids of all primitives hold what points say") {
  for (std::size_t kind = 0; kind < std::variant_size_v<Primitive>; ++kind) {
    Random random(300 + kind);
    for (int instance = 0; instance < 4; ++instance) {
      CAPTURE(kind);
      CAPTURE(instance);
      const Primitive primitive = random_instance(kind, random);
      const Entity whole = primitive;
      if (!whole.is_solid()) continue;
      const BoundingBox box = bounding_box(whole);
      const Vec3 size = box.upper - box.lower;
      const double largest = std::max({size.x, size.y, size.z});
      if (!std::isfinite(largest)) continue;
      const Vec3 middle = 0.5 * (box.lower + box.upper);
      if (kind + 1 == std::variant_size_v<Primitive>) {
        // Of a custom solid nothing is known but its box.
        CHECK(section(whole, along_z, middle.z, 1e-2 * largest).deviation > 1e-2 * largest);
        continue;
      }
      const Entity cut = whole - Entity(Sphere{.center = middle + 0.3 * size * random.in_cube(),
                                               .radius = 0.3 * largest});
      for (const Entity& solid : {whole, cut}) {
        for (int plane = 0; plane < 3; ++plane) {
          CAPTURE(plane);
          const Vec3 normal = plane == 0 ? along_z : plane == 1 ? -along_y : random.direction();
          const Vec3 through = middle + 0.2 * size * random.in_cube();
          const double offset = glm::dot(normal, through) / glm::length(normal);
          const double deviation = largest * random.power_of_ten(-4, -2);
          const Section found = section(solid, normal, offset, deviation);
          // Heights may be so small that only rounding tells the surface from the bottom.
          const bool is_thin = std::holds_alternative<HeightField>(primitive);
          if (!is_thin) CHECK(found.deviation <= deviation);
          if (found.deviation <= deviation) check_section(solid, found, box, 24);
        }
      }
    }
  }
}

TEST_CASE("sections of random CSG trees with coincident faces hold what points say") {
  int unknown = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = maker.tree(3);
    const Entity entity = solid.entity();
    const BoundingBox box = bounding_box(entity);
    const Vec3 size = box.upper - box.lower;
    if (!std::isfinite(size.x + size.y + size.z) || !(size.x + size.y + size.z > 0)) continue;
    Random random(seed);
    for (const Vec3& normal : {along_x, -along_z, random.direction()}) {
      const double offset = glm::dot(normal, 0.5 * (box.lower + box.upper)) / glm::length(normal);
      const Section found = section(entity, normal, offset, 1e-2);
      // Planes of whole numbers touch some cylinders.
      if (found.deviation > 1e-2) ++unknown;
      if (found.deviation <= 1e-2) check_section(entity, found, box, 24);
    }
  }
  CHECK(unknown <= 3);
}

TEST_CASE("sections are the same for any number of threads") {
  const Entity solid = drilled_plate() - Entity(Sphere{.center = {18, 12, 0}, .radius = 10}) +
                       Entity(Torus{.center = {0, 20, 0}, .radius = 5, .thickness = 2});
  const Section one = section(solid, {1, 3, 2}, 3, 1e-3, {.threads = 1});
  CHECK(!one.empty());
  for (const int threads : {2, 5}) {
    const Section more = section(solid, {1, 3, 2}, 3, 1e-3, {.threads = threads});
    CHECK(more.contours == one.contours);
    CHECK(more.deviation == one.deviation);
    CHECK(more.area == one.area);
  }
}

TEST_CASE("a search that ends early says how well the section is known") {
  const Entity solid = drilled_plate();
  const Section found = section(solid, along_y, 6, 1e-3, {.seconds = 1e-9});
  CHECK(found.area.lower <= 6000 - 64 * pi);
  CHECK(found.area.upper >= 6000 - 64 * pi);
  CHECK(found.deviation > 1e-3);
  CHECK_THROWS_AS(section(solid, along_y, 6, 1e-3, {.go_on = [] { return false; }}), Error);
}

TEST_CASE("what is no question about a section is an error") {
  const double infinite = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto code = [&](const Entity& entity, const Vec3& normal, double offset, double deviation) {
    try {
      section(entity, normal, offset, deviation);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::internal;
  };
  const Entity ball = Sphere{};
  CHECK(code(ball, {0, 0, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(ball, {0, nan, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(ball, {0, infinite, 0}, 0, 1e-3) == ErrorCode::invalid_argument);
  for (const double bad : {infinite, nan})
    CHECK(code(ball, along_z, bad, 1e-3) == ErrorCode::invalid_argument);
  for (const double bad : {0.0, -1.0, infinite, nan})
    CHECK(code(ball, along_z, 0, bad) == ErrorCode::invalid_argument);
  CHECK(code(Plane{}, along_z, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK(code(Disc{}, along_z, 0, 1e-3) == ErrorCode::invalid_argument);
  CHECK_THROWS_AS(section(ball, along_z, 0, 1e-3, {.relative_width = 0}), Error);
  // Numbers of any size are no crash.
  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    try {
      section(Sphere{.radius = size}, {size, 2 * size, 0}, 0.1 * size, 1e-3 * size);
      section(ball, {size, 0, size}, size, 1e-3);
      section(ball, along_z, 0, size);
    } catch (const Error&) {
    }
  }
}

TEST_CASE("sections are drawn as SVG and DXF") {
  const Entity plate = drilled_plate();
  const Section found = section(plate, along_y, 6, 1e-2);
  const std::string svg = section_svg(found, {.unit = Unit::mm, .line_width = 0.5});
  CHECK(svg.find("width=\"101mm\" height=\"61mm\" viewBox=\"-50.5 -30.5 101 61\"") !=
        std::string::npos);
  // What a path of SVG encloses is what the section has.
  const std::size_t begin = svg.rfind(" d=\"") + 4;
  const std::string path = svg.substr(begin, svg.find('"', begin) - begin);
  double area = 0;
  for (const Contour& contour : svg_path_contours(path)) area += signed_area(polygon_of(contour));
  CHECK(std::abs(area) == doctest::Approx(6000 - 64 * pi).epsilon(1e-3));
  CHECK(svg.find("A4 4 0 0 ") != std::string::npos);
  CHECK(section_svg(found, {.unit = Unit::m}).find("width=\"100000.7mm\"") != std::string::npos);
  CHECK(section_svg(found, {.unit = Unit::in}).find("in\" height") != std::string::npos);

  const std::string dxf = section_dxf(found, {.unit = Unit::mm, .hatch = 2});
  CHECK(dxf.find("$INSUNITS\n70\n4\n") != std::string::npos);
  const auto count = [&](const std::string& word) {
    std::size_t number = 0;
    for (std::size_t at = dxf.find(word); at != std::string::npos; at = dxf.find(word, at + 1))
      ++number;
    return number;
  };
  CHECK(count("\nPOLYLINE\n") == 5);
  CHECK(count("\nVERTEX\n") == 12);
  CHECK(count("\n42\n-1\n") == 8);
  // Hatching covers what is solid, and nothing else: its length times its distance is the area.
  double length = 0;
  std::size_t at = dxf.find("\nLINE\n");
  CHECK(at != std::string::npos);
  for (; at != std::string::npos; at = dxf.find("\nLINE\n", at + 1)) {
    const auto number = [&](const std::string& group) {
      return std::stod(dxf.substr(dxf.find("\n" + group + "\n", at) + group.size() + 2));
    };
    const double dx = number("11") - number("10");
    const double dy = number("21") - number("20");
    CHECK(dx == doctest::Approx(dy));
    length += std::hypot(dx, dy);
    const Vec3 middle = found.frame.at(number("10") + 0.5 * dx, number("20") + 0.5 * dy);
    CHECK(contains(plate, middle) != PointSide::outside);
  }
  CHECK(2 * length == doctest::Approx(6000 - 64 * pi).epsilon(5e-3));

  CHECK_THROWS_AS(section_svg(found, {.hatch = -1}), Error);
  CHECK_THROWS_AS(section_dxf(found, {.hatch = 1e-9}), Error);
  CHECK_THROWS_AS(section_svg(found, {.line_width = std::nan("")}), Error);
  CHECK_THROWS_AS(write_section("section.pdf", found), Error);
  CHECK_THROWS_AS(write_section("/no/such/folder/section.svg", found), Error);
  CHECK(section_svg(Section{}).find("</svg>") != std::string::npos);
  CHECK(section_dxf(Section{}).find("EOF") != std::string::npos);
}
