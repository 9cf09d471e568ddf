// This is the smallest program that makes a picture: a ball with a corner cut out, on a floor.
#include <crt/crt.hpp>
#include <iostream>

int main() try {
  const crt::Material red{.color = crt::Color{0.6, 0.02, 0.01}, .specular = 0.5, .shininess = 40};
  const crt::Material mirror{.color = crt::grey(0.7), .reflectivity = 0.5};
  const crt::Material tiles{
      .color = crt::Checker{.color_a = crt::grey(0.6), .color_b = crt::grey(0.15)}};

  const crt::Entity ball = crt::Sphere{.center = {0, 1, 0}, .radius = 1, .material = red};
  const crt::Entity corner =
      crt::Box{.corner_a = {0, 1, 0}, .corner_b = {2, 3, -2}, .material = mirror};

  crt::Scene scene;
  scene.entities = {ball - corner, crt::Plane{.normal = {0, 1, 0}, .material = tiles}};
  scene.lights = {crt::PointLight{.origin = {3, 5, -4}, .ambient = 0.05}};
  scene.camera = {.position = {1.8, 2.2, -5}, .pointing = {0, 1.1, 0}, .fov = 0.6};
  scene.background = crt::GradientBackground{};
  scene.settings = {.width = 480, .height = 360, .supersampling = 3};

  crt::render(crt::prepare(scene)).write("hello.png");
} catch (const crt::Error& error) {
  std::cerr << "hello: " << error.what() << '\n';
  return 1;
}
