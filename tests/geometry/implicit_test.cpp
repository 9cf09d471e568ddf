#include "core/geometry/implicit/implicit.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/geometry/implicit/field_search.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "geometry/exact_tools.hpp"
#include "geometry/field_tools.hpp"
#include "geometry/oracle.hpp"
#include "geometry/random_fields.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Field squared_distance(const Vec3& from) {
  return pow(x - from.x, 2) + pow(y - from.y, 2) + pow(z - from.z, 2);
}

/// Makes a ball of a field, in a box that it does not reach.
Subject random_ball(Random& random) {
  const double radius = random.power_of_ten(-3, 3);
  const Vec3 center = random.in_cube() * (radius * random.power_of_ten(-1, 1));
  const Field f = squared_distance(center) - radius * radius;
  const Real square = Real{radius * radius};  // rounded, as in the field
  return {
      .primitive =
          Implicit{
              .field = f, .lower = center - Vec3(2 * radius), .upper = center + Vec3(2 * radius)},
      .center = center,
      .size = radius,
      .candidates =
          [=](const RealRay& ray) {
            const RealVec p = ray.origin - RealVec(center);
            return quadratic_roots(dot(ray.direction, ray.direction), dot(p, ray.direction),
                                   dot(p, p) - square);
          },
      .field = [=](const RealVec& p) { return length(p - RealVec(center)) - square_root(square); }};
}

std::string fault(const Implicit& implicit) {
  try {
    core::validate(Primitive(implicit));
  } catch (const Error& error) {
    return error.argument();
  }
  return {};
}

}  // namespace

TEST_CASE("implicit: a ball as a field has the true crossings, within their errors") {
  Random random(1);
  int hits = 0;
  int disputed = 0;
  for (int i = 0; i < 4000; ++i) {
    const Subject ball = random_ball(random);
    const auto shape = core::make_shape(ball.primitive);
    core::ObjectRay ray = random_ray(random, 1);
    ray.origin = ball.center + ball.size * ray.origin;
    core::CrossingList list;
    REQUIRE_FALSE(shape->crossings(ray, list));
    std::vector<Real> truth = ball.candidates(RealRay(ray));
    std::sort(truth.begin(), truth.end());
    if (list.size() != truth.size()) {
      ++disputed;
      continue;
    }
    for (std::size_t k = 0; k < list.size(); ++k) {
      ++hits;
      REQUIRE(list[k].entering == (k == 0));
      REQUIRE(magnitude(Real{list[k].t} - truth[k]) <= Real{list[k].error});
    }
  }
  CHECK(hits > 1000);
  CHECK(disputed <= 4);
}

TEST_CASE("implicit: a ball as a field passes the checks of every primitive") {
  check_reversal(random_ball, 1000);
  check_starts(random_ball, 4000, true);
  check_surface_points(random_ball, 1000, true);
}

TEST_CASE("implicit: tori, cylinders and boxes as fields have the crossings of these") {
  const Field rho = x * x + z * z;
  const Vec3 reach(1.75);
  const Torus torus{.radius = 1, .thickness = 0.5};
  check_against({pow(rho + y * y + 1 - 0.25, 2) - 4 * rho, -reach, reach}, torus, 2000);
  check_against({pow(sqrt(rho) - 1, 2) + y * y - 0.25, -reach, reach}, torus, 2000);
  const Cylinder cylinder{.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = 1};
  check_against({rho - 1, {-2, -1, -2}, {2, 1, 2}}, cylinder, 2000);
  check_against({max(rho - 1, abs(y) - 1), -reach, reach}, cylinder, 2000);
  check_against({-1, Vec3(-1), Vec3(1)}, Box{}, 2000);
  check_against({max(max(abs(x), abs(y)), abs(z)) - 1, -reach, reach}, Box{}, 2000);
  const double exponent = 0.5;
  check_against({pow(x * x + y * y + z * z, exponent) - 1, -reach, reach}, Sphere{}, 2000);
}

TEST_CASE("implicit: the faces of the box are those of a Box, to the bit") {
  Random random(3);
  const Box box{.corner_a = {-1, -2, -1}, .corner_b = {1, 0.5, 2}};
  const Implicit all{.field = -1, .lower = box.corner_a, .upper = box.corner_b};
  const auto of_box = core::make_shape(box);
  const auto shape = core::make_shape(all);
  for (std::uint32_t face = 0; face < 6; ++face) {
    CHECK(shape->surface(face + 1).position == of_box->surface(face).position);
    CHECK(shape->surface(face + 1).direction == of_box->surface(face).direction);
  }
  for (int i = 0; i < 1000; ++i) {
    const core::ObjectRay ray = random_ray(random, 2);
    core::CrossingList expected;
    of_box->crossings(ray, expected);
    const core::CrossingList list = crossings(all, ray);
    REQUIRE(list.size() == expected.size());
    for (std::size_t k = 0; k < list.size(); ++k) {
      REQUIRE(list[k].t == expected[k].t);
      REQUIRE(list[k].face == expected[k].face + 1);
    }
  }
}

TEST_CASE("implicit: a field that is 0 in a face of the box leaves the face to the box") {
  const Implicit slab{.field = z - 1, .lower = Vec3(-1), .upper = Vec3(1)};
  const core::CrossingList list =
      crossings(slab, {.origin = {0.3, 0.2, 5}, .direction = {0, 0, -1}});
  REQUIRE(list.size() == 2);
  CHECK(list[0].t == 4);
  CHECK(list[0].face == 6);
  CHECK(list[1].t == 6);
  CHECK(list[1].face == 5);
}

TEST_CASE("implicit: the rays that ask for less get the same of it") {
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const Implicit implicit{.field = random_field_of(random, 4, false)};
    const auto shape = core::make_shape(implicit);
    for (int k = 0; k < 10; ++k) {
      core::ObjectRay ray = random_ray(random, 1);
      const core::CrossingList all = crossings(implicit, ray);
      ray.begin = random.uniform(-1, 4);
      core::CrossingList part;
      const bool inside = shape->crossings(ray, part);
      std::size_t before = 0;
      while (before < all.size() && all[before].t < ray.begin) ++before;
      const auto near = [&](const core::Crossing& crossing) {
        return std::abs(crossing.t - ray.begin) <= 1e-3 + crossing.error;
      };
      if (std::any_of(all.begin(), all.end(), near)) continue;
      if (all.undecided + part.undecided > 0) continue;
      // Some of what is before may be there, too.
      const auto cut = [&](core::CrossingList& list, bool inside_before) {
        bool is_inside = inside_before;
        while (!list.empty() && list.front().t < ray.begin) {
          is_inside = list.front().entering;
          list.erase(list.begin());
        }
        return is_inside;
      };
      REQUIRE(cut(part, inside) == (before % 2 == 1));
      REQUIRE(part.size() == all.size() - before);
      for (std::size_t j = 0; j < part.size(); ++j) REQUIRE(part[j].t == all[before + j].t);
      ray.first_wanted_after = ray.begin;
      core::CrossingList first;
      REQUIRE(cut(first, shape->crossings(ray, first)) == (before % 2 == 1));
      REQUIRE(first.size() <= part.size());
      if (!part.empty()) REQUIRE(first.at(0).t == part[0].t);
    }
  }
}

TEST_CASE("implicit: wild fields are entered and left by turns, as f says where it is sure") {
  Random random(7);
  int known = 0;
  for (int i = 0; i < 3000; ++i) {
    const Implicit implicit{.field = random_field_of(random, 5, true)};
    if (!fault(implicit).empty()) continue;
    const core::ObjectRay ray = random_ray(random, 1);
    for (const core::CrossingList& list :
         {crossings(implicit, ray),
          exact_crossings(implicit, Transform{}, ray.origin, ray.direction)}) {
      REQUIRE(list.size() % 2 == 0);
      for (std::size_t k = 0; k < list.size(); ++k) {
        REQUIRE(list[k].entering == (k % 2 == 0));
        REQUIRE(std::isfinite(list[k].error));
        if (k > 0) REQUIRE(list[k - 1].t <= list[k].t);
        const core::SurfacePoint point = core::make_shape(implicit)->surface_point(ray, list[k]);
        REQUIRE(std::abs(glm::length(point.normal) - 1) < 1e-14);
      }
      if (list.undecided > 0) continue;
      for (std::size_t k = 0; k + 1 < list.size(); ++k) {
        const double from = list[k].t + list[k].error;
        const double to = list[k + 1].t - list[k + 1].error;
        const double size = to - from;
        if (!(size > 1e-6)) continue;
        for (const double share : {0.1, 0.5, 0.9}) {
          const Vec3 place = ray.origin + (from + share * size) * ray.direction;
          const double value = plain_value(implicit.field.node(), place);
          if (std::abs(value) < 1e-6) continue;
          ++known;
          REQUIRE((value <= 0) == list[k].entering);
        }
      }
    }
  }
  CHECK(known > 2000);
}

TEST_CASE("implicit: the work along a line is bounded") {
  Random random(9);
  const core::FieldSearchLimits limits{.max_evaluations = 200, .shortest = 0x1p-52};
  constexpr std::uint32_t max_left_open = 120;
  for (int i = 0; i < 2000; ++i) {
    const core::FieldProgram program(random_field_of(random, 5, true));
    const core::FieldLine line(program, {core::Interval{0, 0}, {0, 0}, {0, 0}},
                               {core::Interval{1, 1}, {-1, -1}, {0.5, 0.5}});
    core::FieldSearch search(line, limits);
    search.search(-1, 1);
    search.finish(-1, 1);
    REQUIRE(search.evaluations() <= 4 * limits.max_evaluations + max_left_open);
  }
  // There are 3183 roots in this box.
  const core::CrossingList list =
      crossings({sin(10000 * x), Vec3(-0.5), Vec3(0.5)}, {{-2, 0, 0}, {}, {1, 0, 0}});
  CHECK(list.undecided == 1);
  CHECK(list.size() % 2 == 0);
  CHECK(list.size() <= core::FieldSearch::max_roots + 2);
}

TEST_CASE("implicit: where a hard part takes all the work, what comes after it is still found") {
  // Cubes of x - a have a wide part about a in which rounding hides their sign.
  Random random(12);
  for (int i = 0; i < 600; ++i) {
    const double a = random.uniform(1, 60);
    const double end = random.uniform(100, 300);
    const double size = random.uniform(300, 800);
    const Field squared = x * x - 2 * a * x + a * a;
    const std::array<Field, 3> quartics = {
        squared * (x * x - (end + a) * x + end * a),
        (pow(x, 3) - 3 * a * x * x + 3 * a * a * x - a * a * a) * (x - end),
        pow(x, 4) - (3 * a + end) * pow(x, 3) + (3 * a * a + 3 * a * end) * x * x -
            (a * a * a + 3 * a * a * end) * x + a * a * a * end};
    const Implicit implicit{
        .field = quartics[static_cast<std::size_t>(i % 3)], .lower = Vec3(-1), .upper = Vec3(size)};
    const core::CrossingList list = crossings(implicit, {{-10, 5, 7}, {}, {1, 0.001, 0.002}});
    REQUIRE(list.size() == 2);
    CHECK(std::abs(list[0].t - 10 - a) <= list[0].error);
    CHECK(std::abs(list[1].t - 10 - end) <= list[1].error);
    for (const core::Crossing& crossing : list) CHECK(crossing.error < size / 64);
  }
}

TEST_CASE("implicit: what has no value is outside") {
  const auto count = [](const Field& f) {
    return crossings({f, Vec3(-2), Vec3(2)}, {{-5, 0.5, 0.5}, {}, {1, 0, 0}}).size();
  };
  const auto inside = [](const Field& f) {
    const core::CrossingList list =
        crossings({f, Vec3(-2), Vec3(2)}, {{-5, 0.5, 0.5}, {}, {1, 0, 0}});
    REQUIRE(list.size() == 2);
    return std::pair{list[0].t - 5, list[1].t - 5};
  };
  const auto is_inside_from = [&](const Field& f, double from, double to) {
    const auto [first, last] = inside(f);
    return std::abs(first - from) < 1e-12 && std::abs(last - to) < 1e-12;
  };
  CHECK(is_inside_from(log(x), 0, 1));
  CHECK(is_inside_from(sqrt(x) - 1, 0, 1));
  CHECK(is_inside_from(1 / x, -2, 0));
  CHECK(is_inside_from(asin(x), -1, 0));
  CHECK(count(sqrt(-1 - x * x)) == 0);
  CHECK(count(log(Field(-1))) == 0);
  CHECK(count(x / (y - y)) == 0);
  CHECK(count(1 / (x * x)) == 0);
  CHECK(count(-1 / (x * x)) == 2);
}

TEST_CASE("implicit: normals follow the gradient, and face the ray where there is none") {
  const Implicit ellipsoid{.field = x * x + 4 * y * y + 9 * z * z - 1};
  Random random(13);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const core::ObjectRay ray = random_ray(random, 0.8);
    const auto shape = core::make_shape(ellipsoid);
    for (const core::Crossing& crossing : crossings(ellipsoid, ray)) {
      ++found;
      const core::SurfacePoint point = shape->surface_point(ray, crossing);
      const Vec3& p = point.position;
      const Vec3 gradient(p.x, 4 * p.y, 9 * p.z);
      REQUIRE(glm::length(point.normal - glm::normalize(gradient)) < 1e-12);
    }
  }
  CHECK(found > 200);
  // The planes of a step have no slope.
  const auto shape = core::make_shape(Implicit{.field = round(x) - 0.5});
  const core::ObjectRay ray{.origin = {3, 0, 0}, .direction = {-1, 0, 0}};
  const core::CrossingList list = crossings({round(x) - 0.5}, ray);
  REQUIRE(list.size() == 2);
  CHECK(shape->surface_point(ray, list[0]).normal == Vec3(1, 0, 0));
}

TEST_CASE("implicit: many roots on one line are separated") {
  const core::CrossingList list =
      crossings({sin(100 * x), Vec3(-1), Vec3(1)}, {{-2, 0.25, 0}, {}, {1, 0, 0}});
  REQUIRE(list.size() == 64);
  // The last is the end of the box.
  for (std::size_t k = 0; k + 1 < list.size(); ++k) {
    const double truth = (static_cast<double>(k) - 31) * std::numbers::pi / 100;
    CHECK(std::abs(list[k].t - 2 - truth) <= list[k].error + 1e-15);
    CHECK(list[k].error < 1e-13);
  }
  CHECK(list.undecided == 0);
}

TEST_CASE("implicit: equal fields in equal boxes share a surface, others do not") {
  const auto surface = [](const Field& f, const Vec3& upper) {
    return core::make_shape(Implicit{.field = f, .upper = upper})->surface(0).sizes;
  };
  const auto ball = [] { return x * x + y * y + z * z - 1; };
  CHECK(surface(ball(), Vec3(1)) == surface(ball(), Vec3(1)));
  CHECK(surface(ball(), Vec3(1)) != surface(ball(), Vec3(2)));
  CHECK(surface(ball(), Vec3(1)) != surface(ball() + 0.0, Vec3(1)));
  CHECK(surface(x, Vec3(1)) != surface(y, Vec3(1)));
}

TEST_CASE("implicit: fields and boxes that are wrong are refused") {
  const double nan = std::nan("");
  CHECK(fault({}).empty());
  CHECK(fault({.lower = {nan, 0, 0}}) == "lower");
  CHECK(fault({.upper = {0, HUGE_VAL, 0}}) == "upper");
  CHECK(fault({.lower = {0, 1, 0}}) == "upper");
  CHECK_THROWS_AS(Field{nan}, Error);
  CHECK_THROWS_AS(pow(x, nan), Error);
  Field deep = x;
  const auto deepen = [&] {
    for (int i = 0; i < 2000; ++i) deep = sin(deep);
  };
  CHECK_THROWS_AS(deepen(), Error);
  // Equal operations count once, so that only this one is too long.
  Field long_sum = 0;
  Field short_sum = 0;
  for (int i = 0; i < 900; ++i) {
    short_sum = short_sum + sin(x) * cos(y) * sin(x * y * z);
    long_sum = long_sum + sin(i * x) * cos(i * y) * sin(i * z);
  }
  CHECK(fault({.field = short_sum}).empty());
  CHECK(fault({.field = long_sum}) == "field");
}
