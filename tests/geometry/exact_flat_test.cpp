// Planes, half planes, discs, triangles and boxes of the exact tier are compared with whole-number
// arithmetic.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "geometry/exact_tools.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// A WholeMeeting is where a whole-number line meets a plane: t = numerator / denominator, with
/// denominator > 0.
struct WholeMeeting {
  bool found = false;
  Whole numerator = 0;
  Whole denominator = 1;
  bool entering = false;
  WholeVec offset{};  ///< from the position, times denominator * weight

  WholeMeeting(const WholeRay& ray, const WholeVec& normal, const WholeVec& position) {
    denominator = dot(normal, ray.direction);
    numerator = dot(normal, ray.weight * position - ray.origin);
    if (denominator == 0) return;
    found = true;
    entering = denominator < 0;
    if (entering) {
      denominator = -denominator;
      numerator = -numerator;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      offset[i] =
          denominator * (ray.origin[i] - ray.weight * position[i]) + numerator * ray.direction[i];
    }
  }
  Real t() const { return static_cast<Real>(numerator) / static_cast<Real>(denominator); }
};

WholeVec small_direction(Random& random) {
  WholeVec v;
  do v = small_vector(random, 3);
  while (dot(v, v) == 0);
  return v;
}

void require_hit(const core::CrossingList& found, bool hit, const WholeMeeting& meeting) {
  REQUIRE(found.size() == (hit ? 1 : 0));
  if (!hit) return;
  REQUIRE(is_last_bit(found[0], meeting.t()));
  REQUIRE(found[0].entering == meeting.entering);
}

}  // namespace

TEST_CASE("exact plane: t is right to the last bit, and parallel lines are on the right side") {
  Random random(11);
  for (int i = 0; i < 20000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec normal = small_direction(random);
    const WholeVec position = small_vector(random, 4);
    const WholeMeeting meeting(ray, normal, position);
    const Plane plane{.normal = as_vec3(normal), .position = as_vec3(position)};
    require_hit(exact_crossings(plane, ray), meeting.found, meeting);
  }
}

TEST_CASE("exact disc: its rim belongs to it") {
  Random random(12);
  int rims = 0;
  for (int i = 0; i < 40000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec normal = small_direction(random);
    const WholeVec center = small_vector(random, 4);
    const Whole radius = 1 + static_cast<Whole>(random.bits() % 5);
    const WholeMeeting meeting(ray, normal, center);
    const Whole reach = radius * meeting.denominator * ray.weight;
    const Whole room = reach * reach - dot(meeting.offset, meeting.offset);
    rims += meeting.found && room == 0 ? 1 : 0;
    const Disc disc{.center = as_vec3(center),
                    .normal = as_vec3(normal),
                    .radius = static_cast<double>(radius)};
    require_hit(exact_crossings(disc, ray), meeting.found && room >= 0, meeting);
  }
  CHECK(rims > 50);
}

TEST_CASE("exact half plane: its edge belongs to it") {
  Random random(13);
  int edges = 0;
  for (int i = 0; i < 40000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec normal = small_direction(random);
    const WholeVec position = small_vector(random, 4);
    const WholeVec direction = small_direction(random);
    const WholeVec edge = cross(normal, direction);
    if (dot(edge, edge) == 0) continue;
    const WholeMeeting meeting(ray, normal, position);
    // The direction's component across the normal is n x (direction x n).
    const Whole inward = dot(meeting.offset, cross(edge, normal));
    edges += meeting.found && inward == 0 ? 1 : 0;
    const HalfPlane half_plane{
        .normal = as_vec3(normal), .position = as_vec3(position), .direction = as_vec3(direction)};
    require_hit(exact_crossings(half_plane, ray), meeting.found && inward >= 0, meeting);
  }
  CHECK(edges > 100);
}

TEST_CASE("exact triangle: its edges and corners belong to it") {
  Random random(14);
  int edges = 0;
  for (int i = 0; i < 40000; ++i) {
    const WholeRay ray = small_ray(random);
    const std::array<WholeVec, 3> corners = {small_vector(random, 5), small_vector(random, 5),
                                             small_vector(random, 5)};
    const WholeVec normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    if (dot(normal, normal) == 0) continue;
    const WholeMeeting meeting(ray, normal, corners[0]);
    // In the plane the point must be on the inner side of all three edges.
    bool inside = meeting.found;
    bool on_edge = false;
    for (std::size_t k = 0; k < 3 && meeting.found; ++k) {
      const WholeVec from =
          meeting.offset - (meeting.denominator * ray.weight) * (corners[k] - corners[0]);
      const Whole side = dot(normal, cross(corners[(k + 1) % 3] - corners[k], from));
      inside = inside && side >= 0;
      on_edge = on_edge || side == 0;
    }
    edges += inside && on_edge ? 1 : 0;
    const Triangle triangle{
        .a = as_vec3(corners[0]), .b = as_vec3(corners[1]), .c = as_vec3(corners[2])};
    require_hit(exact_crossings(triangle, ray), inside, meeting);
  }
  CHECK(edges > 100);
}

TEST_CASE("exact box: lines along its faces and through its edges miss it, lines within hit") {
  Random random(15);
  int touching = 0;
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const WholeRay ray = small_ray(random);
    const WholeVec a = small_vector(random, 4);
    const WholeVec b = small_vector(random, 4);
    if (a[0] == b[0] || a[1] == b[1] || a[2] == b[2]) continue;
    // These are the largest t of entering and the smallest of leaving, as fractions.
    bool parallel_outside = false;
    WholeVec enter{-1, 0, 0};
    WholeVec leave{1, 0, 0};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Whole low = ray.weight * std::min(a[axis], b[axis]) - ray.origin[axis];
      const Whole high = ray.weight * std::max(a[axis], b[axis]) - ray.origin[axis];
      const Whole speed = ray.direction[axis];
      if (speed == 0) {
        parallel_outside = parallel_outside || low >= 0 || high <= 0;
        continue;
      }
      const WholeVec first{speed > 0 ? low : -high, speed > 0 ? speed : -speed, 0};
      const WholeVec last{speed > 0 ? high : -low, first[1], 0};
      if (enter[1] == 0 || first[0] * enter[1] > enter[0] * first[1]) enter = first;
      if (leave[1] == 0 || last[0] * leave[1] < leave[0] * last[1]) leave = last;
    }
    const Whole room = leave[0] * enter[1] - enter[0] * leave[1];
    const bool hit = !parallel_outside && room > 0;
    touching += !parallel_outside && room == 0 ? 1 : 0;
    const core::CrossingList found =
        exact_crossings(Box{.corner_a = as_vec3(a), .corner_b = as_vec3(b)}, ray);
    REQUIRE(found.size() == (hit ? 2 : 0));
    if (!hit) continue;
    ++hits;
    REQUIRE(is_last_bit(found[0], static_cast<Real>(enter[0]) / static_cast<Real>(enter[1])));
    REQUIRE(is_last_bit(found[1], static_cast<Real>(leave[0]) / static_cast<Real>(leave[1])));
  }
  CHECK(touching > 100);
  CHECK(hits > 2000);
}

TEST_CASE("exact flat primitives: one ulp decides at edges, far away and in a turned space") {
  const Transform turn{{3, -4, 0}, {4, 3, 0}, {0, 0, 5}, {0, 0, 0}};
  for (const double far : {1.0, 1e9, 1e15}) {
    const auto count = [&](const Primitive& primitive, double x) {
      return exact_crossings(primitive, turn, {x, 4, -far}, {0, 0, 1}).size();
    };
    // (3, 4) in the world is (1, 0) here, and +x in the world is (3, -4) up to a factor.
    const double less = std::nextafter(3, 0);
    const double more = std::nextafter(3, 4);
    const Disc disc{.center = {0, 0, 0}, .normal = {0, 0, 1}, .radius = 1};
    CHECK(count(disc, 3) == 1);
    CHECK(count(disc, less) == 1);
    CHECK(count(disc, more) == 0);
    const HalfPlane half_plane{.normal = {0, 0, 1}, .position = {1, 0, 0}, .direction = {-1, 0, 0}};
    CHECK(count(half_plane, 3) == 1);
    CHECK(count(half_plane, less) == 1);
    CHECK(count(half_plane, more) == 0);
    const Triangle triangle{.a = {1, -1, 0}, .b = {1, 1, 0}, .c = {-1, 0, 0}};
    CHECK(count(triangle, 3) == 1);
    CHECK(count(triangle, less) == 1);
    CHECK(count(triangle, more) == 0);
    const Box box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}};
    CHECK(count(box, 3) == 0);
    CHECK(count(box, less) == 2);
    CHECK(count(box, more) == 0);
  }
}

TEST_CASE("exact flat primitives: powers of two scale them to the bit") {
  Random random(16);
  for (int i = 0; i < 2000; ++i) {
    const std::array<Primitive, 3> primitives = {
        Primitive(Disc{.center = random.in_cube(), .normal = random.in_cube(), .radius = 1}),
        Primitive(Triangle{.a = random.in_cube(), .b = random.in_cube(), .c = random.in_cube()}),
        Primitive(Box{.corner_a = random.in_cube(), .corner_b = random.in_cube()})};
    const Vec3 origin = random.in_cube() * 4.0;
    const Vec3 direction = random.in_cube() - origin;
    for (const Primitive& primitive : primitives) {
      for (const int power : {-300, 300}) {
        const double factor = std::ldexp(1.0, power);
        const auto here = exact_crossings(primitive, {}, origin, direction);
        const auto there =
            exact_crossings(scaled(primitive, factor), {}, origin * factor, direction);
        REQUIRE(here.size() == there.size());
        for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(here[k].t * factor == there[k].t);
      }
    }
  }
}
