// Principled surfaces send back all light, the same way both ways.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/shading/fresnel.hpp"
#include "principled_surfaces.hpp"

using namespace crt::test;
using crt::Vec3;

TEST_CASE("white surfaces send back all light, whatever they are a mixture of") {
  // Sums in tables and over directions, and tables between their entries, err by so much.
  constexpr double lost = 1e-2;
  constexpr double made = 1e-3;
  for (const Layers& layers : all_layers()) {
    for (const double metallic : shares) {
      for (const double transmission : shares) {
        if (metallic == 1 && transmission > 0) continue;
        if ((metallic == 0.5) != (transmission == 0.5)) continue;
        for (const double roughness : {0.0, 0.5, 1.0}) {
          const Surface surface = surface_of(metallic, roughness, transmission, layers);
          for (const bool from_outside : {true, false}) {
            if (!from_outside && transmission == 0) continue;
            for (const double cosine : cosines) {
              CAPTURE(layers.coat);
              CAPTURE(layers.coat_roughness);
              CAPTURE(layers.sheen);
              CAPTURE(metallic);
              CAPTURE(transmission);
              CAPTURE(roughness);
              CAPTURE(from_outside);
              CAPTURE(cosine);
              const Vec3 white = albedo(surface.seen(from_outside), cosine);
              CHECK(white.x > 1 - lost);
              CHECK(white.x < 1 + made);
            }
          }
        }
      }
    }
  }
}

TEST_CASE("light takes the same path back") {
  for (const Surface& surface : rough_surfaces()) {
    const double index = surface.layers.index_behind;
    for (int k = 0; k < 2000; ++k) {
      const auto [a, b, turn] = numbers_at(k);
      const Vec3 o = direction(0.01 + 0.99 * a);
      const Vec3 i = direction((b < 0.5 ? 1 : -1) * (0.01 + 0.98 * std::abs(2 * b - 1)), turn);
      // The value has the cosine at the light, and is of radiance by the index's square.
      const Vec3 there = evaluate<double>(surface.seen(true), o, up, i).value / std::abs(i.z);
      const bool is_through = i.z < 0;
      const Vec3 back =
          is_through ? evaluate<double>(surface.seen(false), -i, up, -o).value / o.z / index / index
                     : evaluate<double>(surface.seen(true), i, up, o).value / o.z;
      const Vec3 ahead = is_through ? there / index / index : there;
      const double scale = is_through ? index * index : 1;
      for (int channel = 0; channel < 3; ++channel) {
        CAPTURE(k);
        CHECK(ahead[channel] == doctest::Approx(back[channel] * scale).epsilon(1e-12));
      }
    }
  }
}

TEST_CASE("a rough dielectric without a metal's share is tinted by its colour in its body alone") {
  const Surface black = surface_of(0, 0.3, 0, {}, Vec3(0));
  const double mirrored = albedo(black.seen(true), 0.75).x;
  CHECK(mirrored == doctest::Approx(fresnel_reflectance(0.75, 1.0, 1.5)).epsilon(0.1));
}

TEST_CASE("tables for patterns of roughness are those of single ones, nearly") {
  Layers layers{.coat = 0.5, .sheen = 0.2};
  layers.roughness = -1;
  const LayerTables all(layers);
  for (const double roughness : {0.0, 0.21, 0.5, 0.73, 1.0}) {
    layers.roughness = roughness;
    const LayerTables one(layers);
    for (int k = 0; k <= 100; ++k) {
      const auto a = all.outside().at(k / 100.0, roughness);
      const auto b = one.outside().at(k / 100.0, roughness);
      CHECK(std::abs(a.metal - b.metal) < 5e-3);
      CHECK(std::abs(a.dielectric - b.dielectric) < 5e-3);
      CHECK(std::abs(a.transparent - b.transparent) < 5e-3);
    }
  }
}

TEST_CASE("tables of equal layers are computed once, also for a scene that was edited") {
  LayerTablePool before;
  const auto tables = before.get({.coat = 0.5});
  CHECK(before.get({.coat = 0.5}) == tables);
  CHECK(before.get({.coat = 0.25}) != tables);
  CHECK(before.bytes() >= 2 * tables->bytes());
  LayerTablePool after(&before);
  CHECK(after.get({.coat = 0.5}) == tables);
  after.settle();
  CHECK(after.get({.coat = 0.25}) != before.get({.coat = 0.25}));
}
