// Boxes whose crossings the proxy resolves (proxy_box.hpp, first_crossing.hpp) are compared with
// their shapes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "core/compile/compile.hpp"
#include "core/intersect/filter_rays.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261122;

struct Corners {
  Vec3 lower;
  Vec3 upper;

  Vec3 at(const Vec3& share) const { return lower + share * (upper - lower); }
};

Corners some_box(Numbers& numbers, double scale) {
  const Vec3 lower = scale * numbers.point(numbers.below(2) == 0 ? 1 : 1e6);
  const auto length = [&] { return scale * numbers.size(1e-6, 1); };
  const Vec3 size = numbers.below(2) == 0 ? Vec3(length()) : Vec3(length(), length(), length());
  return {lower, lower + size};
}

/// Returns a scene with the box, and others that touch it, coincide with it, or have a face in line
/// with one of its.
Scene neighbourhood(const Corners& box, Precision precision, Numbers& numbers) {
  Scene scene;
  scene.settings.precision = precision;
  const auto add = [&](const Vec3& a, const Vec3& b) {
    if (a.x != b.x && a.y != b.y && a.z != b.z)
      scene.entities.emplace_back(Box{.corner_a = a, .corner_b = b});
  };
  add(box.lower, box.upper);
  const Vec3 size = box.upper - box.lower;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 lower = box.lower;
    Vec3 upper = box.upper;
    lower[axis] = box.upper[axis];
    upper[axis] = box.upper[axis] + numbers.within(0.1, 2) * size[axis];
    if (numbers.below(2) == 0) add(lower, upper);
    // This box is in line with it, but elsewhere.
    lower = box.at(numbers.point(5));
    upper = lower + numbers.size(1e-2, 3) * size;
    (numbers.below(2) == 0 ? lower : upper)[axis] =
        numbers.below(2) == 0 ? box.lower[axis] : box.upper[axis];
    if (numbers.below(2) == 0) add(lower, upper);
  }
  if (numbers.below(4) == 0) add(box.lower, box.upper);
  // One box holds it, and one is within it.
  if (numbers.below(4) == 0) add(box.at(Vec3(-3)), box.at(Vec3(4)));
  if (numbers.below(4) == 0) add(box.at(Vec3(0.25)), box.at(Vec3(0.75)));
  Vec3 normal(0);
  normal[numbers.below(3)] = 1;
  if (numbers.below(4) == 0)
    scene.entities.emplace_back(Plane{.normal = normal, .position = box.lower});
  return scene;
}

/// Returns a ray to anywhere in and around the box, or to its corners and edges and a little beside
/// these.
WorldRay ray_near(const Corners& box, Numbers& numbers) {
  Vec3 share =
      numbers.below(2) == 0 ? Vec3(0.5) + numbers.point(0.5) : Vec3(0.5) + numbers.point(2);
  const int rims = numbers.below(4);
  for (int i = 0; i < rims; ++i) {
    const double off =
        numbers.below(2) == 0 ? 0 : numbers.size(1e-18, 1e-2) * numbers.within(-1, 1);
    share[numbers.below(3)] = numbers.below(2) + off;
  }
  const Vec3 place = box.at(share);
  Vec3 d = numbers.direction();
  if (numbers.below(4) == 0) {
    // Some are all but along the faces, or exactly along them. With two axes they are along an
    // edge.
    for (int axes = 1 + numbers.below(2); axes > 0; --axes) {
      const int axis = numbers.below(3);
      d[axis] = numbers.below(3) == 0 ? 0 : d[axis] * numbers.size(1e-300, 1e-3);
    }
    if (!(largest_component(d) > 0)) d = {0, 0, 1};
    d = glm::normalize(d);
  }
  if (numbers.below(4) == 0) d *= numbers.size(1e-3, 1e3);
  // Rays start inside, nearby, or so far away that the distance leaves no digits for the box.
  const double size = largest_component(box.upper - box.lower);
  const double away = size * (numbers.below(3) == 0 ? numbers.within(0, 1) : numbers.size(1, 1e20));
  WorldRay ray{.origin = place - away * d, .direction = d};
  if (numbers.below(4) == 0) ray.t_min = numbers.within(-1, 2) * away;
  if (numbers.below(4) == 0) ray.t_max = ray.t_min + numbers.within(0, 2) * away;
  return ray;
}

/// Continues rays from where they hit something, to anywhere, along the surface, or to the edge of
/// a box.
void go_on_around(const PreparedData& data, const Corners& box, Numbers& numbers,
                  RayWorkspace& work, std::vector<WorldRay>& rays) {
  const double size = largest_component(box.upper - box.lower);
  go_on(data, numbers, work, rays, [&](const HitPoint& point, WorldRay& ray) {
    const Vec3 to = ray_near(box, numbers).origin;
    const Vec3 along = numbers.direction() - point.normal;
    if (numbers.below(3) == 0) ray.direction = to - ray.origin;
    if (numbers.below(6) == 0) ray.direction = along - glm::dot(along, point.normal) * point.normal;
    if (numbers.below(16) == 0) ray.t_min = numbers.within(0, 1) * size;
    if (numbers.below(16) == 0) ray.origin += 1e-9 * size * numbers.point(1);
  });
}

/// Checks whether rays to what they hit see it.
void check_to_surfaces(const PreparedData& data, std::vector<WorldRay> rays, RayWorkspace& work) {
  std::vector<RayHit> line;
  for (WorldRay& ray : rays) {
    const RayHit hit = data.intersect(ray, work);
    if (!hit.found()) continue;
    ray.t_max = hit.t;
    ray.end_error = start_rounding * largest_component(data.hit_point(ray, hit).position);
  }
  const RayMask hidden = occluded_as_packet(data, rays, work);
  for (std::size_t k = 0; k < rays.size(); ++k) {
    data.crossings(rays[k], line, work);
    REQUIRE(data.occluded(rays[k], work) == !line.empty());
    REQUIRE(((hidden >> k & 1u) != 0) == !line.empty());
  }
}

void check_boxes(Precision precision, int rounds) {
  Numbers numbers(seed);
  RayWorkspace work;
  int met = 0;
  for (int round = 0; round < rounds; ++round) {
    const Corners box = some_box(numbers, numbers.size(1e-90, 1e90));
    const PreparedData data(neighbourhood(box, precision, numbers));
    for (int i = 0; i < 100; ++i) {
      std::vector<WorldRay> rays(
          static_cast<std::size_t>(1 + numbers.below(static_cast<int>(packet_size))));
      for (WorldRay& ray : rays) ray = ray_near(box, numbers);
      for (int bounce = 0; bounce < 3; ++bounce) {
        check_first_crossings(data, rays, work, met);
        check_to_surfaces(data, rays, work);
        go_on_around(data, box, numbers, work, rays);
      }
    }
  }
  CHECK(met > 50 * rounds);
}

}  // namespace

TEST_CASE("a ray finds the same alone, in a packet, and without cheap tests at boxes") {
  check_boxes(Precision::standard, 150);
}

TEST_CASE("so it does at boxes in the exact tier") {
  check_boxes(Precision::exact, 20);
}

TEST_CASE("the proxy of a box tells nearly all rays where they first cross it") {
  Numbers numbers(seed);
  const Entity entities[] = {Box{.corner_a = {1, 2, 3}, .corner_b = {2, 5, 4}}};
  const CompiledScene scene = compile(entities);
  const std::uint32_t first[] = {0};
  const BoundingProxies proxies(scene, first);
  int unknown = 0;
  int found = 0;
  constexpr int count = 10'000;
  for (int i = 0; i < count; ++i) {
    const WorldRay ray{.origin = Vec3(1.5, 3, 3.5) + numbers.point(2),
                       .direction = numbers.direction()};
    const PacketStartsOf<1> starts;
    const SingleRay packet(ray, starts, 1);
    const FilterRays<double> filter(packet);
    typename FilterRays<double>::Parts parts;
    const BoundingProxy& proxy = proxies.list.front();
    const Decision<RayMask> decision = filter.decide(proxy, 1, {}, false, parts);
    if (decision.rejected != 0) continue;
    const FirstCrossing<double> crossing = filter.first_crossing(proxy, 0, 1, {}, &parts[0]);
    unknown += crossing.unknown ? 1 : 0;
    found += crossing.found ? 1 : 0;
    const FirstCrossing<double> at_once = filter.first_crossing(proxy, 0, 1, {}, nullptr);
    CHECK(at_once.found == crossing.found);
    CHECK(at_once.unknown == crossing.unknown);
    if (!crossing.found) continue;
    CHECK(at_once.entering == crossing.entering);
    CHECK(at_once.t == crossing.t);
    CHECK(at_once.error == crossing.error);
    CHECK(at_once.face == crossing.face);
  }
  CHECK(unknown == 0);
  CHECK(found > count / 20);
}
