// These tests check where rays go: mirrors, glass, media, depth.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

double straight_on_reflectance(double n1, double n2) {
  return (n1 - n2) * (n1 - n2) / ((n1 + n2) * (n1 + n2));
}

double reflectance(double angle, double n) {
  const double behind = std::asin(std::sin(angle) / n);
  const double across = std::sin(angle - behind) / std::sin(angle + behind);
  const double within = std::tan(angle - behind) / std::tan(angle + behind);
  return 0.5 * (across * across + within * within);
}

/// Makes a slab of glass from y = 0 down to -thickness.
Entity slab(double thickness, const Material& material) {
  return Box{.corner_a = {-100, -thickness, -100}, .corner_b = {100, 0, 100}, .material = material};
}

void check_level(const Color& color, double level, double tolerance = 1e-6) {
  CHECK(color.r == doctest::Approx(level).epsilon(tolerance));
  CHECK(color.g == doctest::Approx(level).epsilon(tolerance));
  CHECK(color.b == doctest::Approx(level).epsilon(tolerance));
}

}  // namespace

TEST_CASE("a mirror shows what lies in the mirrored direction") {
  Scene scene = dark_scene();
  scene.background = GradientBackground{.horizon = {0, 0, 0}, .sky = {1, 1, 1}};
  scene.entities = {Plane{.normal = {0, 0.6, -0.8}, .material = inert(0.75)}};
  // (0, 0, 1) is mirrored to (0, 0.96, -0.28).
  check_level(seen(scene, {0, 0, -5}, {0, 0, 0}), 0.75 * 0.96);

  // A tiny sphere exactly on the mirrored ray is seen, one a little beside it is not.
  scene.background = SolidBackground{{0, 0, 0}};
  scene.lights = {glow(1)};
  const Vec3 on_ray = 7.0 * Vec3(0, 0.96, -0.28);
  const Entity mirror = scene.entities[0];
  scene.entities = {mirror, Sphere{.center = on_ray, .radius = 1e-6, .material = inert()}};
  check_level(seen(scene, {0, 0, -5}, {0, 0, 0}), 0.25 + 0.75);
  scene.entities = {
      mirror, Sphere{.center = on_ray + Vec3(1.1e-6, 0, 0), .radius = 1e-6, .material = inert()}};
  check_level(seen(scene, {0, 0, -5}, {0, 0, 0}), 0.25);
}

TEST_CASE(
    "a slab of glass displaces a ray by d sin(a - b) / cos(b), and dims it by Fresnel's law "
    "twice") {
  const double thickness = 2;
  const double n = 1.5;
  const double angle = 0.8;
  const double behind = std::asin(std::sin(angle) / n);
  const Vec3 direction(std::sin(angle), -std::cos(angle), 0);
  const double shift = thickness * std::sin(angle - behind) / std::cos(behind);
  const Vec3 across(-std::cos(angle), -std::sin(angle), 0);  // towards the normal, across the ray

  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.recursion_depth = 2;  // in and out; light that bounces inside is cut off
  const double f = reflectance(angle, n);
  const Entity glass_slab = slab(thickness, glass(n));
  const Vec3 eye = -3.0 * direction;
  scene.entities = {glass_slab};
  check_level(seen(scene, eye, {0, 0, 0}), f + (1 - f) * (1 - f));

  // A tiny black sphere where the displaced ray must come by takes the light that went through.
  const Vec3 expected = 10.0 * direction + shift * across;
  scene.entities = {glass_slab, Sphere{.center = expected, .radius = 1e-7, .material = inert()}};
  check_level(seen(scene, eye, {0, 0, 0}), f);
  scene.entities = {
      glass_slab,
      Sphere{.center = expected + 1.1e-7 * across, .radius = 1e-7, .material = inert()}};
  check_level(seen(scene, eye, {0, 0, 0}), f + (1 - f) * (1 - f));
}

TEST_CASE("glass of index 1 is not there, but for its colour and what it absorbs") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.entities = {slab(2, Material{.color = Color{1, 0.5, 0.5},
                                     .transparency = 0.5,
                                     .diffuse = 0,
                                     .absorption = {0.3, 0, 0.7}})};
  const Vec3 direction(0.6, -0.8, 0);
  const double length = 2 / 0.8;
  const Color color = seen(scene, -2.0 * direction, {0, 0, 0});
  CHECK(color.r == doctest::Approx(0.25 * std::exp(-0.3 * length)).epsilon(1e-6));
  CHECK(color.g == doctest::Approx(0.25 * 0.25).epsilon(1e-6));
  CHECK(color.b == doctest::Approx(0.25 * 0.25 * std::exp(-0.7 * length)).epsilon(1e-6));
  CHECK(look(scene, -2.0 * direction, {0, 0, 0}).stats().reflection_rays == 0);
}

TEST_CASE("all light that glass divides comes together again") {
  // In a white world a clear slab is invisible, once enough bounces are followed.
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.recursion_depth = 60;
  scene.entities = {slab(1, glass(1.5))};
  for (const double angle : {0.0, 0.5, 1.0, 1.4}) {
    check_level(seen(scene, {-std::sin(angle), std::cos(angle), 0}, {0, 0, 0}), 1);
  }
}

TEST_CASE("beyond the critical angle glass mirrors everything, below it a part") {
  // Glass fills the lower half of space; below the horizon all is white, above it black.
  Scene scene = dark_scene();
  scene.background = two_halves({0, 0, 0}, {1, 1, 1});
  scene.entities = {Plane{.material = glass(1.5)}};
  const double critical = std::asin(1 / 1.5);
  const auto looking_up = [&](double angle) {
    return seen(scene, {0, -1, 0}, {std::tan(angle), 0, 0});
  };
  check_level(looking_up(critical + 0.01), 1);
  check_level(looking_up(1.2), 1);
  const double angle = 0.5;
  const double outside = std::asin(1.5 * std::sin(angle));
  check_level(looking_up(angle), reflectance(outside, 1.5));
}

TEST_CASE("a camera inside nested solids sees through both") {
  const double f_water_glass = straight_on_reflectance(1.33, 1.5);
  const double f_glass_air = straight_on_reflectance(1.5, 1);
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.recursion_depth = 2;
  const Entity outer = Sphere{.radius = 2, .material = glass(1.5)};
  const Entity inner = Sphere{.radius = 1, .material = glass(1.33)};
  for (const auto& order : {std::vector{outer, inner}, std::vector{inner, outer}}) {
    scene.entities = order;
    const Image image = look(scene, {0, 0, 0}, {0, 0, 1});
    check_level(image.at(0, 0), (1 - f_water_glass) * (1 - f_glass_air));
    CHECK(image.stats().media_lookups == 1);
  }
}

TEST_CASE("a camera in a medium sees through it what it absorbs") {
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  Material fog = glass(1);
  fog.absorption = {0.5, 0.25, 0};
  scene.entities = {Sphere{.radius = 10, .material = fog},
                    Sphere{.center = {0, 0, 5}, .radius = 1, .material = inert()}};
  const Color color = seen(scene, {0, 0, 0}, {0, 0, 1});
  CHECK(color.r == doctest::Approx(std::exp(-2)).epsilon(1e-6));
  CHECK(color.g == doctest::Approx(std::exp(-1)).epsilon(1e-6));
  CHECK(color.b == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("a medium without end swallows what it absorbs, and only that") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  Material fog = glass(1);
  fog.absorption = {0.5, 0, 0};
  scene.entities = {Plane{.material = fog}};
  const Color color = seen(scene, {0, -1, 0}, {0, -2, 0});
  CHECK(color.r == 0);
  CHECK(color.g == 1);
}

TEST_CASE("a ray that leaves an inner solid is back in the outer one") {
  // The ray goes straight through an air bubble in glass, which has four boundaries with the same
  // share.
  const double f = straight_on_reflectance(1.5, 1);
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.recursion_depth = 4;
  scene.entities = {Box{.corner_a = {-2, -2, -2}, .corner_b = {2, 2, 2}, .material = glass(1.5)},
                    Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}, .material = glass(1)}};
  // Besides the straight path, there is light of up to four bounces: mirrored at the front, or once
  // inside and back out of the front.
  const double through = std::pow(1 - f, 4);
  const double from_front = f;
  const double from_bubble = (1 - f) * f * (1 - f);
  check_level(seen(scene, {0, 0, -5}, {0, 0, 0}), through + from_front + from_bubble, 2e-6);
}

TEST_CASE("a hollow cut into glass looks like a bubble of index 1 in it") {
  Scene scene;
  scene.settings.width = 40;
  scene.settings.height = 40;
  scene.settings.recursion_depth = 8;
  scene.camera = {.position = {0, 0, -4}, .pointing = {0, 0, 0}};
  scene.background = GradientBackground{};
  const Sphere outer{.radius = 1, .material = glass(1.5)};
  Sphere inner{.center = {0.2, 0.1, 0}, .radius = 0.6, .material = glass(1)};
  scene.entities = {outer, inner};
  const Image bubble = render(prepare(scene));
  inner.material = glass(1.5);  // the cut is a surface of the glass
  scene.entities = {Entity(outer) - Entity(inner)};
  const Image hollow = render(prepare(scene));
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      CHECK(hollow.at(x, y).r == doctest::Approx(bubble.at(x, y).r).epsilon(1e-6));
      CHECK(hollow.at(x, y).g == doctest::Approx(bubble.at(x, y).g).epsilon(1e-6));
    }
  }
  CHECK(hollow.stats().refraction_rays == bubble.stats().refraction_rays);
}

TEST_CASE("solids that merely overlap are media one after the other") {
  // The index is 1.5 along the whole path through both, so no boundary inside reflects.
  const double f = straight_on_reflectance(1.5, 1);
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.recursion_depth = 4;
  scene.entities = {Box{.corner_a = {-2, -2, -2}, .corner_b = {2, 2, 1}, .material = glass(1.5)},
                    Box{.corner_a = {-2, -2, -1}, .corner_b = {2, 2, 2}, .material = glass(1.5)}};
  // Light comes straight through and mirrored at the front. What comes back from the far side needs
  // 6 bounces.
  check_level(seen(scene, {0, 0, -5}, {0, 0, 0}), (1 - f) * (1 - f) + f);
}

TEST_CASE("a transparent surface without inside tints and lets pass straight") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  Material film = glass(1.5);
  film.color = Color{1, 0.5, 0.25};
  film.absorption = grey(5);
  scene.entities = {Disc{.normal = {0, 0.6, -0.8}, .material = film}};
  const Image image = look(scene, {0, 0, -5}, {0, 0, 0});
  CHECK(image.at(0, 0) == Color{1, 0.5, 0.25, 1});
  CHECK(image.stats().media_changes == 0);
  CHECK(image.stats().reflection_rays == 0);
}

TEST_CASE("between parallel mirrors each bounce adds a term of the geometric series") {
  const double r = 0.5;
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 1}, .material = inert(r)},
                    Plane{.normal = {0, 0, 1}, .position = {0, 0, -1}, .material = inert(r)}};
  for (int depth = 0; depth <= 24; ++depth) {
    scene.settings.recursion_depth = depth;
    const Image image = look(scene, {0, 0, 0}, {0, 0.1, 1});
    check_level(image.at(0, 0), 1 - std::pow(r, depth + 1));
    CHECK(image.stats().reflection_rays == static_cast<std::uint64_t>(depth));
    CHECK(image.stats().rays_beyond_depth == 1);
    CHECK(image.stats().rays_below_min_weight == 0);
  }
}

TEST_CASE("a ray whose share is below the least weight is not followed") {
  const double r = 0.5;
  Scene scene = dark_scene();
  scene.lights = {glow(1)};
  scene.settings.recursion_depth = 100;
  scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 1}, .material = inert(r)},
                    Plane{.normal = {0, 0, 1}, .position = {0, 0, -1}, .material = inert(r)}};
  for (int k = 1; k <= 10; ++k) {
    scene.settings.min_weight = std::pow(r, k);  // a share just as large is still followed
    const Image image = look(scene, {0, 0, 0}, {0, 0.1, 1});
    check_level(image.at(0, 0), 1 - std::pow(r, k + 1));
    CHECK(image.stats().reflection_rays == static_cast<std::uint64_t>(k));
    CHECK(image.stats().rays_below_min_weight == 1);
    CHECK(image.stats().rays_beyond_depth == 0);
  }
}

TEST_CASE("one bright channel is enough to follow a ray") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.min_weight = 0.5;
  Material film = inert(0, 1);
  film.color = Color{0, 0, 0.5};
  scene.entities = {Disc{.normal = {0, 0, -1}, .material = film}};
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 0}) == Color{0, 0, 0.5, 1});
  film.color = Color{0.49, 0.49, 0.49};
  scene.entities = {Disc{.normal = {0, 0, -1}, .material = film}};
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 0}) == Color{0, 0, 0, 1});
}

TEST_CASE("a ray is followed that a bright surface can still make matter") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{1, 1, 1}};
  scene.settings.min_weight = 0.5;
  Material dark = inert(0, 1);
  dark.color = Color{0.01, 0, 0.001};
  Material bright = inert(0, 1);
  bright.color = Color{200, 0, 1};
  scene.entities = {Disc{.normal = {0, 0, -1}, .material = dark},
                    Disc{.center = {0, 0, 1}, .normal = {0, 0, -1}, .material = bright}};
  CHECK(seen(scene, {0, 0, -1}, {0, 0, 0}).r == 2);
  // A ray is not followed where it can pass no such surface any more. The cut-off is what it might
  // have brought.
  scene.settings.recursion_depth = 1;
  const Image cut = look(scene, {0, 0, -1}, {0, 0, 0});
  CHECK(cut.at(0, 0) == Color{0, 0, 0, 1});
  CHECK(cut.stats().rays_below_min_weight == 1);
  // Nor is it where even that is not enough.
  scene.settings.recursion_depth = 2;
  scene.settings.min_weight = 1;
  dark.color = Color{0.004, 0, 0};
  scene.entities[0] = Disc{.normal = {0, 0, -1}, .material = dark};
  const Image weak = look(scene, {0, 0, -1}, {0, 0, 0});
  CHECK(weak.at(0, 0) == Color{0, 0, 0, 1});
  CHECK(weak.stats().refraction_rays == 0);
  CHECK(weak.stats().cutoff_max == doctest::Approx(0.8));
}

TEST_CASE(
    "light stays a number however many surfaces brighten it, on its path to the camera and from "
    "a light") {
  Scene scene = dark_scene();
  scene.settings.recursion_depth = 256;
  scene.settings.min_weight = 1.0 / 1024;
  Material film = inert(0, 1);
  film.color = Color{1e30, 0, 1};
  for (int i = 0; i < 120; ++i) {
    scene.entities.push_back(
        Disc{.center = {0, 0, double(i)}, .normal = {0, 0, -1}, .radius = 1, .material = film});
  }
  const auto check_numbers = [&](const Image& image) {
    for (const float value : image.pixels()) CHECK(std::isfinite(value));
    CHECK(image.at(0, 0).r == std::numeric_limits<float>::max());
    CHECK(image.at(0, 0).g == 0);
  };
  // What is behind them is black, but for red.
  scene.background = SolidBackground{{1e30, 0, 0}};
  check_numbers(look(scene, {0, 0, -1}, {0, 0, 0}));
  CHECK(look(scene, {0, 0, -1}, {0, 0, 0}).at(0, 0).b == 0);
  // A wall before them is lit through them by a light.
  scene.background = SolidBackground{{0, 0, 0}};
  scene.lights = {PointLight{.origin = {0, 0, -1}, .color = {1e30, 0, 1e30}}};
  Material wall;
  wall.color = Color{1e30, 1, 0};
  scene.entities.push_back(Plane{.normal = {0, 0, -1}, .position = {0, 0, 200}, .material = wall});
  check_numbers(look(scene, {5, 0, 150}, {0, 0, 200}));
  check_numbers(look(scene, {0, 0, -2}, {0, 0, 0}));
}

TEST_CASE("a sample that could go on for ever is bounded") {
  // Every hit mirrors everything and lets everything through. That makes 2^250 rays without a
  // limit.
  Scene scene = dark_scene();
  scene.settings.recursion_depth = 250;
  scene.entities = {
      Disc{.center = {0, 0, 1}, .normal = {0, 0, 1}, .radius = 1e9, .material = inert(1, 1)},
      Disc{.center = {0, 0, -1}, .normal = {0, 0, 1}, .radius = 1e9, .material = inert(1, 1)},
      Disc{.center = {0, 0, 2}, .normal = {0, 0, 1}, .radius = 1e9, .material = inert(1, 1)}};
  const Image image = look(scene, {0, 0, 0}, {0, 0, 1});
  const RenderStats& stats = image.stats();
  CHECK(stats.samples_over_ray_bound == 1);
  CHECK(stats.camera_rays + stats.reflection_rays + stats.refraction_rays == 65536);
}

TEST_CASE("the background's alpha is the picture's where nothing is hit, premultiplied") {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{0.5, 1, 0.25, 0.5}};
  CHECK(seen(scene, {0, 0, 0}, {0, 0, 1}) == Color{0.25, 0.5, 0.125, 0.5});
  // A mirror shows its colour and covers.
  scene.entities = {Plane{.normal = {0, 0, -1}, .position = {0, 0, 1}, .material = inert(1)}};
  CHECK(seen(scene, {0, 0, 0}, {0, 0, 1}) == Color{0.5, 1, 0.25, 1});
}
