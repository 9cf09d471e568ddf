#include "core/shading/prepared_material.hpp"

#include <doctest/doctest.h>

using namespace crt::core;

namespace {

PreparedMaterial prepared(const crt::Material& material) {
  TexturePool textures(1);
  LayerTablePool tables;
  return {material, {textures, textures, tables}};
}

}  // namespace

TEST_CASE("the diffuse strength is by default what is neither mirrored nor let through") {
  CHECK(prepared({}).diffuse(0.0) == 1);
  CHECK(prepared({.reflectivity = 0.25}).diffuse(0.5) == 0.25);
  CHECK(prepared({.reflectivity = 0.75}).diffuse(0.5) == 0);
  CHECK(prepared({.reflectivity = 0.75, .diffuse = 2.0}).diffuse(0.5) == 2);
}

TEST_CASE("a gap in the colour lets all light through") {
  const PreparedMaterial half = prepared({.transparency = 0.5});
  CHECK(half.transparency(1.0) == 0.5);
  CHECK(half.transparency(0.0) == 1);
  CHECK(half.transparency(0.5) == 0.75);
}

TEST_CASE("a material is opaque if neither its transparency nor its colour lets light through") {
  CHECK(prepared({}).opaque);
  CHECK_FALSE(prepared({.transparency = 0.01}).opaque);
  CHECK_FALSE(prepared({.color = crt::Color{1, 1, 1, 0.5}}).opaque);
  CHECK_FALSE(prepared({.color = crt::Pattern(crt::Checker{.color_a = {1, 1, 1, 0}})}).opaque);
  CHECK(prepared({.color = crt::Pattern(crt::Checker{})}).opaque);
}

TEST_CASE(
    "what lets light through brightens it by its brightest channel at most, and darkens nothing") {
  CHECK(prepared({.color = crt::Color{7, 2, 3}}).gain == 1);
  CHECK(prepared({.color = crt::Color{7, 2, 3}, .transparency = 0.1}).gain == 7);
  CHECK(prepared({.color = crt::Color{0.7, 0.2, 0}, .transparency = 1}).gain == 1);
  CHECK(prepared({.color = crt::Color{0, 4, 0, 0.5}}).gain == 4);
  const crt::Pattern clouds = crt::Noise{.color_a = {1, 2, 1}, .color_b = {0, 0, 3}};
  CHECK(prepared({.color = clouds, .transparency = 1}).gain == 3);
  auto picture = std::make_shared<crt::Image>(2, 1);
  picture->set(0, 0, {1, 2, 1, 0.25});
  picture->set(1, 0, {5, 6, 1, 1});
  CHECK(prepared({.color = crt::Pattern(crt::ImageMap{.image = picture})}).gain == 8);
}

TEST_CASE("only what light can enter absorbs it") {
  CHECK(prepared({.transparency = 1, .absorption = {0, 0, 1}}).absorbing);
  CHECK_FALSE(prepared({.absorption = {0, 0, 1}}).absorbing);
  CHECK_FALSE(prepared({.transparency = 1}).absorbing);
}

TEST_CASE("bumps of no height are none") {
  CHECK(prepared({.bump = crt::Noise{}}).bump.has_value());
  CHECK_FALSE(prepared({.bump = crt::Noise{}, .bump_height = 0}).bump.has_value());
}
