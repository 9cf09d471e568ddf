#include "geometry/oracle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace crt::test {
namespace {

using core::Crossing;
using core::CrossingList;
using core::ObjectRay;
using core::Shape;
using core::Side;

constexpr double u = 0x1p-53;
/// Spans shorter than this share of the size are grazing: standard precision may miss them.
constexpr double grazing = 1e-6;

struct Root {
  Real t;
  bool entering;
};

std::vector<Root> true_roots(const Subject& subject, const RealRay& ray) {
  std::vector<Real> t = subject.candidates(ray);
  std::sort(t.begin(), t.end());
  std::vector<Root> roots;
  if (subject.on_surface) {
    for (const Real root : t) {
      if (subject.on_surface(ray.at(root))) {
        const Real step = subject.size / length(ray.direction);
        roots.push_back(
            {root, subject.field(ray.at(root + step)) < subject.field(ray.at(root - step))});
      }
    }
    return roots;
  }
  const Real step = subject.size / length(ray.direction);
  bool inside = !t.empty() && subject.field(ray.at(t.front() - step)) < 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const Real after = i + 1 < t.size() ? (t[i] + t[i + 1]) / 2 : t[i] + step;
    const bool inside_after = subject.field(ray.at(after)) < 0;
    if (inside_after != inside) roots.push_back({t[i], inside_after});
    inside = inside_after;
  }
  return roots;
}

/// Returns a ray at a random distance, with a direction of random length, aimed near the subject.
ObjectRay random_ray(Random& random, const Subject& subject) {
  ObjectRay ray;
  ray.direction = random.direction();
  const double distance = subject.size * random.power_of_ten(-1, 6);
  const Vec3 target = subject.center + random.in_cube() * (0.9 * subject.size);
  ray.origin = target - ray.direction * distance;
  if (random.one_in(4)) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin_low[axis] = ray.origin[axis] * random.uniform(-u / 2, u / 2);
      ray.direction_low[axis] = ray.direction[axis] * random.uniform(-u / 2, u / 2);
    }
  }
  const double speed = std::exp2(std::floor(random.uniform(-10, 10)));
  ray.direction *= speed;
  ray.direction_low *= speed;
  return ray;
}

RealVec gradient(const Subject& subject, const RealVec& p) {
  const Real h = subject.size * Real(1e-12);
  RealVec result;
  for (int axis = 0; axis < 3; ++axis) {
    RealVec step;
    step[axis] = h;
    result[axis] = (subject.field(p + step) - subject.field(p - step)) / (2 * h);
  }
  return result;
}

/// Returns whether the gradient is that of one smooth face around p, and has about unit length.
bool smooth_at(const Subject& subject, const RealVec& p) {
  const Real h = subject.size * Real(1e-9);
  for (int axis = 0; axis < 3; ++axis) {
    RealVec step;
    step[axis] = h;
    const Real ahead = subject.field(p + step) - subject.field(p);
    const Real back = subject.field(p) - subject.field(p - step);
    if (magnitude(ahead - back) > h * Real(1e-6)) return false;
  }
  return true;
}

void require_form(const Shape& shape, const CrossingList& crossings, bool inside_before) {
  bool inside = inside_before;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    REQUIRE(std::isfinite(crossings[i].t));
    REQUIRE(std::isfinite(crossings[i].error));
    REQUIRE(crossings[i].error >= 0);
    REQUIRE(crossings[i].face < shape.face_count());
    if (i > 0) REQUIRE(crossings[i - 1].t < crossings[i].t);
    if (shape.is_solid()) {
      REQUIRE(crossings[i].entering == !inside);
      inside = !inside;
    }
  }
  if (shape.is_solid() && shape.bounds().finite()) {
    REQUIRE_FALSE(inside_before);
    REQUIRE(crossings.size() % 2 == 0);
  }
}

/// Drops pairs of neighbours that are a grazing distance from each other.
template <class List>
void drop_grazing(List& list, const RealRay& ray, double size) {
  for (std::size_t i = 0; i + 1 < list.size();) {
    const Real gap = magnitude(Real(list[i + 1].t) - Real(list[i].t)) * length(ray.direction);
    if (gap < Real(grazing) * size) {
      const auto at = list.begin() + static_cast<std::ptrdiff_t>(i);
      list.erase(at, at + 2);
    } else {
      ++i;
    }
  }
}

bool near_rim(const Subject& subject, const RealRay& ray, const std::vector<Real>& candidates) {
  if (!subject.on_surface) return false;
  for (const Real t : candidates) {
    const RealVec p = ray.at(t);
    const bool here = subject.on_surface(p);
    for (int axis = 0; axis < 3; ++axis) {
      RealVec step;
      step[axis] = Real(grazing) * subject.size;
      if (subject.on_surface(p + step) != here || subject.on_surface(p - step) != here) return true;
    }
  }
  return false;
}

}  // namespace

void check_against_oracle(const MakeSubject& make, int count) {
  Random random(1);
  int hits = 0;
  int disputed = 0;
  for (int i = 0; i < count; ++i) {
    const Subject subject = make(random);
    const auto shape = core::make_shape(subject.primitive);
    const ObjectRay ray = random_ray(random, subject);
    const RealRay real(ray);
    CrossingList found;
    const bool inside_before = shape->crossings(ray, found);
    require_form(*shape, found, inside_before);
    std::vector<Root> expected = true_roots(subject, real);
    if (found.size() != expected.size()) {
      ++disputed;
      if (near_rim(subject, real, subject.candidates(real))) continue;
      drop_grazing(found, real, subject.size);
      drop_grazing(expected, real, subject.size);
    }
    CAPTURE(i);
    REQUIRE(found.size() == expected.size());
    if (!found.empty()) ++hits;
    for (std::size_t k = 0; k < found.size(); ++k) {
      REQUIRE(found[k].entering == expected[k].entering);
      const double error = static_cast<double>(magnitude(Real(found[k].t) - expected[k].t));
      REQUIRE(error <= found[k].error);
      const RealVec p = real.at(expected[k].t);
      if (!smooth_at(subject, p)) continue;
      const double approach =
          static_cast<double>(magnitude(dot(gradient(subject, p), real.direction)));
      const double reach =
          static_cast<double>(length(p - RealVec(subject.center))) + 4 * subject.size;
      REQUIRE(found[k].error <= 1.01 * (u * std::abs(found[k].t) + 8 * u * reach / approach));
    }
  }
  CHECK(hits > count / 20);
  CHECK(disputed <= count / 1000);
}

void check_scaling(const MakeSubject& make, int count) {
  Random random(2);
  constexpr int exponents[] = {-300, -299, -100, -1, 1, 77, 300};
  for (int i = 0; i < count; ++i) {
    const Subject subject = make(random);
    const ObjectRay ray = random_ray(random, subject);
    CrossingList expected;
    const auto shape = core::make_shape(subject.primitive);
    const bool inside = shape->crossings(ray, expected);
    for (const int exponent : exponents) {
      const double factor = std::ldexp(1.0, exponent);
      ObjectRay scaled_ray = ray;
      scaled_ray.origin *= factor;
      scaled_ray.origin_low *= factor;
      const auto scaled_shape = core::make_shape(scaled(subject.primitive, factor));
      CrossingList found;
      CAPTURE(exponent);
      REQUIRE(scaled_shape->crossings(scaled_ray, found) == inside);
      REQUIRE(found.size() == expected.size());
      for (std::size_t k = 0; k < found.size(); ++k) {
        REQUIRE(found[k].t == expected[k].t * factor);
        REQUIRE(found[k].error == expected[k].error * factor);
        REQUIRE(found[k].face == expected[k].face);
        const core::SurfacePoint a = shape->surface_point(ray, expected[k]);
        const core::SurfacePoint b = scaled_shape->surface_point(scaled_ray, found[k]);
        REQUIRE(a.normal == b.normal);
        REQUIRE(a.position * factor == b.position);
      }
    }
  }
}

void check_reversal(const MakeSubject& make, int count) {
  Random random(3);
  for (int i = 0; i < count; ++i) {
    const Subject subject = make(random);
    const auto shape = core::make_shape(subject.primitive);
    const ObjectRay ray = random_ray(random, subject);
    ObjectRay reversed = ray;
    reversed.direction = -ray.direction;
    reversed.direction_low = -ray.direction_low;
    CrossingList ahead;
    CrossingList back;
    const bool inside_before = shape->crossings(ray, ahead);
    const bool inside_after = shape->crossings(reversed, back);
    if (ahead.size() != back.size()) {
      drop_grazing(ahead, RealRay(ray), subject.size);
      drop_grazing(back, RealRay(ray), subject.size);
    }
    REQUIRE(ahead.size() == back.size());
    if (shape->is_solid()) REQUIRE(inside_after == ((ahead.size() % 2 == 1) != inside_before));
    for (std::size_t k = 0; k < ahead.size(); ++k) {
      const Crossing& other = back[back.size() - 1 - k];
      REQUIRE(other.entering != ahead[k].entering);
      REQUIRE(std::abs(other.t + ahead[k].t) <= other.error + ahead[k].error);
    }
  }
}

namespace {

/// Checks that rays side by side cross where each does by itself, to the last bit.
void check_side_by_side(const core::Shape& shape, ObjectRay ray) {
  ray.origin_low = ray.direction_low = Vec3(0);
  CrossingList crossings;
  shape.crossings(ray, crossings);
  for (const Crossing& crossing : crossings) {
    core::RayLanes rays;
    core::Lanes t{};
    for (std::size_t lane = 0; lane < core::lane_count; ++lane) {
      const double factor = lane == 2 ? 1 : 0.5 + static_cast<double>(lane);
      rays.origin.set(lane, factor * ray.origin);
      rays.direction.set(lane, ray.direction / factor);
      t[lane] = crossing.t * factor;
    }
    core::SurfacePointLanes points;
    shape.points_on(rays.from_center(shape.anchor(crossing.face), t), rays.direction, 1u << 2,
                    crossing.face, true, points);
    const core::SurfacePoint point = shape.surface_point(ray, crossing);
    REQUIRE(points.position.lane(2) == point.position);
    REQUIRE(points.normal.lane(2) == point.normal);
    REQUIRE(core::lane_of(points, 2).u == point.u);
    REQUIRE(core::lane_of(points, 2).v == point.v);
  }
}

}  // namespace

void check_surface_points(const MakeSubject& make, int count, bool unit_square) {
  Random random(4);
  for (int i = 0; i < count; ++i) {
    const Subject subject = make(random);
    const auto shape = core::make_shape(subject.primitive);
    const core::Bounds bounds = shape->bounds();
    const ObjectRay ray = random_ray(random, subject);
    CrossingList crossings;
    shape->crossings(ray, crossings);
    check_side_by_side(*shape, ray);
    for (const Crossing& crossing : crossings) {
      const core::SurfacePoint point = shape->surface_point(ray, crossing);
      const RealVec p(point.position);
      core::Bounds here;
      here.include(point.position);
      REQUIRE(bounds.touches(here));
      REQUIRE(std::isfinite(point.u));
      REQUIRE(std::isfinite(point.v));
      if (unit_square) {
        REQUIRE(point.u >= 0);
        REQUIRE(point.u <= 1);
        REQUIRE(point.v >= 0);
        REQUIRE(point.v <= 1);
      }
      // The point is on the surface to the rounding of its coordinates.
      const double reach = static_cast<double>(length(p)) + 4 * subject.size +
                           static_cast<double>(length(p - RealVec(subject.center)));
      REQUIRE(magnitude(subject.field(p)) <= 8 * u * reach);
      // It is as far from the ray as t is from exact.
      const RealRay real(ray);
      const Real off_ray = length(real.at(crossing.t) - p);
      REQUIRE(off_ray <= crossing.error * length(real.direction) + 16 * u * reach);
      const RealVec normal(point.normal);
      REQUIRE(magnitude(dot(normal, normal) - 1) <= 8 * u);
      if (!smooth_at(subject, p)) continue;
      const RealVec expected = normalized(gradient(subject, p));
      REQUIRE(length(normal - expected) <= 1e-6);
      REQUIRE((dot(normal, real.direction) < 0) == crossing.entering);
    }
  }
}

namespace {

int count_after_start(const CrossingList& crossings) {
  return static_cast<int>(
      std::count_if(crossings.begin(), crossings.end(), [](const Crossing& c) { return c.t > 0; }));
}

/// Returns whether the ray is inside just after its start.
bool inside_after_start(const CrossingList& crossings, bool inside_before) {
  bool inside = inside_before;
  for (const Crossing& crossing : crossings) {
    if (crossing.t <= 0) inside = crossing.entering;
  }
  return inside;
}

void check_start(const Shape& shape, const ObjectRay& ray, bool convex) {
  CrossingList found;
  const bool inside_before = shape.crossings(ray, found);
  require_form(shape, found, inside_before);
  const int ahead = count_after_start(found);
  if (!shape.is_solid()) {
    REQUIRE(found.size() <= 1);
    for (const Crossing& crossing : found) {
      REQUIRE(crossing.t == 0);
      REQUIRE(crossing.entering == (ray.start.side == Side::inside));
    }
    return;
  }
  const bool inside = ray.start.side == Side::inside;
  REQUIRE(inside_after_start(found, inside_before) == inside);
  if (convex && !inside) REQUIRE(ahead == 0);
  if (convex && inside && shape.bounds().finite()) REQUIRE(ahead == 1);
  if (shape.bounds().finite()) REQUIRE((ahead % 2 == 1) == inside);
}

/// Checks that the roots that are left after the start's own was taken out are the true ones of
/// this very ray.
void require_true_roots(const Subject& subject, const ObjectRay& ray, const Vec3& normal,
                        const CrossingList& crossings) {
  constexpr double squarely = 0.01;
  if (std::abs(glm::dot(normal, ray.direction)) < squarely * glm::length(ray.direction)) return;
  const RealRay real(ray);
  const std::vector<Real> candidates = subject.candidates(real);
  for (const Crossing& crossing : crossings) {
    Real nearest = magnitude(candidates.front() - crossing.t);
    for (const Real root : candidates) nearest = std::min(nearest, magnitude(root - crossing.t));
    // The start itself is as exact as its coordinates.
    const double start = 8 * u * (glm::length(ray.origin) + 4 * subject.size) / squarely;
    REQUIRE(nearest <= (crossing.t == 0 ? start : 2 * crossing.error));
  }
}

}  // namespace

void check_starts(const MakeSubject& make, int count, bool convex) {
  Random random(5);
  int starts = 0;
  int exact = 0;
  while (starts < count) {
    const Subject subject = make(random);
    const auto shape = core::make_shape(subject.primitive);
    const ObjectRay first = random_ray(random, subject);
    CrossingList crossings;
    shape->crossings(first, crossings);
    for (const Crossing& crossing : crossings) {
      const core::SurfacePoint point = shape->surface_point(first, crossing);
      ObjectRay ray;
      ray.origin = point.position;
      ray.direction = random.direction();
      // A tenth leave at grazing angles, down to within the rounding of the surface itself.
      if (random.one_in(10)) {
        const double tilt = random.power_of_ten(-18, -2) * (random.one_in(2) ? 1 : -1);
        ray.direction -= glm::dot(ray.direction, point.normal) * point.normal;
        if (glm::length(ray.direction) < 0.1) continue;
        ray.direction += tilt * point.normal;
      }
      const bool outwards = glm::dot(ray.direction, point.normal) > 0;
      ray.start = {.face = crossing.face, .side = outwards ? Side::outside : Side::inside};
      check_start(*shape, ray, convex);
      CrossingList again;
      shape->crossings(ray, again);
      if (random.one_in(10)) require_true_roots(subject, ray, point.normal, again);
      if (std::any_of(again.begin(), again.end(), [](const Crossing& c) { return c.t == 0; }))
        ++exact;
      // The side counts even if the direction is at odds with it.
      if (random.one_in(20)) {
        ray.start.side = outwards ? Side::inside : Side::outside;
        check_start(*shape, ray, convex);
      }
      ++starts;
    }
  }
  // The start is a root for all but rays within the surface (of a box, one in six), or next to an
  // edge.
  CHECK(exact >= starts - starts / 4);
}

}  // namespace crt::test
