// This library of somebody else's program writes a small picture.
#include <crt/crt.hpp>
#include <crt/script.hpp>

void draw(const char* picture) {
  crt::Scene scene =
      crt::run_script("Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }", "sphere.crt")
          .scene.value();
  scene.settings = {.width = 64, .height = 48};
  crt::render(crt::prepare(scene)).write(picture);
}
