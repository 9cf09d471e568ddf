// These tests use transforms that scale a hundred million times more in one direction than in
// another, and a million of them in a row.
#include <doctest/doctest.h>
#include <crt/script.hpp>

#include "extremes/support.hpp"
#include "support/quad.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// A Chord is the t of both crossings of a scaled unit ball about the origin, by the quadratic in
/// quadruple precision. M^-1 of the 9 doubles of M is by Cramer's rule. There is none if the line
/// misses or nearly touches the ball.
struct Chord {
  double enter;
  double leave;
};

std::optional<Chord> ball_chord(const Transform& map, const Ray& ray) {
  const Vec3 rows[] = {map.row_x, map.row_y, map.row_z};
  Quad m[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) m[i][k] = rows[i][k];
  }
  const auto cofactor = [&](int i, int k) {
    const int a = (i + 1) % 3;
    const int b = (i + 2) % 3;
    const int c = (k + 1) % 3;
    const int d = (k + 2) % 3;
    return m[a][c] * m[b][d] - m[a][d] * m[b][c];
  };
  const Quad det = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
  Quad o[3] = {0, 0, 0};
  Quad d[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) {
      o[k] += cofactor(i, k) / det * (Quad(ray.origin[i]) - Quad(map.translation[i]));
      d[k] += cofactor(i, k) / det * Quad(ray.direction[i]);
    }
  }
  const Quad a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const Quad b = o[0] * d[0] + o[1] * d[1] + o[2] * d[2];
  Quad across = 0;  // squared distance of the line, times a
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    const Quad x = o[i] * d[j] - o[j] * d[i];
    across += x * x;
  }
  const Quad discriminant = a - across;
  if (discriminant < Quad(1e-6) * a) return std::nullopt;
  Quad root = std::sqrt(static_cast<double>(discriminant));
  for (int i = 0; i < 3; ++i) root = (root + discriminant / root) / 2;
  return Chord{static_cast<double>((-b - root) / a), static_cast<double>((-b + root) / a)};
}

/// Returns a map whose longest span is 10^8 times its shortest, turned before and after.
Transform squeezed(Random& random) {
  const Transform before =
      rotate_degrees({random.between(0, 360), random.between(0, 360), random.between(0, 360)});
  const Transform after =
      rotate_degrees({random.between(0, 360), random.between(0, 360), random.between(0, 360)});
  const Vec3 factors(1e4, random.between(0.1, 10), 1e-4);
  Transform result;
  Vec3* rows[] = {&result.row_x, &result.row_y, &result.row_z};
  const Vec3 after_rows[] = {after.row_x, after.row_y, after.row_z};
  const Vec3 before_rows[] = {before.row_x, before.row_y, before.row_z};
  for (int i = 0; i < 3; ++i) {
    *rows[i] = Vec3(0);
    for (int k = 0; k < 3; ++k) *rows[i] += after_rows[i][k] * factors[k] * before_rows[k];
  }
  result.translation = 100.0 * random.direction();
  return result;
}

}  // namespace

TEST_CASE("a ball under a map of condition 10^8 is met where the map of the doubles says") {
  Random random(11);
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    int compared = 0;
    for (int round = 0; round < 200; ++round) {
      const Transform map = squeezed(random);
      Scene scene;
      scene.settings.precision = precision;
      scene.entities = {Entity(Sphere{}).transformed(map)};
      RayQueries queries(prepare(scene));
      for (int i = 0; i < 20; ++i) {
        const Vec3 target = apply(map, 0.7 * random.direction());
        const Vec3 direction = random.direction();
        const Ray ray{.origin = target - 50.0 * direction, .direction = direction, .t_min = -1e9};
        const std::optional<Chord> chord = ball_chord(map, ray);
        if (!chord) continue;
        ++compared;
        std::vector<Hit> hits;
        queries.crossings(ray, hits);
        REQUIRE(hits.size() == 2);
        // The error has the rounding of the ray's own path, and its effect where it meets the
        // surface at a slant.
        CHECK(hits[0].t == doctest::Approx(chord->enter).epsilon(1e-9));
        CHECK(hits[1].t == doctest::Approx(chord->leave).epsilon(1e-9));
      }
    }
    CHECK(compared > 3000);
  }
}

TEST_CASE("squeezed solids do not shadow themselves") {
  Random random(12);
  for (int round = 0; round < 60; ++round) {
    const Transform map = squeezed(random);
    Scene scene = dark_scene();
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    const std::vector<Entity> solids = {Sphere{}, Box{}, Cylinder{.from = {0, -1, 0}},
                                        Cone{.from = {0, -1, 0}}};
    scene.entities = {solids[static_cast<std::size_t>(round % 4)].transformed(map).with_material(
        Material{.color = grey(1)})};
    RayQueries queries(prepare(scene));
    for (int i = 0; i < 40; ++i) {
      const Vec3 target = apply(map, Vec3(0, -0.3, 0) + 0.3 * random.direction());
      const Vec3 eye = target + 3e4 * random.direction();
      const std::optional<Hit> hit = queries.intersect({.origin = eye, .direction = target - eye});
      REQUIRE(hit);
      const Vec3 to_lamp = random.direction();
      scene.lights = {ParallelLight{.from = to_lamp, .pointing = Vec3(0)}};
      const double expected = std::max(0.0, glm::dot(hit->normal, to_lamp));
      CHECK(seen(scene, eye, target).r == doctest::Approx(expected).epsilon(1e-5));
    }
  }
}

TEST_CASE("a million transforms in a row are one") {
  constexpr int count = 1'000'000;
  Entity moved = Sphere{};
  for (int i = 0; i < count; ++i) moved = moved.transformed(translate({0x1p-20, 0, 0}));
  Scene scene;
  scene.entities = {moved};
  const std::optional<Hit> hit = intersect(prepare(scene), {.origin = {count * 0x1p-20, 0, -5}});
  REQUIRE(hit);
  CHECK(hit->t == 4);
  CHECK(hit->position == Vec3(count * 0x1p-20, 0, -1));

  Entity turned = Box{};
  const Transform step = rotate_degrees({0, 360.0 / count, 0});
  for (int i = 0; i < count; ++i) turned = turned.transformed(step);
  scene.entities = {turned};
  // Each of the rotations was rounded. A million roundings of u that add up are 10^-10.
  const std::optional<Hit> face = intersect(prepare(scene), {.origin = {0.5, 0.5, -5}});
  REQUIRE(face);
  CHECK(face->t == doctest::Approx(4).epsilon(1e-9));
  CHECK(glm::length(face->normal - Vec3(0, 0, -1)) < 1e-9);
}

TEST_CASE("transforms and intersections in turn may be a hundred thousand deep") {
  constexpr int depth = 100'000;
  Entity entity = Sphere{};
  for (int i = 0; i < depth; ++i) {
    entity = entity.transformed(translate({0x1p-20, 0, 0})) ^
             Entity(Box{.corner_a = {-9, -9, -9}, .corner_b = {9, 9, 9}});
  }
  Scene scene;
  scene.entities = {entity};
  const std::optional<Hit> hit = intersect(prepare(scene), {.origin = {depth * 0x1p-20, 0, -5}});
  REQUIRE(hit);
  CHECK(hit->t == 4);
}

TEST_CASE("unions and intersections in turn may be fifty thousand deep") {
  constexpr int depth = 50'000;
  const Entity dot = Sphere{.center = {0, 50, 0}, .radius = 0.1};
  const Entity room = Box{.corner_a = {-99, -99, -99}, .corner_b = {99, 99, 99}};
  Entity entity = Sphere{};
  for (int i = 0; i < depth; ++i)
    entity = (entity.transformed(translate({0x1p-20, 0, 0})) + dot) ^ room;
  Scene scene;
  scene.entities = {entity};
  const std::optional<Hit> hit = intersect(prepare(scene), {.origin = {depth * 0x1p-20, 0, -5}});
  REQUIRE(hit);
  CHECK(hit->t == 4);
}

TEST_CASE("a script's loop may transform an entity a million times") {
  ScriptOptions options;
  options.limits.steps = 200'000'000;
  const ScriptResult result = run_script(R"(
Settings { width -> 4 height -> 4 }
ball = Sphere { center -> vec3(0, 0, 0) radius -> 1 }
i = 0
while (i < 1000000) {
    ball = ball <translate vec3(0.00000095367431640625, 0, 0)>
    i = i + 1
}
Scene { ball }
)",
                                         "loop.crt", options);
  for (const Diagnostic& diagnostic : result.diagnostics) MESSAGE(format_diagnostic(diagnostic));
  REQUIRE(result.scene);
  const std::optional<Hit> hit =
      intersect(prepare(*result.scene), {.origin = {1'000'000 * 0x1p-20, 0, -5}});
  REQUIRE(hit);
  CHECK(hit->t == 4);
}
