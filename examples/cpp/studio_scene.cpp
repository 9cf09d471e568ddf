// This program shows a scene of its own in a browser, as `crt studio` shows scripts. Each line that
// it reads is the number of balls of another scene, and the page shows that at once.
#include <cmath>
#include <crt/crt.hpp>
#include <crt/studio.hpp>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <string>

namespace {

crt::Scene ring_of(int count) {
  crt::Scene scene;
  scene.entities.emplace_back(crt::Plane{.normal = {0, 1, 0}});
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    const double share = static_cast<double>(i) / count;
    scene.entities.emplace_back(
        crt::Sphere{.center = {2 * std::cos(angle), 0.5, 2 * std::sin(angle)},
                    .radius = 0.5,
                    .material = crt::Material{.color = crt::Color{0.8, 0.8 * share, 0.1}}});
  }
  scene.lights = {crt::PointLight{.origin = {3, 5, -4}}};
  scene.camera = {.position = {0, 3, -6}, .pointing = {0, 0.3, 0}};
  scene.settings = {.width = 320, .height = 240};
  return scene;
}

}  // namespace

int main() try {
  crt::SceneServer server(ring_of(7), {.title = "ring of balls"});
  std::printf("Open %s\n", server.address().c_str());
  std::printf("A number shows so many balls, and the end of the input ends the program.\n");
  std::fflush(stdout);
  for (int count = 0; std::cin >> count;) server.show(ring_of(count));
  return 0;
} catch (const crt::Error& error) {
  std::fprintf(stderr, "studio_scene: %s\n", error.what());
  return 1;
}
