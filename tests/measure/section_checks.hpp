// Tests of sections share these.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "crt/primitives.hpp"
#include "crt/section.hpp"

namespace crt::test {

inline constexpr Vec3 along_x(1, 0, 0);
inline constexpr Vec3 along_y(0, 1, 0);
inline constexpr Vec3 along_z(0, 0, 1);

struct DrawnPoint {
  double x = 0;
  double y = 0;
};

/// Returns a contour as a polygon of many corners, in the coordinates of the drawing.
inline std::vector<DrawnPoint> polygon_of(const Contour& contour) {
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

inline double signed_area(const std::vector<DrawnPoint>& polygon) {
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
inline void check_section(const Entity& solid, const Section& section, const BoundingBox& box,
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
inline Section check_known(const Entity& solid, const Vec3& normal, double offset, double area,
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

inline Entity drilled_plate() {
  Entity plate = Box{.corner_a = {-50, 0, -30}, .corner_b = {50, 12, 30}};
  for (const double x : {-40.0, 40.0}) {
    for (const double z : {-20.0, 20.0})
      plate = plate - Entity(Cylinder{.from = {x, -1, z}, .to = {x, 13, z}, .radius = 4});
  }
  return plate;
}

inline std::size_t corner_count(const Section& section) {
  std::size_t count = 0;
  for (const Contour& contour : section.contours) count += contour.size();
  return count;
}

}  // namespace crt::test
