// How near solids are: to points, to each other, and where they overlap.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
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

void check(const Interval& answer, double truth, double relative_width = 1e-6) {
  const double rounding = 1e-12 * (1 + std::abs(truth));
  CHECK(answer.lower <= truth + rounding);
  CHECK(answer.upper >= truth - rounding);
  CHECK(answer.width() <= 1.001 * relative_width * std::abs(truth) + rounding);
}

/// Returns how far two boxes are apart.
double between(const Solid& a, const Solid& b) {
  Vec3 way(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis)
    way[axis] = std::max({0.0, b.a[axis] - a.b[axis], a.a[axis] - b.b[axis]});
  return glm::length(way);
}

}  // namespace

TEST_CASE("points are as far from a surface as formulas say, inside too") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 point = 3.0 * random.in_cube();
    check(nearest_point(Sphere{}, point).distance, glm::length(point) - 1, 2e-3);
    const Vec3 beyond = glm::abs(point) - Vec3(1);
    const double outside = glm::length(glm::max(beyond, Vec3(0)));
    const double inside = std::max({beyond.x, beyond.y, beyond.z});
    const NearestPoint of_box = nearest_point(Box{}, point);
    check(of_box.distance, outside > 0 ? outside : inside);
    CHECK(contains(Box{}, of_box.point + 1e-9 * of_box.point) == PointSide::outside);
    const double ring = glm::length(Vec3(std::hypot(point.x, point.z) - 1, point.y, 0)) - 0.25;
    check(nearest_point(Torus{}, point, {.relative_width = 1e-3}).distance, ring, 1e-3);
  }
}

TEST_CASE("nothing of the other side is nearer than a distance to a tree of solids says") {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = in_room(maker.tree(3));
    const Entity entity = solid.entity();
    if (volume(entity, {.relative_width = 0.1}).lower <= 0) continue;
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i)
      points.emplace_back(maker.real(-5, 5), maker.real(-5, 5), maker.real(-5, 5));
    std::vector<NearestPoint> nearest(points.size());
    nearest_points(entity, points, nearest, {.relative_width = 1e-3});
    Random random(seed);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto& [distance, at] = nearest[i];
      const Vec3& point = points[i];
      const bool is_inside = solid.contains({point.x, point.y, point.z});
      CHECK((is_inside ? distance.lower < 0 : distance.upper > 0));
      const double least = is_inside ? -distance.upper : distance.lower;
      const double most = is_inside ? -distance.lower : distance.upper;
      for (int k = 0; k < 50; ++k) {
        Vec3 beside = random.in_cube();
        beside = point + 0.9999 * least * beside / std::max(1.0, glm::length(beside));
        CHECK(solid.contains({beside.x, beside.y, beside.z}) == is_inside);
      }
      // The surface passes next to the point that is given, which is as far away as is said.
      CHECK(glm::length(at - point) <= most * (1 + 1e-9));
      bool meets_other = false;
      for (int k = 0; k < 4000 && !meets_other; ++k) {
        const Vec3 beside = at + (2 * distance.width() + 1e-9) * random.in_cube();
        meets_other = solid.contains({beside.x, beside.y, beside.z}) != is_inside;
      }
      CHECK(meets_other);
    }
  }
}

TEST_CASE("boxes are as far apart as their sides") {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const auto box = [&] {
      Solid solid;
      solid.a = 2.0 * maker.grid_point();
      solid.b = solid.a + Vec3(maker.integer(1, 4), maker.integer(1, 4), maker.integer(1, 4));
      return solid;
    };
    const Solid a = box();
    const Solid b = box();
    const Clearance near = clearance(a.entity(), b.entity());
    const double truth = between(a, b);
    check(near.distance, truth);
    const Vec3 common = glm::min(a.b, b.b) - glm::max(a.a, b.a);
    CHECK(near.overlap == (common.x > 0 && common.y > 0 && common.z > 0));
    CHECK(std::abs(glm::length(near.on_a - near.on_b) - truth) <= 1e-6 * truth + 1e-9);
    const Clearance back = clearance(b.entity(), a.entity());
    CHECK(back.distance.lower <= near.distance.upper);
    CHECK(back.distance.upper >= near.distance.lower);
  }
}

TEST_CASE("round solids are as far apart as formulas say") {
  check(clearance(Sphere{}, Sphere{.center = {3, 0, 0}}).distance, 1);
  check(clearance(Sphere{.center = {3, 3, 3}}, Box{}).distance, std::sqrt(12) - 1);
  check(clearance(Cylinder{.from = {-5, 0, 0}, .to = {5, 0, 0}},
                  Cylinder{.from = {0, 3, -5}, .to = {0, 3, 5}})
            .distance,
        1);
  Random random(9);
  for (int i = 0; i < 12; ++i) {
    const Vec3 center = 4.0 * random.in_cube();
    const double apart = glm::length(center) - 1.5;
    const Clearance near = clearance(Sphere{}, Sphere{.center = center, .radius = 0.5});
    CHECK(near.overlap == (apart < 0));
    check(near.distance, std::max(0.0, apart));
  }
}

TEST_CASE(
    "solids overlap however little of one is beyond a face of the other, and touch otherwise") {
  for (const double depth : {0.5, 0.1, 1e-3, 1e-5}) {
    CAPTURE(depth);
    const Box box{.corner_a = {1 - depth, -1, -1}, .corner_b = {3, 1, 1}};
    const Clearance within = clearance(Sphere{}, box);
    CHECK(within.overlap);
    CHECK(within.distance == Interval{0, 0});
    CHECK(contains(Sphere{}, within.on_a) == PointSide::inside);
    CHECK(contains(box, within.on_b) == PointSide::inside);
  }
  CHECK(!clearance(Sphere{}, Box{.corner_a = {1, -1, -1}, .corner_b = {3, 1, 1}}).overlap);
  const Clearance touching = clearance(Sphere{}, Sphere{.center = {0, 2, 0}});
  CHECK(!touching.overlap);
  CHECK(touching.distance.lower == 0);
  CHECK(touching.distance.upper < 1e-11);
}

TEST_CASE("what is between a shaft and its bore is known to a few percent") {
  const Entity bearing = Entity(Box{.corner_a = {-2, -2, -2}, .corner_b = {2, 2, 2}}) -
                         Entity(Cylinder{.from = {0, -3, 0}, .to = {0, 3, 0}, .radius = 1.25});
  const Clearance near = clearance(bearing, Cylinder{.from = {0, -3, 0}, .to = {0, 3, 0}});
  CHECK(near.distance.lower <= 0.25);
  CHECK(near.distance.upper >= 0.25);
  CHECK(near.distance.width() < 0.005);
  CHECK(!near.overlap);
  // So is a play of a fiftieth of the radius.
  const Entity block = Entity(Box{.corner_a = {-10, 0, -10}, .corner_b = {10, 10, 10}}) -
                       Entity(Cylinder{.from = {0, -1, 0}, .to = {0, 11, 0}, .radius = 5});
  const Entity pin = Cylinder{.from = {0, -1, 0}, .to = {0, 11, 0}, .radius = 4.9};
  const Clearance play = clearance(block, pin);
  CHECK(play.distance.lower > 0.095);
  CHECK(play.distance.lower <= 0.1);
  CHECK(play.distance.upper >= 0.1 - 1e-9);
  CHECK(play.distance.upper < 0.1001);
}

TEST_CASE("pairs that overlap are found, with what they have in common") {
  const std::vector<Entity> parts = {Box{.corner_a = {0, 0, 0}, .corner_b = {2, 2, 2}},
                                     Box{.corner_a = {2, 0, 0}, .corner_b = {3, 2, 2}},
                                     Box{.corner_a = {1, 1, 1}, .corner_b = {4, 4, 4}},
                                     Sphere{.center = {9, 9, 9}}, Disc{}};
  const std::vector<Overlap> overlaps = interference(parts);
  REQUIRE(overlaps.size() == 2);
  CHECK(overlaps[0].first == 0);
  CHECK(overlaps[0].second == 2);
  CHECK(std::abs(overlaps[0].volume.middle() - 1) < 1e-9);
  CHECK(overlaps[1].first == 1);
  CHECK(overlaps[1].second == 2);
  CHECK(std::abs(overlaps[1].volume.middle() - 1) < 1e-9);
}

TEST_CASE("a pair of points is known even when no time is left") {
  const Entity ring = Torus{.center = {9, 0, 0}, .radius = 2, .thickness = 0.01};
  const Clearance found = clearance(Torus{.radius = 2, .thickness = 0.01}, ring, {.seconds = 1e-9});
  CHECK(found.distance.lower <= 5 - 0.02);
  CHECK(found.distance.upper >= 5 - 0.02);
  CHECK(std::abs(glm::distance(found.on_a, found.on_b) - found.distance.upper) < 1e-9);
}

TEST_CASE("nothing is at no distance from anything") {
  CHECK_THROWS_AS(clearance(empty_entity(), Sphere{}), Error);
  CHECK_THROWS_AS(clearance(Sphere{}, Plane{}), Error);
  CHECK_THROWS_AS(nearest_point(empty_entity(), {0, 0, 0}), Error);
  CHECK_THROWS_AS(nearest_point(Disc{}, {0, 0, 0}), Error);
}

TEST_CASE("what a distance, a wall or a line takes is counted, for any number of threads alike") {
  const Entity plate = Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {4, 2, 1}}) -
                       Entity(Cylinder{.from = {1, 1, -1}, .to = {1, 1, 2}, .radius = 0.5});
  const Entity ball = Sphere{.center = {8, 1, 0.5}, .radius = 1};
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(0.01 * i, 3, 0.02 * i);
  std::vector<NearestPoint> nearest(points.size());
  const auto work_of = [&](int threads, const auto& ask) {
    std::uint64_t work = 0;
    MeasureOptions options{.relative_width = 1e-2, .threads = threads};
    options.work = [&](std::uint64_t looks) { work += looks; };
    ask(options);
    return work;
  };
  const auto check_work = [&](const auto& ask) {
    const std::uint64_t work = work_of(1, ask);
    CHECK(work > 0);
    CHECK(work_of(2, ask) == work);
  };
  check_work([&](const auto& options) { nearest_points(plate, points, nearest, options); });
  check_work([&](const auto& options) { clearance(plate, ball, options); });
  check_work([&](const auto& options) { clearance(plate, plate, options); });
  check_work([&](const auto& options) { least_wall(plate, {.measure = options}); });
  check_work([&](const auto& options) { thickness_along(plate, {-1, 1, 0}, {1, 0, 0}, options); });
  check_work([&](const auto& options) { centroid(plate, options); });
}
