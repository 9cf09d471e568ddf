// Tori whose first crossings are found without their other ones (first_crossing.hpp) are compared
// with their shapes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "core/compile/compile.hpp"
#include "core/geometry/torus/spans.hpp"
#include "core/intersect/filter_rays.hpp"
#include "core/prepare/prepared_data.hpp"
#include "support/numbers.hpp"
#include "support/placed.hpp"
#include "support/same_answers.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

constexpr std::uint64_t seed = 20261123;

using PlacedTorus = Placed<Torus>;

/// Returns a torus that is thin, fat or a spindle. It is not moved, moved, turned, or scaled
/// unevenly.
PlacedTorus some_torus(Numbers& numbers, double scale) {
  PlacedTorus placed;
  const double ring = scale * numbers.size(1e-2, 1);
  const double share = numbers.below(3) == 0   ? numbers.size(1e-4, 1e-1)
                       : numbers.below(2) == 0 ? numbers.within(0.1, 1)
                                               : numbers.size(1, 30);
  const Vec3 axis = numbers.below(3) == 0 ? Vec3(0, 1, 0) : numbers.direction();
  placed.primitive = {.center = scale * numbers.point(numbers.below(2) == 0 ? 1 : 1e3),
                      .axis = axis,
                      .radius = ring,
                      .thickness = ring * share};
  placed.steps = some_steps(numbers, scale);
  return placed;
}

/// Returns a ray through the torus, along its surface, through its hole, or past it.
WorldRay ray_near(const PlacedTorus& placed, Numbers& numbers) {
  const Torus& torus = placed.primitive;
  const Vec3 axis = glm::normalize(torus.axis);
  const Vec3 radial = glm::normalize(glm::cross(axis, numbers.direction()));
  const double turn = numbers.within(0, 6.3);
  const Vec3 normal = std::cos(turn) * radial + std::sin(turn) * axis;
  const double off = numbers.below(3) == 0   ? 1 + numbers.size(1e-17, 1e-2) * numbers.within(-1, 1)
                     : numbers.below(2) == 0 ? numbers.within(0, 1)
                                             : numbers.within(0, 3);
  const Vec3 place = torus.center + torus.radius * radial + off * torus.thickness * normal;
  Vec3 d = numbers.direction();
  if (numbers.below(3) == 0) d = d - glm::dot(d, normal) * normal;
  if (numbers.below(8) == 0) d = numbers.below(2) == 0 ? axis : radial;
  if (!(largest_component(d) > 0)) d = axis;
  return ray_through(placed, place, d, torus.radius + torus.thickness, numbers);
}

void check_tori(Precision precision, int rounds) {
  Numbers numbers(seed);
  int met = 0;
  for (int round = 0; round < rounds; ++round) {
    const double scale = numbers.size(1e-9, 1e9);
    const PlacedTorus placed = some_torus(numbers, scale);
    Scene scene;
    scene.settings.precision = precision;
    scene.entities = {placed.entity()};
    const Vec3 center = placed.to_place(placed.primitive.center);
    if (numbers.below(2) == 0) {
      scene.entities.emplace_back(Plane{.normal = numbers.direction(), .position = center});
    }
    // One torus is turned about its axis only, and others lie across it.
    if (numbers.below(4) == 0) scene.entities.push_back(placed.entity());
    for (int i = numbers.below(3); i > 0; --i) {
      PlacedTorus other = placed;
      other.primitive.axis = numbers.direction();
      scene.entities.push_back(other.entity());
    }
    const PreparedData data(scene);
    check_bounces(
        data, numbers, 100, [&] { return ray_near(placed, numbers); }, met, true);
  }
  CHECK(met > 300 * rounds);
}

/// A LineInFrame is a line in a torus's frame, with what lies beside it in the three other lanes.
struct LineInFrame {
  Vec3 point;
  Vec3 direction;
};

LineInFrame some_line(Numbers& numbers, double ring, double tube) {
  const double turn = numbers.within(0, 6.3);
  const Vec3 radial(std::cos(turn), std::sin(turn), 0);
  const double off = numbers.below(2) == 0 ? numbers.within(0, 1.2) : 1 + numbers.size(1e-17, 1e-3);
  const double round = numbers.within(0, 6.3);
  const Vec3 normal = std::cos(round) * radial + Vec3(0, 0, std::sin(round));
  Vec3 d = numbers.direction();
  if (numbers.below(3) == 0) d = d - glm::dot(d, normal) * normal;
  if (numbers.below(6) == 0) d = {0, 0, 1};
  if (numbers.below(6) == 0) d.z = 0;
  if (!(largest_component(d) > 0)) d = {1, 0, 0};
  const Vec3 place = ring * radial + off * tube * normal;
  return {place - numbers.within(-2, 2) * d, scaled_to_one(d)};
}

}  // namespace

TEST_CASE("a ray finds the same alone, in a packet, and without cheap tests at tori") {
  check_tori(Precision::standard, 300);
}

TEST_CASE("so it does at tori in the exact tier") {
  check_tori(Precision::exact, 20);
}

TEST_CASE("lines side by side enter a torus where each enters it, to the last bit") {
  Numbers numbers(seed);
  int found = 0;
  for (int i = 0; i < 20'000; ++i) {
    const double ring = numbers.size(1e-2, 1);
    const double tube = numbers.size(1e-3, 1);
    std::array<LineInFrame, lane_count> lines;
    VectorLanes points;
    VectorLanes directions;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      lines[lane] = some_line(numbers, ring, tube);
      points.set(lane, lines[lane].point);
      directions.set(lane, lines[lane].direction);
    }
    const TorusLineOf<Lanes> together(points, directions, ring, tube, false);
    const auto mask = static_cast<std::uint32_t>(numbers.below(16));
    const auto entries = together.first_entry(lanes_with(mask));
    const Lanes roots = together.root(entries.bracket, entries.found);
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      TorusLine alone(lines[lane].point, lines[lane].direction, ring, tube, false);
      const std::size_t k = lane;
      const auto entry = alone.first_entry(true);
      const TorusLine::Intervals intervals = alone.intervals();
      REQUIRE(entry.found == (intervals.count > 0));
      REQUIRE((entries.found[k] != 0) == (entry.found && (mask >> lane & 1u) != 0));
      if (!entry.found) continue;
      const double root = alone.root(entry.bracket, true);
      REQUIRE(root == alone.root(intervals.interval[0].enter, true));
      if (entries.found[k] == 0) continue;
      REQUIRE(entries.bracket.negative[k] == entry.bracket.negative);
      REQUIRE(roots[k] == root);
      ++found;
    }
  }
  CHECK(found > 10'000);
}

TEST_CASE("for nearly all rays from outside it is resolved where they enter a torus") {
  Numbers numbers(seed);
  const Entity entities[] = {Entity(Torus{.center = {1, 2, 3}, .radius = 1, .thickness = 0.3})
                                 .transformed(rotate_degrees(Vec3(20, 30, 40)))};
  const CompiledScene scene = compile(entities);
  const std::uint32_t first[] = {0};
  const BoundingProxies proxies(scene, first);
  const Vec3 center = scene.objects[0].bounds.lower +
                      0.5 * (scene.objects[0].bounds.upper - scene.objects[0].bounds.lower);
  int unknown = 0;
  int found = 0;
  constexpr int count = 10'000;
  for (int i = 0; i < count; ++i) {
    const Vec3 d = numbers.direction();
    const WorldRay ray{.origin = center + numbers.point(1) - 10.0 * d, .direction = d};
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
  }
  CHECK(unknown == 0);
  CHECK(found > count / 4);
}
