// The same scene with every length times 2^k is the same picture, byte for byte.
#include <doctest/doctest.h>

#include <cmath>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

Transform moved_and_turned(double unit) {
  Transform map = rotate_degrees({20, 50, 10});
  map.row_y *= 1.3;
  map.translation = unit * Vec3(-1.6, 0.6, -1);
  return map;
}

/// Makes every primitive, CSG with coincident faces, shadows, mirrors, glass that absorbs and is
/// full to the edge, patterns, bumps, a lens. Every length of it is multiplied by `unit`.
Scene scaled_scene(double unit) {
  Scene scene;
  scene.settings.width = 20;
  scene.settings.height = 15;
  scene.settings.dof_samples = 2;
  scene.settings.recursion_depth = 5;
  scene.background = GradientBackground{};
  scene.camera = {.position = unit * Vec3(0.3, 1.5, -5),
                  .pointing = unit * Vec3(0, 0.5, 0),
                  .aperture = 50 * unit,
                  .focal_distance = 5 * unit};
  scene.lights = {
      PointLight{.origin = unit * Vec3(3, 5, -4), .falloff = 40 * unit * unit, .ambient = 0.05},
      SpotLight{.origin = unit * Vec3(-4, 6, -2), .pointing = Vec3(0)},
      ParallelLight{.from = unit * Vec3(1, 1, -1), .pointing = Vec3(0), .color = grey(0.2)},
      CylinderLight{
          .origin = unit * Vec3(0, 6, 2), .pointing = unit * Vec3(0, 0, 2), .radius = unit}};
  Material crystal = glass(1.5);
  crystal.absorption = {0.1 / unit, 0.4 / unit, 0.2 / unit};
  Material water = glass(1.33);
  water.absorption = {0.5 / unit, 0.1 / unit, 0.1 / unit};
  const Material tiles{.color = Pattern(Checker{.scale = unit}), .reflectivity = 0.2};
  const Material veins{.color = Pattern(Marble{.scale = unit}), .reflectivity = 0.1};
  const Material clouds{.color = Pattern(Noise{.scale = unit}),
                        .specular = 0.5,
                        .bump = Noise{.scale = 0.25 * unit},
                        .bump_height = 0.02 * unit};
  const auto at = [unit](double x, double y, double z) { return unit * Vec3(x, y, z); };
  const Entity cup =
      Entity(Cylinder{.from = at(0, 0, 0), .to = at(0, 1.2, 0), .radius = 0.6 * unit}) -
      Entity(Cylinder{.from = at(0, 0.2, 0), .to = at(0, 1.2, 0), .radius = 0.5 * unit});
  const Entity block = Box{.corner_a = at(1, 0, 0), .corner_b = at(2, 1, 1), .material = clouds};
  scene.entities = {
      Plane{.material = tiles},
      cup.with_material(crystal),
      Cylinder{.from = at(0, 0.2, 0), .to = at(0, 0.9, 0), .radius = 0.5 * unit, .material = water},
      block - Entity(Sphere{.center = at(1.5, 1, 0.5), .radius = 0.4 * unit}) -
          Entity(Box{.corner_a = at(1, 0, 0), .corner_b = at(1.25, 1, 0.25)}),
      Entity(
          Box{.corner_a = at(-0.4, -0.3, -0.2), .corner_b = at(0.4, 0.3, 0.2), .material = veins})
          .transformed(moved_and_turned(unit)),
      Sphere{.center = at(-1.5, 0.5, 1), .radius = 0.5 * unit, .material = crystal},
      Cone{.from = at(-0.8, 0, -1),
           .to = at(-0.6, 0.8, -1),
           .radius = 0.3 * unit,
           .material = veins},
      Cone{.from = at(0.8, 0, -1),
           .to = at(0.9, 0.5, -1),
           .radius = 0.3 * unit,
           .radius2 = 0.1 * unit},
      Torus{.center = at(0, 0.3, -1.5),
            .axis = {0.1, 1, 0.2},
            .radius = 0.4 * unit,
            .thickness = 0.1 * unit},
      Disc{.center = at(2, 1, 2), .normal = {0, 0, -1}, .radius = 0.7 * unit, .material = clouds},
      Triangle{.a = at(-2, 0, 2), .b = at(-1, 0, 2), .c = at(-1.5, 2, 2.5), .material = veins},
      HalfPlane{.normal = {0, 0, -1},
                .position = at(0, 1.5, 4),
                .direction = {0.2, 1, 0},
                .material = tiles}};
  return scene;
}

void check_scales(Precision precision, int step) {
  const auto taken = [&](int exponent) {
    Scene scene = scaled_scene(std::ldexp(1.0, exponent));
    scene.settings.precision = precision;
    return render(prepare(scene), {.threads = 1});
  };
  const Image reference = taken(0);
  for (int exponent = -300; exponent <= 300; exponent += step) {
    CAPTURE(exponent);
    CHECK(same_pixels(taken(exponent), reference));
  }
}

}  // namespace

TEST_CASE("multiplying every length by 2^k gives the same bytes for every k from -300 to 300") {
  check_scales(Precision::standard, 1);
}

TEST_CASE("exact: multiplying every length by 2^k gives the same bytes") {
  check_scales(Precision::exact, 25);
}
