#include "core/geometry/rounded_box/rounded_box.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "crt/error.hpp"
#include "geometry/oracle.hpp"

using namespace crt;
using namespace crt::test;

namespace {

RealVec corner_of(const RoundedBox& box, bool is_upper) {
  return RealVec(is_upper ? glm::max(box.corner_a, box.corner_b)
                          : glm::min(box.corner_a, box.corner_b));
}

/// Returns how far a point is beyond the inner box along each axis.
RealVec beyond(const RoundedBox& box, const RealVec& p) {
  const RealVec lower = corner_of(box, false);
  const RealVec upper = corner_of(box, true);
  const Real radius = core::radius_of(box);
  RealVec result;
  for (int axis = 0; axis < 3; ++axis) {
    const Real below = p[axis] - (lower[axis] + radius);
    const Real above = p[axis] - (upper[axis] - radius);
    result[axis] = below < 0 ? below : (above > 0 ? above : Real(0));
  }
  return result;
}

/// Returns the distance from the surface, negative inside, where it is less than the radius.
Real field_of(const RoundedBox& box, const RealVec& p) {
  return length(beyond(box, p)) - Real(core::radius_of(box));
}

/// Returns where a line meets the planes of all flat faces and of the inner box, the endless
/// cylinders of the edges and the spheres of the corners.
std::vector<Real> candidates_of(const RoundedBox& box, const RealRay& ray) {
  const RealVec corners[] = {corner_of(box, false), corner_of(box, true)};
  const Real radius = core::radius_of(box);
  std::vector<Real> all;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {0, 1}) {
      RealVec normal;
      normal[axis] = 1;
      RealVec inner = corners[side];
      inner[axis] = inner[axis] + (side == 0 ? radius : -radius);
      for (const RealVec& position : {corners[side], inner}) {
        const auto roots = plane_roots(ray, normal, position);
        all.insert(all.end(), roots.begin(), roots.end());
      }
    }
  }
  for (int parts = 0; parts < 27; ++parts) {
    const int sides[] = {parts % 3, parts / 3 % 3, parts / 9};
    Real a = 0;
    Real b = 0;
    Real c = -radius * radius;
    for (int axis = 0; axis < 3; ++axis) {
      if (sides[axis] == 2) continue;
      const Real corner = sides[axis] == 0 ? corners[0][axis] + radius : corners[1][axis] - radius;
      const Real offset = ray.origin[axis] - corner;
      a = a + ray.direction[axis] * ray.direction[axis];
      b = b + offset * ray.direction[axis];
      c = c + offset * offset;
    }
    if (a == 0) continue;
    const auto roots = quadratic_roots(a, b, c);
    all.insert(all.end(), roots.begin(), roots.end());
  }
  return all;
}

RoundedBox random_box(Random& random, const Vec3& center, double size) {
  RoundedBox box{.corner_a = center + size * random.in_cube(),
                 .corner_b = center + size * random.in_cube()};
  const double largest = core::largest_radius(box);
  box.radius = random.one_in(6) ? largest
                                : largest * (random.one_in(4) ? random.power_of_ten(-5, 0)
                                                              : random.uniform(0, 1));
  return box;
}

Subject random_rounded_box(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (size * random.power_of_ten(-2, 2));
  const RoundedBox box = random_box(random, center, size);
  return {.primitive = box,
          .center = 0.5 * (box.corner_a + box.corner_b),
          .size = 0.5 * glm::length(box.corner_a - box.corner_b),
          .candidates = [=](const RealRay& ray) { return candidates_of(box, ray); },
          .field = [=](const RealVec& p) { return field_of(box, p); }};
}

core::CrossingList crossings(const Primitive& primitive, const core::ObjectRay& ray) {
  core::CrossingList result;
  core::make_shape(primitive)->crossings(ray, result);
  return result;
}

std::string fault(const RoundedBox& box) {
  try {
    core::validate(Primitive(box));
  } catch (const Error& error) {
    return error.argument() + ": " + error.what();
  }
  return "";
}

/// Returns the face that is met at a point with such a normal, from outside.
std::uint32_t face_with(const RoundedBox& box, const Vec3& normal) {
  Vec3 target;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.corner_a[axis] + box.radius;
    const double high = box.corner_b[axis] - box.radius;
    target[axis] = normal[axis] < 0 ? low : (normal[axis] > 0 ? high : 0.5 * (low + high));
  }
  const auto found = crossings(box, {.origin = target + 9.0 * normal, .direction = -normal});
  REQUIRE(found.size() == 2);
  return found[0].face;
}

const RoundedBox brick{.corner_a = {0, 0, 0}, .corner_b = {4, 3, 2}, .radius = 0.5};

}  // namespace

TEST_CASE("rounded box: crossings are the true ones within their error") {
  check_against_oracle(random_rounded_box, 50000);
}
TEST_CASE("rounded box: powers of two scale it to the bit") {
  check_scaling(random_rounded_box, 2000);
}
TEST_CASE("rounded box: a ray turned round meets the same points") {
  check_reversal(random_rounded_box, 20000);
}
TEST_CASE("rounded box: points, normals and (u, v)") {
  check_surface_points(random_rounded_box, 10000, true);
}
TEST_CASE("rounded box: a ray that starts on it obeys its side") {
  check_starts(random_rounded_box, 100000, true);
}

TEST_CASE("rounded box: each face is met where it is, and has the number that is said") {
  const double s = std::sqrt(0.5);
  const double c = std::sqrt(1.0 / 3);
  std::uint32_t face = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vec3 normal(0);
      normal[axis] = side;
      CHECK(face_with(brick, normal) == face++);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int first = axis == 0 ? 1 : 0;
    const int second = axis == 2 ? 1 : 2;
    for (const double far : {-s, s}) {
      for (const double near : {-s, s}) {
        Vec3 normal(0);
        normal[first] = near;
        normal[second] = far;
        CHECK(face_with(brick, normal) == face++);
      }
    }
  }
  for (const double z : {-c, c}) {
    for (const double y : {-c, c}) {
      for (const double x : {-c, c}) CHECK(face_with(brick, {x, y, z}) == face++);
    }
  }
  CHECK(face == core::make_shape(brick)->face_count());
  for (std::uint32_t i = 0; i < face; ++i) CHECK(core::face_at(core::sides_of(i)) == i);
}

TEST_CASE("rounded box: flat faces are met at the bits of a box, and it is one without a radius") {
  Random random(31);
  int flat = 0;
  for (int i = 0; i < 5000; ++i) {
    const double size = random.power_of_ten(-6, 6);
    RoundedBox box = random_box(random, size * random.in_cube(), size);
    const Vec3 direction = random.direction();
    const Vec3 middle = 0.5 * (box.corner_a + box.corner_b);
    const core::ObjectRay ray{.origin = middle + size * random.in_cube() - 5 * size * direction,
                              .direction = direction};
    const core::CrossingList of_box = crossings(core::box_of(box), ray);
    for (const core::Crossing& crossing : crossings(box, ray)) {
      if (crossing.face >= core::flat_faces_of_box) continue;
      const bool is_same = std::any_of(of_box.begin(), of_box.end(), [&](const auto& other) {
        return other.face == crossing.face && other.t == crossing.t && other.root == crossing.root;
      });
      REQUIRE(is_same);
      ++flat;
    }
    box.radius = 0;
    const core::CrossingList sharp = crossings(box, ray);
    REQUIRE(sharp.size() == of_box.size());
    for (std::size_t k = 0; k < sharp.size(); ++k) REQUIRE(sharp[k].t == of_box[k].t);
  }
  CHECK(flat > 1000);
}

TEST_CASE("rounded box: with half of a side as radius it is a ball or a capsule") {
  Random random(32);
  const RoundedBox cube{.corner_a = {1, 2, 3}, .corner_b = {5, 6, 7}, .radius = 2};
  const Sphere ball{.center = {3, 4, 5}, .radius = 2};
  const RoundedBox bar{.corner_a = {-1, -3, -1}, .corner_b = {1, 5, 1}, .radius = 1};
  const Capsule capsule{.from = {0, -2, 0}, .to = {0, 4, 0}, .radius = 1};
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const bool is_ball = random.one_in(2);
    const Vec3 direction = random.direction();
    const Vec3 aim = is_ball ? ball.center : Vec3(0, 1, 0);
    const core::ObjectRay ray{.origin = aim + 3.0 * random.in_cube() - 9.0 * direction,
                              .direction = direction};
    const auto found = crossings(is_ball ? cube : bar, ray);
    const auto expected = is_ball ? crossings(ball, ray) : crossings(capsule, ray);
    REQUIRE(found.size() == expected.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      REQUIRE(std::abs(found[k].t - expected[k].t) <= found[k].error + expected[k].error);
    hits += found.empty() ? 0 : 1;
  }
  CHECK(hits > 5000);
}

TEST_CASE("rounded box: a ray through a seam goes in and out once") {
  Random random(33);
  int at_seams = 0;
  for (int i = 0; i < 200000; ++i) {
    const double size = random.power_of_ten(-6, 6);
    const RoundedBox box = random_box(random, size * random.in_cube(), size);
    const Vec3 lower = glm::min(box.corner_a, box.corner_b) + box.radius;
    const Vec3 upper = glm::max(box.corner_a, box.corner_b) - box.radius;
    // The normal of a seam has a component of 0 at least, and is at a corner of the inner box.
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = (random.one_in(2) ? lower : upper)[axis];
    Vec3 out = random.in_cube();
    out[static_cast<int>(random.bits() % 3)] = 0;
    if (random.one_in(2)) out[static_cast<int>(random.bits() % 3)] = 0;
    if (out == Vec3(0)) continue;
    out = glm::normalize(out);
    for (int axis = 0; axis < 3; ++axis) {
      if (out[axis] != 0) place[axis] = (out[axis] < 0 ? lower : upper)[axis];
    }
    Vec3 direction = random.direction();
    // Half of the rays graze it.
    if (random.one_in(2)) {
      direction = glm::normalize(glm::cross(out, random.in_cube())) +
                  random.power_of_ten(-17, -1) * random.in_cube();
    }
    const double distance = random.one_in(4) ? 0 : size * random.power_of_ten(-3, 3);
    const core::ObjectRay ray{.origin = place + box.radius * out - distance * direction,
                              .direction = direction};
    const core::CrossingList found = crossings(box, ray);
    REQUIRE((found.empty() || found.size() == 2));
    const double squareness = std::abs(glm::dot(out, direction)) / glm::length(direction);
    const bool is_thin = box.radius < 1e-3 * size;
    if (squareness > 1e-4 && !is_thin) REQUIRE(found.size() == 2);
    if (found.empty()) continue;
    REQUIRE(found[0].entering);
    REQUIRE_FALSE(found[1].entering);
    REQUIRE(found[0].t < found[1].t);
    if (squareness < 1e-4) continue;
    const RealRay real(ray);
    for (const core::Crossing& crossing : found) {
      const double far = glm::length(ray.origin) + 8 * size;
      REQUIRE(magnitude(field_of(box, real.at(crossing.t))) <= 0x1p-49 * far);
      at_seams += std::abs(crossing.t - distance) <= 1e-9 * size ? 1 : 0;
    }
  }
  CHECK(at_seams > 50000);
}

TEST_CASE("rounded box: errors are true ones next to seams, too, and for lines along faces") {
  Random random(34);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const double size = random.power_of_ten(-6, 6);
    const RoundedBox box = random_box(random, size * random.in_cube(), size);
    const Vec3 lower = glm::min(box.corner_a, box.corner_b) + box.radius;
    const Vec3 upper = glm::max(box.corner_a, box.corner_b) - box.radius;
    // The line is all but in the plane of a face, or in a plane that touches an edge.
    const int axis = static_cast<int>(random.bits() % 3);
    const int other = (axis + 1) % 3;
    Vec3 out(0);
    out[axis] = random.one_in(2) ? -1 : 1;
    out[other] = random.one_in(2) ? 0 : random.uniform(-1, 1);
    out = glm::normalize(out);
    Vec3 target = lower + 0.5 * (upper - lower);
    target[axis] = (out[axis] < 0 ? lower : upper)[axis];
    target[other] = (random.one_in(2) ? lower : upper)[other];
    target += box.radius * (1 - random.power_of_ten(-17, -1)) * out;
    Vec3 direction = glm::cross(out, random.in_cube());
    if (random.one_in(3)) direction = glm::cross(out, Vec3(axis == 0, axis == 1, axis == 2));
    if (glm::length(direction) < 0.1) continue;
    direction += random.power_of_ten(-17, -2) * random.in_cube();
    const core::ObjectRay ray{.origin = target - size * random.power_of_ten(-2, 2) * direction,
                              .direction = direction};
    const core::CrossingList found = crossings(box, ray);
    const RealRay real(ray);
    std::vector<Real> places = candidates_of(box, real);
    std::sort(places.begin(), places.end());
    std::vector<Real> ends;
    bool inside = false;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
      const bool is_inside = field_of(box, real.at((places[k] + places[k + 1]) / 2)) < 0;
      if (is_inside != inside) ends.push_back(places[k]);
      inside = is_inside;
    }
    // Whether it is a hit at all may be left to rounding.
    if (found.size() != 2 || ends.size() != 2) continue;
    for (std::size_t k = 0; k < 2; ++k) REQUIRE(magnitude(ends[k] - found[k].t) <= found[k].error);
    ++compared;
  }
  CHECK(compared > 5000);
}

TEST_CASE("rounded box: lines along faces, edges and tangents do not enter") {
  CHECK(crossings(brick, {.origin = {-5, 3, 1}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(brick, {.origin = {2, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(brick, {.origin = {-5, 3, 0}, .direction = {1, 0, 0}}).empty());
  CHECK(crossings(brick, {.origin = {0.5, -5, 0}, .direction = {0, 1, 0}}).empty());
  CHECK(crossings(brick, {.origin = {0, 0, -5}, .direction = {0, 0, 1}}).empty());
  const double below = 3 - 0x1p-51;
  const auto within = crossings(brick, {.origin = {-5, below, 1}, .direction = {1, 0, 0}});
  REQUIRE(within.size() == 2);
  CHECK(within[0].t == doctest::Approx(5.5).epsilon(1e-7));
  CHECK(within[1].t == doctest::Approx(8.5).epsilon(1e-7));
}

TEST_CASE("rounded box: on the plane of a face, but beside it, a ray goes on to where it enters") {
  // The ray starts above the edge at the lower x and the upper y, on another solid's face there.
  core::ObjectRay ray{.origin = {0, 3, 1}, .direction = {1, -1, 0}};
  ray.start = {.face = 3, .side = core::Side::inside, .on_face = false};
  const auto found = crossings(brick, ray);
  REQUIRE(found.size() == 2);
  CHECK(found[0].face == 16);
  CHECK(found[0].t == doctest::Approx(0.5 - std::sqrt(0.125)).epsilon(1e-14));
  CHECK(found[1].t == 3);
  ray.start.side = core::Side::outside;
  ray.direction = {1, 1, 0};
  for (const core::Crossing& crossing : crossings(brick, ray)) CHECK(crossing.t <= 0);
}

TEST_CASE("rounded box: (u, v) are those of the box beside, without a jump at a flat face") {
  const auto shape = core::make_shape(brick);
  const auto at = [&](const Vec3& origin, const Vec3& direction) {
    core::CrossingList list;
    shape->crossings({.origin = origin, .direction = direction}, list);
    REQUIRE(!list.empty());
    return shape->surface_point({.origin = origin, .direction = direction}, list[0]);
  };
  const auto from_above = [&](double x, double z) { return at({x, 9, z}, {0, -1, 0}); };
  for (const double x : {0.2, 0.5 - 1e-9, 0.5, 0.5 + 1e-9, 2.0, 3.8}) {
    const auto point = from_above(x, 1);
    CHECK(point.u == doctest::Approx(x / 4).epsilon(1e-12));
    CHECK(point.v == doctest::Approx(0.5).epsilon(1e-12));
  }
  CHECK(from_above(0.2, 0.3).v == doctest::Approx(0.15).epsilon(1e-12));
  // Lower on the rounding the normal is nearest to that of the side.
  const auto side = at({-9, 2.6, 0.7}, {1, 0, 0});
  CHECK(side.u == doctest::Approx(0.35).epsilon(1e-12));
  CHECK(side.v == doctest::Approx(2.6 / 3).epsilon(1e-12));
}

TEST_CASE("rounded box: its box is that of its corners") {
  const core::Bounds box = core::make_shape(brick)->bounds();
  CHECK(box.lower == Vec3(0, 0, 0));
  CHECK(box.upper == Vec3(4, 3, 2));
}

TEST_CASE("rounded box: the radius is at most half of the shortest side, but for rounding") {
  CHECK(fault({.corner_a = {0, 0, 0}, .corner_b = {1, -2, 3}, .radius = 0.5}) == "");
  CHECK(fault({.corner_a = {0, 0, 0}, .corner_b = {1, -2, 3}, .radius = 0.51}) ==
        "radius: radius must be at most 0.5, half of the shortest side (it is 0.51)");
  CHECK(fault({.radius = -1}) == "radius: radius must not be negative (it is -1)");
  // The sides are not quite as long as 0.2.
  const RoundedBox ball{.corner_a = {0.1, 0.1, 0.1}, .corner_b = {0.3, 0.3, 0.3}, .radius = 0.1};
  CHECK(fault(ball) == "");
  CHECK(core::radius_of(ball) < 0.1);
  CHECK(crossings(ball, {.origin = {-1, 0.2, 0.2}, .direction = {1, 0, 0}}).size() == 2);
}

TEST_CASE("rounded box: extreme shapes give finite answers") {
  const RoundedBox sheet{
      .corner_a = {-1e100, -1e-100, -1e100}, .corner_b = {1e100, 1e-100, 1e100}, .radius = 1e-100};
  const auto through = crossings(sheet, {.origin = {0, 3e-100, 0}, .direction = {0, -1, 0}});
  REQUIRE(through.size() == 2);
  CHECK(through[0].t == doctest::Approx(2e-100).epsilon(1e-15));
  CHECK(through[1].t == doctest::Approx(4e-100).epsilon(1e-15));
  const RoundedBox sharp{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}, .radius = 1e-100};
  CHECK(crossings(sharp, {.origin = {-3, -3, -3}, .direction = {1, 1, 1}}).size() == 2);
  CHECK(crossings(sharp, {.origin = {-3, -3.5, -3}, .direction = {1, 1, 1}}).size() == 2);
}
