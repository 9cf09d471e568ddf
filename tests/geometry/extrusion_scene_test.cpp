// Extrusions in CSG: their faces are those of boxes and cylinders.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"
#include "geometry/profiles.hpp"
#include "support/scene_of.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Entity extrusion(const std::vector<Contour>& contours, double from, double to) {
  return Extrusion{.profile = make_profile(contours), .from = from, .to = to};
}

/// Returns a ray of small numbers, of which many pass through edges and along faces, or any. None
/// is along z, as CSG says otherwise what is on the wall of a hole.
Ray hard_ray(Random& random) {
  const auto whole = [&] { return std::floor(random.uniform(-4, 5)); };
  Ray ray{.origin = {whole(), whole(), whole()}, .t_min = -1e6};
  do ray.direction = {whole(), whole(), whole()};
  while (ray.direction.x == 0 && ray.direction.y == 0);
  if (random.one_in(2)) ray.origin += 0.5 * random.in_cube();
  if (random.one_in(2)) ray.direction += random.in_cube();
  return ray;
}

void check_equal(const Entity& a, const Entity& b, Precision precision, int rays) {
  const PreparedScene scene_a = scene_of(a, precision);
  const PreparedScene scene_b = scene_of(b, precision);
  Random random(1);
  int hits = 0;
  for (int i = 0; i < rays; ++i) {
    const Ray ray = hard_ray(random);
    const std::vector<Hit> hits_a = crossings(scene_a, ray);
    const std::vector<Hit> hits_b = crossings(scene_b, ray);
    REQUIRE(hits_a.size() == hits_b.size());
    for (std::size_t k = 0; k < hits_a.size(); ++k) {
      REQUIRE(hits_a[k].t == hits_b[k].t);
      REQUIRE(hits_a[k].entering == hits_b[k].entering);
    }
    hits += hits_a.empty() ? 0 : 1;
  }
  CHECK(hits > rays / 10);
}

}  // namespace

TEST_CASE("an arc that is written from its other end cuts flush, and leaves no film") {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const double x = random.uniform(-10, 10);
    const double y = random.uniform(-10, 10);
    const ProfilePoint to{x + random.uniform(0.1, 1), y + random.uniform(-1, 1),
                          random.uniform(0.3, 1)};
    const Contour contour = {{x, y}, to};
    const Contour reversed = {{to.x, to.y}, {x, y, -to.bulge}};
    const Entity solid = extrusion({contour}, 0, 1);
    for (const Precision tier : tiers) {
      const PreparedScene whole = scene_of(solid, tier);
      const PreparedScene less = scene_of(solid - extrusion({reversed}, 0, 1), tier);
      const PreparedScene twice = scene_of(extrusion({contour, reversed}, 0, 1), tier);
      int hits = 0;
      for (int k = 0; k < 20; ++k) {
        const double share = random.uniform(0, 1);
        const Vec3 aim(x + share * (to.x - x), y + share * (to.y - y), random.uniform(0.1, 0.9));
        const Ray ray{.origin = aim, .direction = random.in_cube(), .t_min = -1e6};
        hits += crossings(whole, ray).empty() ? 0 : 1;
        REQUIRE(crossings(less, ray).empty());
        REQUIRE(crossings(twice, ray).empty());
      }
      CHECK(hits == 20);
    }
  }
}

TEST_CASE("an extrusion that is flush with a box opens it, and fills what it has opened") {
  const Entity block = Box{.corner_a = {0, 0, 0}, .corner_b = {4, 4, 2}};
  const std::vector<Contour> contours = {rectangle(1, 0, 3, 2), circle(2, 3, 0.5, true)};
  const Entity cutter = extrusion(contours, 0, 2);
  for (const Precision tier : tiers) {
    const PreparedScene cut = scene_of(block - cutter, tier);
    const auto count = [&](const Vec3& origin, const Vec3& direction) {
      return crossings(cut, {.origin = origin, .direction = direction}).size();
    };
    CHECK(count({2, 1, -5}, {0, 0, 1}) == 0);
    CHECK(count({2, -5, 1}, {0, 1, 0}) == 4);  // through the slot, then through the hole
    CHECK(count({2, 3, -5}, {0, 0, 1}) == 0);
    CHECK(count({0.5, 1, -5}, {0, 0, 1}) == 2);
    CHECK(count({-5, 1, 1}, {1, 0, 0}) == 4);
    check_equal((block - cutter) + cutter, block, tier, 3000);
    CHECK(crossings(scene_of(cutter - block, tier), {.origin = {2, 1, -5}}).empty());
  }
}

TEST_CASE("an extrusion is what the same planes and cylinders make in CSG") {
  const Contour angle = {{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};
  const Entity boxes = Entity(Box{.corner_a = {-2, -2, -1}, .corner_b = {2, 0, 1}}) +
                       Box{.corner_a = {-2, -2, -1}, .corner_b = {0, 2, 1}};
  for (const Precision tier : tiers) check_equal(extrusion({angle}, -1, 1), boxes, tier, 5000);

  const auto tube = [](double x, double radius) -> Entity {
    return Cylinder{.from = {x, 0, -1}, .to = {x, 0, 1}, .radius = radius};
  };
  check_equal(extrusion({circle(0, 0, 2), circle(0, 0, 1, true)}, -1, 1), tube(0, 2) - tube(0, 1),
              Precision::exact, 5000);
  const Contour stadium = {{-1, -1}, {1, -1}, {1, 1, 1}, {-1, 1}, {-1, -1, 1}};
  const Entity parts =
      tube(-1, 1) + tube(1, 1) + Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}};
  check_equal(extrusion({stadium}, -1, 1), parts, Precision::exact, 5000);
}

TEST_CASE("a ray that hits the wall of a hole leaves it inwards") {
  for (const Precision tier : tiers) {
    const PreparedScene pipe = scene_of(extrusion({circle(0, 0, 2), circle(0, 0, 1)}, -1, 1), tier);
    const std::optional<Hit> hit = intersect(pipe, {.origin = {0, 0, 0}, .direction = {1, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->t == 1);
    CHECK(hit->entering);
    CHECK(hit->normal == Vec3(-1, 0, 0));
    CHECK_FALSE(occluded(pipe, {.origin = hit->position, .direction = {-1, 0, 2}, .t_min = 1e-9}));
  }
}

TEST_CASE("an extrusion of a thousand pieces is crossed as by a search through all of them") {
  Contour wheel;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * std::numbers::pi * i / 1000;
    const double radius = i % 2 == 0 ? 3 : 2.8;
    wheel.push_back({radius * std::cos(angle), radius * std::sin(angle), i % 3 == 0 ? 0.3 : 0});
  }
  const auto profile = profile_of({wheel});
  const RealProfile truth(profile);
  const PreparedScene scene =
      scene_of(Extrusion{.profile = profile, .from = -1, .to = 1}, Precision::standard);
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 direction = random.direction();
    const Ray ray{.origin = 3.0 * random.in_cube() - 9.0 * direction, .direction = direction};
    const std::vector<Hit> hits = crossings(scene, ray);
    REQUIRE(hits.size() % 2 == 0);
    for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
      if (hits[k + 1].t - hits[k].t < 1e-9) continue;
      const RealVec p(ray.origin + 0.5 * (hits[k].t + hits[k + 1].t) * ray.direction);
      if (std::abs(static_cast<double>(p.z)) > 1 - 1e-9) continue;
      REQUIRE(truth.contains(p) == (k % 2 == 0));
    }
  }
}
