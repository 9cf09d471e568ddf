// Sweeps and tubes hold what a profile or a ball passes along their path, which is computed here
// from the path itself.
#include "crt/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "crt/measure.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "csg/made_solids.hpp"
#include "geometry/random.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

std::shared_ptr<const Profile> disc(double radius) {
  const std::vector<Contour> contours = {
      {{.x = radius, .y = 0, .bulge = 1}, {.x = -radius, .y = 0, .bulge = 1}}};
  return make_profile(contours);
}
std::shared_ptr<const Profile> rectangle(double x0, double y0, double x1, double y1) {
  const std::vector<Contour> contours = {
      {{.x = x0, .y = y0}, {.x = x1, .y = y0}, {.x = x1, .y = y1}, {.x = x0, .y = y1}}};
  return make_profile(contours);
}

/// Returns whether a ray from outside enters as often as it leaves, where contains() says so.
void check_rays(const Entity& entity, Precision precision) {
  Scene scene;
  scene.entities = {entity};
  scene.settings.precision = precision;
  const PreparedScene prepared = prepare(scene);
  const BoundingBox box = bounding_box(entity);
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  const Vec3 half = 0.5 * (box.upper - box.lower);
  Random random(7);
  int met = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 through = middle + half * random.in_cube();
    const Ray ray{.origin = through + 10.0 * glm::length(half) * random.direction(),
                  .direction = {0, 0, 0}};
    const Ray aimed{.origin = ray.origin, .direction = through - ray.origin};
    const auto crossings = crt::crossings(prepared, aimed);
    REQUIRE(crossings.size() % 2 == 0);
    if (!crossings.empty()) ++met;
    for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
      if (crossings[k + 1].t - crossings[k].t < 1e-9) continue;
      const double t = 0.5 * (crossings[k].t + crossings[k + 1].t);
      const Vec3 between = aimed.origin + t * aimed.direction;
      const PointSide side = contains(entity, between);
      CHECK(side == (k % 2 == 0 ? PointSide::inside : PointSide::outside));
    }
  }
  CHECK(met > 30);
}

/// Returns how far a point is from straight lines between points.
double distance_from_lines(const std::vector<Vec3>& points, const Vec3& place) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Vec3 way = points[i + 1] - points[i];
    const double share =
        std::clamp(glm::dot(place - points[i], way) / glm::dot(way, way), 0.0, 1.0);
    least = std::min(least, glm::length(place - points[i] - share * way));
  }
  return least;
}

}  // namespace

TEST_CASE("a sweep along one line is an extrusion") {
  const Entity sweep = Sweep{.profile = rectangle(0, 0, 0.5, 0.25), .path = {{1, 2, 3}, {1, 2, 7}}};
  check_volume(sweep, 0.5);
  // y of the profile is up, and x to the right of who looks along the path.
  CHECK(contains(sweep, {1.4, 2.2, 5}) == PointSide::inside);
  CHECK(contains(sweep, {0.9, 2.2, 5}) == PointSide::outside);
  CHECK(contains(sweep, {1.4, 1.9, 5}) == PointSide::outside);
  CHECK(contains(sweep, {1.4, 2.2, 7.01}) == PointSide::outside);
  const Entity sideways =
      Sweep{.profile = rectangle(0, 0, 0.5, 0.25), .path = {{0, 0, 0}, {0, 3, 0}}, .up = {1, 5, 0}};
  CHECK(contains(sideways, {0.2, 1, 0.4}) == PointSide::inside);
  const Entity upright =
      Sweep{.profile = rectangle(0, 0, 0.5, 0.25), .path = {{0, 0, 0}, {0, 3, 0}}};
  CHECK(contains(upright, {-0.4, 1, 0.2}) == PointSide::inside);
}

TEST_CASE("a bent pipe is all that is near the middle line") {
  const double r = 0.2;
  const double bend = 0.75;
  const Sweep pipe{.profile = disc(r), .path = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}}, .bend = bend};
  const Entity entity = pipe;
  check_volume(entity, pi * r * r * (3 - bend + 2 - bend + 0.5 * pi * bend));
  Random random(1);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 place(random.uniform(-0.5, 3.5), random.uniform(-0.5, 2.5),
                     random.uniform(-0.3, 0.3));
    const Vec3 center(3 - bend, bend, 0);
    double distance = std::numeric_limits<double>::infinity();
    if (place.x >= 0 && place.x <= 3 - bend) distance = std::hypot(place.y, place.z);
    if (place.y >= bend && place.y <= 2)
      distance = std::min(distance, std::hypot(place.x - 3, place.z));
    const Vec3 off = place - center;
    if (off.x >= 0 && off.y <= 0)
      distance = std::min(distance, std::hypot(std::hypot(off.x, off.y) - bend, off.z));
    if (std::abs(distance - r) < 1e-9) continue;
    inside += distance < r;
    REQUIRE((contains(entity, place) == PointSide::inside) == (distance < r));
  }
  CHECK(inside > 100);
  check_rays(entity, Precision::standard);
  check_rays(entity, Precision::exact);
}

TEST_CASE("a bend in space, turned any way, has the volume of its line") {
  const double r = 0.11;
  const std::vector<Vec3> path = {{0, 0, 0}, {2, 0.3, -0.4}, {2.5, 2, 0.7}, {0.4, 2.2, 2}};
  double length = 0;
  const double bend = 0.4;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) length += glm::length(path[i + 1] - path[i]);
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Vec3 before = glm::normalize(path[i] - path[i - 1]);
    const Vec3 after = glm::normalize(path[i + 1] - path[i]);
    const double angle = std::acos(glm::dot(before, after));
    length += bend * (angle - 2 * std::tan(0.5 * angle));
  }
  check_volume(Sweep{.profile = disc(r), .path = path, .bend = bend}, pi * r * r * length);
  // So has any profile whose centroid is on the path.
  const Entity square =
      Sweep{.profile = rectangle(-0.1, -0.05, 0.1, 0.05), .path = path, .bend = bend};
  check_volume(square, 0.02 * length);
  check_rays(square, Precision::standard);
}

TEST_CASE("mitres meet without a gap and without a wall") {
  const std::vector<Vec3> square = {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  const Entity frame =
      Sweep{.profile = rectangle(-0.1, -0.1, 0.1, 0.1), .path = square, .closed = true};
  check_volume(frame, 0.2 * (2.2 * 2.2 - 1.8 * 1.8));
  check_rays(frame, Precision::standard);
  check_rays(frame, Precision::exact);
  for (const double z : {0.0, 0.05, -0.0999}) {
    const std::vector<LinePiece> pieces = thickness_along(frame, {-5, 0.01, z}, {1, 0, 0});
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].to.middle() - pieces[0].from.middle() == doctest::Approx(2.2).epsilon(1e-12));
  }
  const Entity open =
      Sweep{.profile = rectangle(-0.1, 0, 0.1, 0.3), .path = {{0, 0, 0}, {0, 0, 1}, {1, 0, 2}}};
  check_volume(open, 0.06 * (1 + std::sqrt(2.0)));
  CHECK(contains(open, {0, 0.2, 1}) == PointSide::inside);
}

TEST_CASE("a closed path comes back to where it began") {
  const std::vector<Vec3> square = {{0, 0, 0}, {2, 0, 0}, {2, 0, 2}, {0, 0, 2}};
  const Entity ring = Sweep{.profile = disc(0.2), .path = square, .bend = 0.5, .closed = true};
  check_volume(ring, pi * 0.04 * (8 - 4 + pi));
  check_rays(ring, Precision::standard);
  // Bends that leave nothing of the lines make a torus.
  const Entity torus = Sweep{.profile = disc(0.2), .path = square, .bend = 1, .closed = true};
  check_volume(torus, 2 * pi * pi * 0.04);
  check_rays(torus, Precision::standard);
  check_rays(torus, Precision::exact);
}

TEST_CASE("what a sweep can't be is said with its place") {
  const std::vector<Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  CHECK(fault_of(Sweep{.path = corner}).find("profile") != std::string::npos);
  CHECK(fault_of(Sweep{.profile = disc(1), .path = {{0, 0, 0}}}) ==
        "path must have at least 2 points");
  CHECK(fault_of(Sweep{.profile = disc(1), .path = {{0, 0, 0}, {0, 0, 0}}}) ==
        "path stands still at point 0");
  CHECK(fault_of(Sweep{.profile = disc(0.1), .path = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}}) ==
        "path turns straight back at point 1");
  CHECK(fault_of(Sweep{.profile = disc(0.5), .path = corner, .bend = 0.25}) ==
        "bend must be as large as the profile reaches inwards at point 1");
  CHECK(fault_of(Sweep{.profile = disc(0.5), .path = corner, .bend = 2}) ==
        "path has too little room to turn between points 0 and 1");
  CHECK(fault_of(Sweep{.profile = disc(1.5), .path = corner}) ==
        "path has too little room to turn between points 0 and 1");
  CHECK(fault_of(Sweep{.profile = disc(0.1), .path = corner, .bend = -1}).find("bend") == 0);
  CHECK(fault_of(Sweep{.profile = disc(0.1), .path = corner, .up = {0, 0, 0}}).find("up") == 0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(fault_of(Sweep{.profile = disc(0.1), .path = {{0, 0, 0}, {1, nan, 0}}}).find("path") == 0);
  const Sweep twisted{
      .profile = disc(0.01), .path = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 2, 1}}, .closed = true};
  CHECK(fault_of(twisted).find("path must be flat if it is closed") == 0);
  const Sweep long_one{.profile = disc(0.1), .path = std::vector<Vec3>(5000, Vec3(0))};
  CHECK(fault_of(long_one).find("path has 5000 points") == 0);
}

TEST_CASE("a tube with one radius is all that is near its lines") {
  const std::vector<Vec3> path = {{0, 0, 0}, {1, 0.5, 0}, {1, 1.5, 1}, {-0.5, 1, 1}};
  const Entity tube = Tube{.path = path, .radii = {0.3}};
  Random random(3);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 place = Vec3(0.25, 0.75, 0.5) + 1.2 * random.in_cube();
    const double distance = distance_from_lines(path, place);
    if (std::abs(distance - 0.3) < 1e-9) continue;
    inside += distance < 0.3;
    REQUIRE((contains(tube, place) == PointSide::inside) == (distance < 0.3));
  }
  CHECK(inside > 200);
  check_rays(tube, Precision::standard);
}

TEST_CASE("a tube holds a ball anywhere on its path, and nothing else") {
  const std::vector<Vec3> path = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0.5}, {2.1, 2.05, 0.5}, {4, 2, 1}};
  const std::vector<double> radii = {0.5, 0.1, 0.3, 0.9, 0};
  const Entity tube = Tube{.path = path, .radii = radii};
  Random random(5);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 place = Vec3(1.9, 1, 0.5) + Vec3(2.5, 2.2, 1.5) * random.in_cube();
    // How deep a point is within a ball is a concave function of the ball's place on a line.
    double deepest = -1;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const auto depth = [&](double s) {
        return radii[k] + s * (radii[k + 1] - radii[k]) -
               glm::length(place - path[k] - s * (path[k + 1] - path[k]));
      };
      double low = 0;
      double high = 1;
      for (int step = 0; step < 100; ++step) {
        const double a = low + (high - low) / 3;
        const double b = high - (high - low) / 3;
        (depth(a) < depth(b) ? low : high) = depth(a) < depth(b) ? a : b;
      }
      deepest = std::max(deepest, depth(low));
    }
    if (std::abs(deepest) < 1e-9) continue;
    inside += deepest > 0;
    REQUIRE((contains(tube, place) == PointSide::inside) == (deepest > 0));
  }
  CHECK(inside > 100);
  check_rays(tube, Precision::exact);
}

TEST_CASE("a smooth tube goes through its points, within its deviation of a curve") {
  // Through four points of a circle Catmull's and Rom's curve is near it, and so is the torus.
  std::vector<Vec3> path;
  for (int i = 0; i < 8; ++i) path.push_back({std::cos(0.25 * pi * i), std::sin(0.25 * pi * i), 0});
  const Entity ring = Tube{.path = path, .radii = {0.2}, .smooth = true, .closed = true};
  for (const Vec3& point : path) CHECK(contains(ring, 1.19 * point) == PointSide::inside);
  for (const Vec3& point : path) CHECK(contains(ring, 1.2002 * point) == PointSide::outside);
  const Interval found = volume(ring, {.relative_width = 1e-2});
  CHECK(found.middle() == doctest::Approx(2 * pi * pi * 0.04).epsilon(0.02));

  // The curve through (0, 0), (1, 0), (1, 1) is a cubic whose middle is known.
  const Entity bow = Tube{.path = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},
                          .radii = {0.01},
                          .smooth = true,
                          .deviation = 1e-4};
  const Vec3 middle(0.5 + 0.125 * 0.5, -0.125 * 0.5, 0);
  CHECK(contains(bow, middle + Vec3(0, 0, 0.0098)) == PointSide::inside);
  CHECK(contains(bow, middle + Vec3(0, 0, 0.0102)) == PointSide::outside);
  CHECK(contains(bow, middle + Vec3(0, -0.0098, 0)) == PointSide::inside);

  // Radii stay between those of the two points.
  const Entity bulb = Tube{.path = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                           .radii = {0, 0.5, 0.5, 0},
                           .smooth = true};
  const crt::BoundingBox box = bounding_box(bulb);
  CHECK(box.upper.y <= 0.5 + 1e-12);
}

TEST_CASE("what a tube can't be is said") {
  const std::vector<Vec3> path = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  CHECK(fault_of(Tube{.path = {{0, 0, 0}}, .radii = {1}}) == "path must have at least 2 points");
  CHECK(fault_of(Tube{.path = path, .radii = {1, 2}}) ==
        "radii must be 1, or as many as there are points: 3, not 2");
  CHECK(fault_of(Tube{.path = path, .radii = {}}).find("radii") == 0);
  CHECK(fault_of(Tube{.path = path, .radii = {0}}) == "radii must not all be 0");
  CHECK(fault_of(Tube{.path = path, .radii = {1, -1, 1}}).find("radii") == 0);
  CHECK(fault_of(Tube{.path = {{0, 0, 0}, {0, 0, 0}}, .radii = {1}}) ==
        "path stands still at point 0");
  const Tube fine{.path = path, .radii = {1}, .smooth = true, .deviation = 1e-12};
  CHECK(fault_of(fine).find("the tube has over 4096 pieces") == 0);
}

TEST_CASE("sweeps and tubes wear one material, and take part in operations") {
  const SharedMaterial red{Material{.color = Color{1, 0, 0}}};
  const Entity pipe = Sweep{.profile = disc(0.2),
                            .path = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}},
                            .bend = 0.5,
                            .material = red};
  const Entity bored = pipe - Entity(Tube{.path = {{0, 0, 0}, {3, 0, 0}}, .radii = {0.1}});
  CHECK(volume(bored, {.relative_width = 1e-3}).upper < volume(pipe).lower);
  CHECK(contains(bored, {1, 0.15, 0}) == PointSide::inside);
  CHECK(contains(bored, {1, 0.05, 0}) == PointSide::outside);
}
