// These tests check what Settings::precision changes of ray queries and renders.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "crt/query.hpp"
#include "crt/render.hpp"

using namespace crt;

namespace {

Scene exact_scene() {
  Scene scene;
  scene.settings.precision = Precision::exact;
  return scene;
}

/// This turns and scales without rounding: (x, y) becomes (3x - 4y, 4x + 3y), and z becomes 5z.
const Transform turned_by_345{{3, -4, 0}, {4, 3, 0}, {0, 0, 5}, {0, 0, 0}};

}  // namespace

TEST_CASE("exact: a ray past a turned sphere hits by one ulp, or misses") {
  Scene scene = exact_scene();
  scene.entities.push_back(Entity(Sphere{}).transformed(turned_by_345));
  const PreparedScene prepared = prepare(scene);
  const auto hits = [&](double x) {
    return intersect(prepared, {.origin = {x, 4, -1000}, .direction = {0, 0, 1}}).has_value();
  };
  CHECK(hits(std::nextafter(3, 0)));
  CHECK_FALSE(hits(3));
  CHECK_FALSE(hits(std::nextafter(3, 4)));
}

TEST_CASE("exact: crossings whose t is the same double are distinguished, and equal ones are not") {
  Scene scene = exact_scene();
  // The ray comes from so far that t has no bits left for a difference of 2^-20 at the slab's two
  // faces.
  scene.entities.push_back(Entity(Box{.corner_a = {-1, -1, 0}, .corner_b = {1, 1, 0x1p-20}}) -
                           Entity(Box{.corner_a = {-2, -2, -1}, .corner_b = {2, 2, 0}}));
  scene.entities.push_back(Entity(Box{.corner_a = {9, -1, 0}, .corner_b = {11, 1, 1}}) -
                           Entity(Box{.corner_a = {8, -2, 0}, .corner_b = {12, 2, 1}}));
  const PreparedScene prepared = prepare(scene);
  const std::vector<Hit> slab =
      crossings(prepared, {.origin = {0, 0, -0x1p40}, .direction = {0, 0, 1}});
  REQUIRE(slab.size() == 2);
  CHECK(slab[0].entering);
  CHECK_FALSE(slab[1].entering);
  CHECK(slab[0].t == slab[1].t);
  CHECK(crossings(prepared, {.origin = {10, 0, -0x1p40}, .direction = {0, 0, 1}}).empty());
}

TEST_CASE(
    "exact: the picture and the count of escalations do not depend on the number of threads") {
  Scene scene = exact_scene();
  scene.settings.width = 48;
  scene.settings.height = 32;
  scene.lights.emplace_back(PointLight{.origin = {2, 4, -6}});
  scene.camera.position = {0, 0, -5};
  scene.entities.push_back(Entity(Sphere{}).transformed(turned_by_345) -
                           Entity(Box{.corner_a = {-1, 0, -9}, .corner_b = {1, 9, 9}}));
  scene.entities.push_back(Entity(Plane{.normal = {0, 1, 0}, .position = {0, -5, 0}}));
  const PreparedScene prepared = prepare(scene);
  const Image one = render(prepared, {.threads = 1});
  const Image two = render(prepared, {.threads = 2});
  CHECK(std::ranges::equal(one.pixels(), two.pixels()));
  CHECK(one.stats().escalations == two.stats().escalations);
  scene.settings.precision = Precision::standard;
  CHECK(render(prepare(scene), {.threads = 1}).stats().escalations == 0);
}
