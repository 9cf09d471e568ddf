#include "scenes.hpp"

#include <vector>

namespace crt::bench {

namespace {

Scene studio() {
  Scene scene;
  scene.lights = {PointLight{.origin = {8, 12, -10}, .ambient = 0.1}};
  scene.camera = {.position = {3, 6, -11}, .pointing = {0, 0, 0}};
  scene.settings = {.width = 320, .height = 240};
  return scene;
}

/// Returns the place of one of n items across [-4, 4].
double spread(int index, int n) {
  return 8.0 * (index + 0.5) / n - 4;
}

}  // namespace

Scene balls(int n) {
  Scene scene = studio();
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      for (int z = 0; z < n; ++z) {
        scene.entities.emplace_back(
            Sphere{.center = {spread(x, n), spread(y, n), spread(z, n)}, .radius = 2.5 / n});
      }
    }
  }
  return scene;
}

Scene drilled_blocks(int n) {
  const double half = 3.0 / n;
  std::vector<Entity> drills;
  for (int drill = 0; drill < 8; ++drill) {
    const double x = half * (drill % 4 - 1.5) / 2;
    const double z = half * (drill < 4 ? -0.5 : 0.5);
    drills.emplace_back(
        Cylinder{.from = {x, -2 * half, z}, .to = {x, 2 * half, z}, .radius = half / 6});
  }
  const Entity block = csg_difference(Box{.corner_a = Vec3(-half), .corner_b = Vec3(half)}, drills);
  Scene scene = studio();
  for (int x = 0; x < n; ++x) {
    for (int z = 0; z < n; ++z) {
      scene.entities.push_back(block.transformed(translate({spread(x, n), 0, spread(z, n)})));
    }
  }
  return scene;
}

Scene curved(int n) {
  Scene scene = studio();
  const double size = 3.0 / n;
  for (int x = 0; x < n; ++x) {
    for (int z = 0; z < n; ++z) {
      const Vec3 place{spread(x, n), 0, spread(z, n)};
      const Vec3 top = place + Vec3(0, 2 * size, 0);
      switch ((x + z) % 3) {
        case 0:
          scene.entities.emplace_back(
              Torus{.center = place, .radius = size, .thickness = size / 3});
          break;
        case 1:
          scene.entities.emplace_back(Cone{.from = place, .to = top, .radius = size});
          break;
        default:
          scene.entities.emplace_back(Cylinder{.from = place, .to = top, .radius = size});
      }
    }
  }
  return scene;
}

Scene glass_and_mirrors() {
  const Material mirror{.color = grey(0.9), .reflectivity = 0.8};
  const Material glass{.color = grey(0.95), .transparency = 0.9, .refractive_index = 1.5};
  Scene scene = studio();
  scene.entities = {Plane{.position = {0, -2, 0}, .material = mirror}};
  for (int index = 0; index < 9; ++index) {
    const Vec3 center{3.0 * (index % 3 - 1), 0, 3.0 * (index / 3 - 1)};
    scene.entities.emplace_back(
        Sphere{.center = center, .radius = 1.2, .material = index % 2 == 0 ? glass : mirror});
  }
  scene.lights.emplace_back(PointLight{.origin = {-8, 9, -4}, .color = grey(0.5)});
  scene.lights.emplace_back(
      ParallelLight{.from = {0, 10, 5}, .pointing = {0, 0, 0}, .color = grey(0.4)});
  scene.settings.recursion_depth = 6;
  return scene;
}

}  // namespace crt::bench
