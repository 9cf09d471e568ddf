// These are small pictures for tests whose pixels are known by hand.
#pragma once

#include <doctest/doctest.h>

#include <crt/render.hpp>

#include <cstring>

namespace crt::test {

/// Makes the scene that every other here starts from: black all around and where rays end, no light
/// from the camera, no limit on weights, and ambient light that surfaces of all colours send back
/// alike.
inline Scene dark_scene() {
  Scene scene;
  scene.background = SolidBackground{{0, 0, 0}};
  scene.settings.min_weight = 0;
  scene.settings.cutoff = Cutoff::black;
  scene.settings.head_light = false;
  scene.settings.ambient_model = AmbientModel::light;
  return scene;
}

/// Returns the picture of one pixel, whose only ray goes from `eye` to `target`.
inline Image look(Scene scene, const Vec3& eye, const Vec3& target) {
  scene.settings.width = 1;
  scene.settings.height = 1;
  scene.camera.position = eye;
  scene.camera.pointing = target;
  return render(prepare(scene), {.threads = 1});
}

inline Color seen(const Scene& scene, const Vec3& eye, const Vec3& target) {
  return look(scene, eye, target).at(0, 0);
}

/// Says whether two pictures have the same bytes.
inline bool same_pixels(const Image& a, const Image& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

/// Checks that a picture has the same bytes for any number of threads, and in a part of it.
inline void check_threads_and_regions(const PreparedScene& scene) {
  const Image one = render(scene, {.threads = 1});
  CHECK(same_pixels(render(scene, {.threads = 5}), one));
  const Image part = render(scene, {.region = Region{11, 5, 13, 9}});
  for (int y = 0; y < part.height(); ++y) {
    for (int x = 0; x < part.width(); ++x) REQUIRE(part.at(x, y) == one.at(11 + x, 5 + y));
  }
}

/// Makes a light that only has an ambient share. Every surface that mirrors nothing is `level`
/// bright.
inline Light glow(double level) {
  return ParallelLight{
      .from = {0, 0, 0}, .pointing = {0, 1e-3, 0}, .color = grey(level), .ambient = 1};
}

/// Makes a material that answers no light but the ambient one.
inline Material inert(double reflectivity = 0, double transparency = 0) {
  return {
      .color = grey(1), .reflectivity = reflectivity, .transparency = transparency, .diffuse = 0};
}

/// Makes clear glass.
inline Material glass(double refractive_index) {
  return {.color = grey(1), .transparency = 1, .refractive_index = refractive_index, .diffuse = 0};
}

/// Makes a panorama that is `up` above the horizon and `down` below it, but for a thin blend.
inline PanoramaBackground two_halves(const Color& up, const Color& down) {
  auto image = std::make_shared<Image>(1, 64);
  for (int y = 0; y < 64; ++y) image->set(0, y, y < 32 ? up : down);
  return {.image = image};
}

/// Makes a scene for target errors: curved silhouettes, glass, a mirror, a shadow, a checked floor
/// and a lens.
inline Scene varied_scene() {
  Scene scene;
  scene.settings = {
      .width = 37, .height = 26, .dof_samples = 2, .target_error = 8.0 / 255, .max_samples = 64};
  scene.camera = {
      .position = {0.3, 1.5, -5}, .pointing = {0, 0.5, 0}, .aperture = 50, .focal_distance = 5};
  scene.background = GradientBackground{};
  scene.lights = {PointLight{.origin = {3, 5, -4}, .falloff = 80, .ambient = 0.05}};
  const Material tiles{.color = Pattern(Checker{}), .reflectivity = 0.2};
  scene.entities = {Plane{.material = tiles},
                    Sphere{.center = {0, 1, 0}, .radius = 1, .material = glass(1.5)},
                    Sphere{.center = {-1.5, 0.5, 1}, .radius = 0.5}};
  return scene;
}

}  // namespace crt::test
