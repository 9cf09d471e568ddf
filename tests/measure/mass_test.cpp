// How much solids are, against closed forms, against counts of unit cubes, and against chords along
// lines in quadruple precision.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
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

constexpr double pi = std::numbers::pi;

/// Checks that an interval holds the truth, which is known to rounding, and how wide it is.
void check(const Interval& answer, double truth, double relative_width) {
  const double rounding = 1e-13 * std::abs(truth);
  CHECK(answer.lower <= truth + rounding);
  CHECK(answer.upper >= truth - rounding);
  CHECK(answer.width() <= relative_width * std::abs(truth) + 1e-300);
}

/// Returns a random map that scales evenly, and by how much.
std::pair<Transform, double> random_motion(Random& random) {
  const Vec3 x = random.direction();
  Vec3 y = random.direction();
  while (std::abs(glm::dot(x, y)) > 0.9) y = random.direction();
  const Vec3 z = glm::normalize(glm::cross(x, y));
  const double scale = random.power_of_ten(-9, 9);
  const Vec3 along = scale * glm::normalize(x);
  const Vec3 beside = scale * glm::normalize(glm::cross(z, x));
  Transform map;
  map.row_x = {along.x, beside.x, scale * z.x};
  map.row_y = {along.y, beside.y, scale * z.y};
  map.row_z = {along.z, beside.z, scale * z.z};
  map.translation = scale * random.power_of_ten(-3, 3) * random.in_cube();
  return {map, scale};
}

/// Returns a turned flange on the plane y = 0, with a fillet of 0.5 where the hub meets the plate.
Entity turned_flange() {
  const double bulge = 1 - std::sqrt(2.0);
  const std::vector<Contour> contours = {{{.x = 1.2, .y = 0},
                                          {.x = 5, .y = 0},
                                          {.x = 5, .y = 1},
                                          {.x = 2.5, .y = 1},
                                          {.x = 2, .y = 1.5, .bulge = bulge},
                                          {.x = 2, .y = 3},
                                          {.x = 1.2, .y = 3}}};
  return Revolution{.profile = make_profile(contours)};
}
/// These are by Pappus' theorems.
constexpr double volume_of_flange = pi * (25 - 1.44) + pi * (4 - 1.44) * 2 +
                                    2 * pi * (0.25 * 2.25 - pi / 16 * (2.5 - 2 / (3 * pi)));
constexpr double area_of_flange = pi * (25 - 6.25) + pi * (25 - 1.44) + 10 * pi + 6 * pi +
                                  pi * (4 - 1.44) + 7.2 * pi + 0.5 * pi * pi * (2.5 - 1 / pi);

struct Known {
  std::string name;
  Entity solid;
  double volume;
  double area;
};

std::vector<Known> known_solids() {
  const Cylinder along_x{.from = {-2, 0, 0}, .to = {2, 0, 0}};
  const Cylinder along_y{.from = {0, -2, 0}, .to = {0, 2, 0}};
  const Sphere ball{};
  const Box beside{.corner_a = {0, -2, -2}, .corner_b = {2, 2, 2}};
  const double cap = pi * 0.25 * (3 - 0.5) / 3;
  const double slant = std::sqrt(2.0 * 2 + 1);
  return {
      {"box", Box{.corner_a = {0, 0, 0}, .corner_b = {1, 2, 3}}, 6, 22},
      {"sphere", ball, 4 * pi / 3, 4 * pi},
      {"cylinder", Cylinder{.from = {0, 0, 0}, .to = {1, 1, 1}}, std::sqrt(3) * pi,
       2 * pi * (1 + std::sqrt(3))},
      {"cone", Cone{.from = {0, 0, 0}, .to = {0, 2, 0}}, 2 * pi / 3, pi * (1 + slant)},
      {"frustum", Cone{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 1, .radius2 = 2},
       pi * 2 * (1 + 2 + 4) / 3, pi * (1 + 4 + 3 * slant)},
      {"torus", Torus{}, 2 * pi * pi * 0.0625, 4 * pi * pi * 0.25},
      {"half ball", Entity(ball) - Entity(beside), 2 * pi / 3, 3 * pi},
      {"lens", Entity(ball) ^ Entity(Sphere{.center = {1, 0, 0}}), 2 * cap, 2 * pi},
      {"two balls", Entity(ball) + Entity(Sphere{.center = {1, 0, 0}}), 8 * pi / 3 - 2 * cap,
       6 * pi},
      {"Steinmetz's solid", Entity(along_x) ^ Entity(along_y), 16.0 / 3, 16},
      {"notched box", Entity(Box{}) - Entity(Sphere{.center = {1, 1, 1}}), 8 - pi / 6,
       24 - 0.75 * pi + 0.5 * pi},
      {"turned flange", turned_flange(), volume_of_flange, area_of_flange},
      {"drilled box",
       Entity(Box{}) - Entity(Cylinder{.from = {0, -1, 0}, .to = {0, 1, 0}, .radius = 0.5}),
       8 - 0.5 * pi, 24 - 0.5 * pi + 2 * pi},
  };
}

}  // namespace

TEST_CASE("volumes are those of closed forms, at any place and in any size") {
  Random random(1);
  for (const Known& known : known_solids()) {
    CAPTURE(known.name);
    check(volume(known.solid), known.volume, 1e-6);
    for (int i = 0; i < 4; ++i) {
      const auto [map, scale] = random_motion(random);
      check(volume(known.solid.transformed(map), {.relative_width = 1e-4}),
            known.volume * scale * scale * scale, 1e-4 + 1e-9);
    }
  }
}

TEST_CASE("areas are those of closed forms") {
  for (const Known& known : known_solids()) {
    CAPTURE(known.name);
    check(surface_area(known.solid, {.relative_width = 1e-2}), known.area, 1e-2);
  }
  check(surface_area(Cylinder{}, {.relative_width = 1e-4}), 4 * pi, 1e-4);
  check(surface_area(turned_flange(), {.relative_width = 1e-4}), area_of_flange, 1e-4);
  // In a large cell of this one the surface is too steep for a series of how steep it is.
  const Capsule steep{
      .from = {-0.095, 3.561, 0.3562}, .to = {-1.6251, 3.3, -0.9049}, .radius = 0.3529};
  check(surface_area(steep, {.relative_width = 1e-2}),
        2 * pi * steep.radius * (glm::distance(steep.from, steep.to) + 2 * steep.radius), 1e-2);
}

TEST_CASE("where two slopes cross at a step, the step has the area of both sides") {
  const Entity room = Box{};
  const Entity front = Plane{.normal = {0.6, 0, 1}};
  const auto below = [](double rise) {
    return Entity(Plane{.normal = {-rise, 1, 0}, .position = {0.3, 0, 0}});
  };
  const Entity slopes = room ^ ((below(0.3) ^ front) + (below(-0.3) - front));
  const double bottom = 4;
  const double front_and_back = 1.82 + 2.18;
  const double ends = (1.6 * 0.61 + 0.4 * 1.39) + (0.4 * 1.21 + 1.6 * 0.79);
  const double tops = 4 * std::sqrt(1 + 0.3 * 0.3);
  const double step = std::sqrt(1 + 0.6 * 0.6) * 0.3 * (0.7 * 0.7 + 1.3 * 1.3);
  check(surface_area(slopes, {.relative_width = 1e-6}),
        bottom + front_and_back + ends + tops + step, 1e-6);
}

TEST_CASE("a map that is not even changes a volume by its determinant") {
  Transform map;
  map.row_x = {1, 0.5, -0.25};
  map.row_y = {0.125, 2, 0.75};
  map.row_z = {-0.5, 0.25, 0.5};
  const double determinant = glm::dot(map.row_x, glm::cross(map.row_y, map.row_z));
  for (const Known& known : known_solids()) {
    CAPTURE(known.name);
    check(volume(known.solid.transformed(map), {.relative_width = 1e-3}),
          known.volume * determinant, 1e-3 + 1e-9);
  }
}

TEST_CASE("boxes most of whose faces coincide are as many unit cubes as they hold") {
  constexpr int reach = 8;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const auto only_boxes = [](const auto& self, const Solid& solid) -> bool {
      if (solid.kind == Solid::Kind::sphere || solid.kind == Solid::Kind::cylinder ||
          solid.kind == Solid::Kind::half_space)
        return false;
      return std::ranges::all_of(solid.parts, [&](const Solid& part) { return self(self, part); });
    };
    Solid solid = maker.tree(3);
    for (int i = 0; i < 100 && !only_boxes(only_boxes, solid); ++i) solid = maker.tree(3);
    if (!only_boxes(only_boxes, solid)) continue;
    const auto is_in = [&](int x, int y, int z) {
      return solid.contains({Quad(x) + Quad(0.5), Quad(y) + Quad(0.5), Quad(z) + Quad(0.5)});
    };
    int cubes = 0;
    int faces = 0;
    Vec3 first(0, 0, 0);
    for (int x = -reach; x < reach; ++x) {
      for (int y = -reach; y < reach; ++y) {
        for (int z = -reach; z < reach; ++z) {
          const bool in = is_in(x, y, z);
          cubes += in ? 1 : 0;
          if (in) first += Vec3(x + 0.5, y + 0.5, z + 0.5);
          faces +=
              (in != is_in(x + 1, y, z)) + (in != is_in(x, y + 1, z)) + (in != is_in(x, y, z + 1));
        }
      }
    }
    const MassProperties mass = mass_properties(solid.entity());
    CHECK(std::abs(mass.volume.middle() - cubes) < 1e-9);
    CHECK(mass.volume.width() < 1e-9);
    CHECK(std::abs(mass.area.middle() - faces) < 1e-9);
    CHECK(mass.area.width() < 1e-9);
    if (cubes == 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const Interval& center = mass.centroid[static_cast<std::size_t>(axis)];
      CHECK(center.lower <= first[axis] / cubes + 1e-12);
      CHECK(center.upper >= first[axis] / cubes - 1e-12);
      CHECK(center.width() < 1e-9);
    }
  }
}

TEST_CASE("trees of round and flat solids hold what chords along lines add up to") {
  constexpr int lines = 96;
  constexpr double reach = 4;
  constexpr double spacing = 2 * reach / lines;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Solid solid = in_room(maker.tree(4));
    double chords = 0;
    std::vector<Quad> places;
    for (int i = 0; i < lines; ++i) {
      for (int j = 0; j < lines; ++j) {
        const Vec3 from(-reach + (i + 0.5) * spacing, -reach + (j + 0.5) * spacing, -2 * reach);
        places.clear();
        solid.candidate_ts(from, {0, 0, 1}, places);
        std::sort(places.begin(), places.end());
        for (std::size_t k = 1; k < places.size(); ++k) {
          const Quad middle = (places[k - 1] + places[k]) / 2;
          if (solid.contains({from.x, from.y, Quad(from.z) + middle}))
            chords += static_cast<double>(places[k] - places[k - 1]);
        }
      }
    }
    chords *= spacing * spacing;
    // Lines leave so much open at the edges of what they meet.
    const double off = 0.02 * std::pow(2 * reach, 2);
    const Interval coarse = volume(solid.entity(), {.relative_width = 1e-2});
    const Interval fine = volume(solid.entity(), {.relative_width = 1e-3});
    CHECK(coarse.lower - off <= chords);
    CHECK(coarse.upper + off >= chords);
    CHECK(std::abs(fine.middle() - chords) <= off);
    CHECK(fine.width() <= 1e-3 * fine.upper + 1e-9);
    // Both hold the truth, so they have a point in common.
    CHECK(fine.lower <= coarse.upper);
    CHECK(fine.upper >= coarse.lower);
  }
}

TEST_CASE("what a cutter takes and what it leaves are all that was there") {
  for (std::uint32_t seed = 100; seed < 120; ++seed) {
    CAPTURE(seed);
    SolidMaker maker(seed);
    const Entity a = in_room(maker.tree(2)).entity();
    const Entity b = in_room(maker.tree(2)).entity();
    const MeasureOptions options{.relative_width = 1e-4};
    const Interval whole = volume(a, options);
    const Interval left = volume(a - b, options);
    const Interval taken = volume(a ^ b, options);
    CHECK(left.lower + taken.lower <= whole.upper + 1e-9);
    CHECK(left.upper + taken.upper >= whole.lower - 1e-9);
    CHECK(volume(a - a, options).upper <= 1e-9);
    const Interval twice = volume(a + a, options);
    CHECK(twice.lower <= whole.upper);
    CHECK(twice.upper >= whole.lower);
  }
}

TEST_CASE("centroid and inertia are those of closed forms, wherever a solid is") {
  Transform map;
  map.row_x = {0.6, -0.8, 0};
  map.row_y = {0.8, 0.6, 0};
  map.translation = {100, -20, 3};
  const MassProperties box =
      mass_properties(Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {2, 4, 6}}).transformed(map));
  const Vec3 middle = Vec3(100, -20, 3) + Vec3(0.6 * 1 - 0.8 * 2, 0.8 * 1 + 0.6 * 2, 3);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(box.centroid[static_cast<std::size_t>(axis)].contains(middle[axis]));
    CHECK(box.centroid[static_cast<std::size_t>(axis)].width() < 1e-6);
  }
  const double of_x = 48.0 * (16 + 36) / 12;
  const double of_y = 48.0 * (4 + 36) / 12;
  const double of_z = 48.0 * (4 + 16) / 12;
  const double expected[] = {
      0.36 * of_x + 0.64 * of_y, 0.64 * of_x + 0.36 * of_y, of_z, 0.48 * (of_x - of_y), 0, 0};
  for (std::size_t i = 0; i < 6; ++i) {
    CAPTURE(i);
    CHECK(box.inertia[i].lower <= expected[i] + 1e-9);
    CHECK(box.inertia[i].upper >= expected[i] - 1e-9);
    CHECK(box.inertia[i].width() < 1e-3);
  }

  const MassProperties ball =
      mass_properties(Sphere{.center = {5, 6, 7}, .radius = 2}, {.relative_width = 1e-2});
  const double of_ball = 0.4 * (4 * pi / 3 * 8) * 4;
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(ball.inertia[i].contains(of_ball));
    CHECK(ball.inertia[i + 3].contains(0));
    CHECK(ball.inertia[i].width() < 0.05 * of_ball);
  }
}

TEST_CASE("answers are the same for any number of threads") {
  const Entity part = known_solids().back().solid + Entity(Sphere{.center = {0.5, 1, 0}});
  const MassProperties one = mass_properties(part, {.relative_width = 1e-2, .threads = 1});
  for (const int threads : {2, 5}) {
    const MassProperties more = mass_properties(part, {.relative_width = 1e-2, .threads = threads});
    CHECK(one.volume == more.volume);
    CHECK(one.area == more.area);
    CHECK(one.centroid == more.centroid);
    CHECK(one.inertia == more.inertia);
  }
}

TEST_CASE("copies that are prepared once count as often as they are there") {
  const Entity part = Entity(Box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}}) -
                      Entity(Cylinder{.from = {0.5, -1, 0.5}, .to = {0.5, 2, 0.5}, .radius = 0.25});
  std::vector<Entity> copies;
  for (int i = 0; i < 400; ++i) {
    Transform map;
    map.row_x = {0.6, -0.8, 0};
    map.row_y = {0.8, 0.6, 0};
    map.translation = {3.0 * (i % 20), 3.0 * (i / 20), 0.125 * i};
    copies.push_back(part.transformed(map));
  }
  check(volume(csg_union(copies), {.relative_width = 1e-3}), 400 * (1 - pi / 16), 1e-3 + 1e-9);
}

TEST_CASE("what is known when the time is over is the answer") {
  const Entity part = Entity(Torus{}) + Entity(Sphere{.center = {1, 0.2, 0}, .radius = 0.5});
  const Interval quick = volume(part, {.relative_width = 1e-12, .seconds = 1e-9});
  const Interval good = volume(part, {.relative_width = 1e-5});
  CHECK(quick.lower <= good.lower);
  CHECK(quick.upper >= good.upper);
}

TEST_CASE("only what is solid and finite is measured") {
  CHECK_THROWS_WITH_AS(volume(Disc{}), doctest::Contains("only a solid"), Error);
  CHECK_THROWS_WITH_AS(volume(Plane{}), doctest::Contains("infinite"), Error);
  CHECK_THROWS_WITH_AS(volume(Sphere{}, {.relative_width = 0}), doctest::Contains("relative_width"),
                       Error);
  CHECK_THROWS_WITH_AS(volume(Sphere{}, {.seconds = -1}), doctest::Contains("seconds"), Error);
  CHECK_THROWS_AS(volume(Sphere{}, {.relative_width = 1e-12, .go_on = [] { return false; }}),
                  Error);
  CHECK(volume(empty_entity()).upper == 0);
  CHECK(mass_properties(empty_entity()).area.upper == 0);
}
