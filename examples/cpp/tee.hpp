// This is the part of the tutorial for C++: a tee of pipes with flanges, drilled for bolts.
#pragma once

#include <crt/crt.hpp>

/// Makes a flange about the x axis that ends at x = 2, with holes for eight bolts.
inline crt::Entity flange() {
  crt::Entity disc = crt::Cylinder{.from = {1.7, 0, 0}, .to = {2, 0, 0}, .radius = 1.5};
  const crt::Entity hole = crt::Cylinder{.from = {1, 1.25, 0}, .to = {3, 1.25, 0}, .radius = 0.12};
  for (int i = 0; i < 8; ++i) disc = disc - hole.transformed(crt::rotate_degrees({45.0 * i, 0, 0}));
  return disc;
}

/// Makes the tee. Its run lies along x, and its branch points up.
inline crt::Entity tee() {
  const crt::Entity run = crt::Cylinder{.from = {-2, 0, 0}, .to = {2, 0, 0}, .radius = 1};
  const crt::Entity run_bore = crt::Cylinder{.from = {-3, 0, 0}, .to = {3, 0, 0}, .radius = 0.85};
  const crt::Entity branch = crt::Cylinder{.from = {0, 0, 0}, .to = {0, 2, 0}, .radius = 0.8};
  const crt::Entity branch_bore = crt::Cylinder{.from = {0, 0, 0}, .to = {0, 3, 0}, .radius = 0.6};

  const crt::Entity right = flange();
  const crt::Entity left = right.transformed(crt::rotate_degrees({0, 180, 0}));
  const crt::Entity top =
      right.transformed(crt::scale({1, 0.85, 0.85})).transformed(crt::rotate_degrees({0, 0, 90}));

  const crt::Entity solid = run + branch + right + left + top - run_bore - branch_bore;
  return solid.with_material(crt::Material{.color = crt::Color{0.55, 0.28, 0.10},
                                           .reflectivity = 0.12,
                                           .specular = 0.6,
                                           .shininess = 40});
}

/// Puts the tee on a floor, with lights and a camera.
inline crt::Scene tee_scene() {
  const crt::Material floor{.color = crt::Color{0.12, 0.14, 0.18}, .reflectivity = 0.08};
  const crt::Vec3 camera{4, 4, -8};

  crt::Scene scene;
  scene.entities = {tee(),
                    crt::Plane{.normal = {0, 1, 0}, .position = {0, -1.5, 0}, .material = floor}};
  scene.lights = {crt::ParallelLight{.from = {-4, 6, -3}, .color = crt::Color{1.2, 1.1, 1.0}},
                  crt::PointLight{.origin = camera, .color = crt::Color{0.35, 0.38, 0.45}}};
  scene.camera = {.position = camera, .pointing = {0, 0.05, 0}, .fov = 0.5};
  scene.background = crt::GradientBackground{.horizon = {0.8, 0.84, 0.88}, .sky = {0.1, 0.2, 0.4}};
  scene.settings = {.width = 480, .height = 360, .supersampling = 3};
  return scene;
}
