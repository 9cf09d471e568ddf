// A crank turns, and a piston goes up and down in its cylinder. At each step the scene is prepared
// from the step before, so that only what has moved is prepared again. A ray measures how near the
// piston comes to the cylinder's head.
#include <algorithm>
#include <cmath>
#include <crt/crt.hpp>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <numbers>
#include <optional>

namespace {

using namespace crt;

constexpr double crank_radius = 1;
constexpr double rod_length = 3;
constexpr double head = 4.75;          // where the cylinder ends
constexpr double piston_height = 0.7;  // from the pin to the top

/// Returns a rod from one pin to another, which are along y before it is placed.
Entity rod() {
  const Entity bar = Box{.corner_a = {-0.15, 0, -0.1}, .corner_b = {0.15, rod_length, 0.1}};
  const Entity big_end = Cylinder{.from = {0, 0, -0.2}, .to = {0, 0, 0.2}, .radius = 0.35};
  const Entity small_end =
      Cylinder{.from = {0, rod_length, -0.2}, .to = {0, rod_length, 0.2}, .radius = 0.25};
  return bar + big_end + small_end;
}

Entity piston() {
  const Entity body = Cylinder{.from = {0, -0.4, 0}, .to = {0, piston_height, 0}, .radius = 0.95};
  return body - Box{.corner_a = {-0.5, -1, -0.3}, .corner_b = {0.5, 0.4, 0.3}};
}

Entity crank() {
  const Entity disc = Cylinder{.from = {0, 0, 0.25}, .to = {0, 0, 0.5}, .radius = 1.4};
  const Entity pin =
      Cylinder{.from = {0, crank_radius, -0.3}, .to = {0, crank_radius, 0.3}, .radius = 0.2};
  return disc + pin;
}

/// Returns half of a cylinder, so that one sees into it.
Entity housing() {
  const Entity outside = Cylinder{.from = {0, 1.8, 0}, .to = {0, head + 0.4, 0}, .radius = 1.3};
  const Entity bore = Cylinder{.from = {0, 1, 0}, .to = {0, head, 0}, .radius = 1};
  return outside - bore - Box{.corner_a = {-2, 0, -2}, .corner_b = {2, 9, -0.2}};
}

SharedMaterial paint(double red, double green, double blue) {
  return Material{.color = Color{red, green, blue}, .specular = 0.3, .shininess = 40};
}

void run() {
  constexpr int steps = 180;
  const Entity parts[] = {
      housing().with_material(paint(0.5, 0.55, 0.6)), crank().with_material(paint(0.8, 0.3, 0.2)),
      rod().with_material(paint(0.9, 0.7, 0.2)), piston().with_material(paint(0.3, 0.5, 0.8))};
  Scene scene;
  scene.entities.assign(std::begin(parts), std::end(parts));
  scene.lights = {PointLight{.origin = {-6, 8, -12}}};
  scene.camera = {.position = {-4, 4, -12}, .pointing = {0, 2.2, 0}, .fov = 0.6};
  scene.settings.width = 160;
  scene.settings.height = 200;

  std::optional<PreparedScene> prepared;
  double nearest = 1;
  for (int step = 0; step < steps; ++step) {
    const double angle = 2 * std::numbers::pi * step / steps;
    const double degrees = 360.0 * step / steps;
    const Vec3 pin(crank_radius * std::sin(angle), crank_radius * std::cos(angle), 0);
    const double tilt = std::asin(pin.x / rod_length);
    const double height = pin.y + rod_length * std::cos(tilt);
    scene.entities[1] = parts[1].transformed(rotate_degrees({0, 0, -degrees}));
    scene.entities[2] = parts[2]
                            .transformed(rotate_degrees({0, 0, tilt * 180 / std::numbers::pi}))
                            .transformed(translate(pin));
    scene.entities[3] = parts[3].transformed(translate({0, height, 0}));

    prepared = prepared ? prepare(scene, *prepared) : prepare(scene);

    const Ray ray{.origin = {0, head, 0.5}, .direction = {0, -1, 0}};  // down from the head
    if (const auto hit = intersect(*prepared, ray)) nearest = std::min(nearest, hit->t);
    if (step == steps / 8) render(*prepared).write("mechanism.png");
  }
  std::cout << std::fixed << std::setprecision(3) << "the piston comes within " << nearest
            << " of the head\n";
}

}  // namespace

int main() try { run(); } catch (const crt::Error& error) {
  std::cerr << "mechanism: " << error.what() << '\n';
  return 1;
}
