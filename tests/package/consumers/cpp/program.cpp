// This is somebody else's program that links crt::core and crt::lang. It asks a ray, renders a
// small picture and writes it. usage: program picture.png
#include <crt/crt.hpp>
#include <crt/script.hpp>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 2) return 2;
  crt::Scene scene =
      crt::run_script("Scene { Sphere { center -> vec3(0, 0, 2) radius -> 1 } }", "sphere.crt")
          .scene.value();
  scene.lights = {crt::PointLight{.origin = {0, 3, 0}}};
  scene.settings = {.width = 64, .height = 48};
  const crt::PreparedScene prepared = crt::prepare(scene);

  const auto hit = crt::intersect(prepared, {.origin = {0, 0, -5}});
  if (!hit || hit->t != 6) {
    std::cerr << "the sphere was not hit at t = 6\n";
    return 1;
  }

  const crt::Image image = crt::render(prepared);
  image.write(argv[1]);
  std::cout << "crt " << crt::version() << ": " << argv[1] << " has " << image.width() << " x "
            << image.height() << " pixels\n";
} catch (const crt::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
