// What starts inside a closed room never gets out, and no light gets in.
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>

#include "extremes/rooms.hpp"
#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Returns every room as it is, turned, and scaled and put somewhere far away.
std::vector<Room> placed_rooms() {
  std::vector<Room> result;
  for (const Room& room : all_rooms()) {
    result.push_back(room);
    result.push_back(room.placed(rotate_degrees({17, 71, 41}), 1));
    Transform skewed = rotate_degrees({33, 5, 67});
    skewed.row_x *= 3e-3;
    skewed.row_y *= 5e-3;
    skewed.row_z *= 2e-3;
    skewed.translation = {70, -900, 20};
    result.push_back(room.placed(skewed, 2e-3));
  }
  return result;
}

/// Returns a ray from within the room: anywhere, at a corner, or along an axis.
Ray inner_ray(const Room& room, Random& random) {
  Ray ray{.origin = room.middle + random.between(0, room.free) * random.direction(),
          .direction = random.direction()};
  const int kind = random.integer(0, 3);
  if (kind == 1 && !room.corners.empty()) {
    const Vec3 corner = room.corners[static_cast<std::size_t>(
        random.integer(0, static_cast<int>(room.corners.size()) - 1))];
    ray.direction = corner - ray.origin;
    if (random.integer(0, 1) == 0) {  // at somewhere on an edge
      const Vec3 other = room.corners[static_cast<std::size_t>(
          random.integer(0, static_cast<int>(room.corners.size()) - 1))];
      ray.direction += random.between(0, 1) * (other - corner);
    }
  } else if (kind == 2) {
    ray.direction = Vec3(0);
    ray.direction[random.integer(0, 2)] = random.integer(0, 1) == 0 ? 1 : -1;
    if (random.integer(0, 1) == 0) ray.origin = room.middle;
  }
  return ray.direction == Vec3(0) ? Ray{.origin = room.middle} : ray;
}

/// Counts how many of the rays leave the room.
int leaks(const Room& room, Precision precision, int rays, unsigned seed) {
  Scene scene;
  scene.settings.precision = precision;
  scene.entities = room.walls;
  RayQueries queries(prepare(scene));
  Random random(seed);
  int leaked = 0;
  for (int i = 0; i < rays; ++i) {
    const std::optional<Hit> hit = queries.intersect(inner_ray(room, random));
    if (!hit || (room.within_solid && hit->entering)) ++leaked;
  }
  return leaked;
}

/// Checks all rooms. The exact tier gets a fifth of the rays, as those at the tips of tori take it
/// a millisecond each.
void check_all_rooms(int rays) {
  unsigned seed = 0;
  for (const Room& room : placed_rooms()) {
    CAPTURE(room.name);
    CAPTURE(seed);
    CHECK(leaks(room, Precision::standard, rays, ++seed) == 0);
    CHECK(leaks(room, Precision::exact, rays / 5, ++seed) == 0);
  }
}

/// Makes a panorama of `height` rows from the middle of the room.
Scene panorama(const Room& room, const Material& material, int height) {
  Scene scene = dark_scene();
  scene.entities = room.with_material(material);
  scene.camera = {.position = room.middle,
                  .pointing = room.middle + Vec3(0.3, 0.2, 1),
                  .fov = std::numbers::pi,
                  .projection = Projection::spherical};
  scene.settings.width = 2 * height;
  scene.settings.height = height;
  return scene;
}

int lit_pixels(const Scene& scene) {
  const Image image = render(prepare(scene), {.threads = 1});
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) count += image.at(x, y) == Color{0, 0, 0, 1} ? 0 : 1;
  }
  return count;
}

}  // namespace

TEST_CASE("no ray gets out of a closed room") {
  check_all_rooms(5'000);
}

TEST_CASE("no ray of ten million gets out of a closed room" * doctest::skip()) {
  check_all_rooms(100'000);
}

TEST_CASE("light between mirrors on all sides never gets out") {
  for (const Room& room : placed_rooms()) {
    Scene scene = panorama(room, inert(1), 8);
    scene.background = SolidBackground{{1, 1, 1}};
    scene.settings.recursion_depth = 100;
    CAPTURE(room.name);
    CHECK(lit_pixels(scene) == 0);
  }
}

TEST_CASE("no light gets into a closed room") {
  for (const Room& room : placed_rooms()) {
    if (room.open) continue;
    Scene scene = panorama(room, Material{.color = grey(1)}, 32);
    const double far = 100 * room.free;
    Random random(5);
    for (int i = 0; i < 3; ++i) {
      scene.lights.emplace_back(PointLight{.origin = room.middle + far * random.direction()});
      scene.lights.emplace_back(ParallelLight{.from = random.direction(), .pointing = Vec3(0)});
    }
    CAPTURE(room.name);
    CHECK(lit_pixels(scene) == 0);
  }
}

TEST_CASE("no light gets out of a closed room") {
  for (const Room& room : placed_rooms()) {
    if (room.open) continue;
    Scene scene = panorama(room, Material{.color = grey(1)}, 32);
    scene.lights = {PointLight{.origin = room.middle}};
    scene.camera.projection = Projection::pinhole;
    scene.camera.fov = 0.8;
    scene.camera.pointing = room.middle;
    Random random(6);
    for (int i = 0; i < 3; ++i) {
      scene.camera.position = room.middle + 100 * room.free * random.direction();
      CAPTURE(room.name);
      CHECK(lit_pixels(scene) == 0);
    }
  }
}
