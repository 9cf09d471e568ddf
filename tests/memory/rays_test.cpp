// Rays take nothing from the heap.
#include <doctest/doctest.h>

#include "memory/counting_new.hpp"
#include "memory/scenes.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Makes a scene of everything that rays may meet.
Scene rich_scene() {
  Scene scene;
  const Material glass{.color = Color{0.9, 0.95, 1},
                       .transparency = 0.8,
                       .refractive_index = 1.5,
                       .absorption = {0.1, 0.1, 0}};
  const Material mirror{.reflectivity = 0.6};
  const Material marble{.color = Pattern(Marble{}), .bump = Pattern(Noise{})};
  const Material wood{.color = Pattern(Wood{}), .specular = 0.5};
  scene.entities.push_back(csg_difference(block.with_material(wood), balls(300, 0.8)));
  scene.entities.push_back(Entity(Sphere{.center = {-1, 1, -7}, .radius = 1.5, .material = glass}));
  scene.entities.push_back(Entity(Sphere{.center = {-1, 1, -7}, .radius = 0.7, .material = glass}));
  scene.entities.push_back(
      Entity(Box{.corner_a = {1, -1, -8}, .corner_b = {3, 1, -6}, .material = glass}) -
      Cylinder{.from = {2, -2, -7}, .to = {2, 2, -7}, .radius = 0.5});
  scene.entities.push_back(Entity(Torus{.radius = 2, .thickness = 0.4, .material = marble})
                               .transformed(rotate_degrees({40, 30, 20}))
                               .transformed(translate({-3, 3, -6})));
  scene.entities.push_back(Entity(Cone{.material = mirror}).transformed(translate({3, 3, -7})));
  scene.entities.push_back(Entity(Plane{.position = {0, -5, 0}, .material = mirror}));
  scene.entities.push_back(
      Entity(Disc{.center = {0, 6, -6}, .normal = {0, 1, 1}, .material = glass}));
  for (const Entity& ball : balls(200, 0.1, 7))
    scene.entities.push_back(ball.transformed(translate({0, 0, -5})));
  scene.lights = {PointLight{.origin = {5, 9, -12}},
                  SpotLight{.origin = {-8, 8, -9}, .pointing = {0, 0, 0}},
                  ParallelLight{.from = {0, 10, 0}, .pointing = {1, 0, 1}}};
  scene.camera = {
      .position = {0, 3, -14}, .pointing = {0, 0, 0}, .aperture = 5, .focal_distance = 8};
  scene.background = GradientBackground{};
  scene.settings = {.width = 48, .height = 36, .dof_samples = 4, .recursion_depth = 6};
  return scene;
}

std::uint64_t allocations_of(const PreparedScene& prepared, const RenderOptions& options) {
  const std::uint64_t before = allocations();
  render(prepared, options);
  return allocations() - before;
}

/// Grows the picture, so that what is taken per render, tile or thread does not count.
void check_rays_take_nothing(Scene scene) {
  const PreparedScene small = prepare(scene);
  scene.settings.supersampling = 3;
  const PreparedScene large = prepare(scene, small);
  const RenderOptions alone{.threads = 1};
  const std::uint64_t rays =
      render(large, alone).stats().camera_rays - render(small, alone).stats().camera_rays;
  const std::uint64_t of_small = allocations_of(small, alone);
  const std::uint64_t of_large = allocations_of(large, alone);
  // Lists grow to the longest that any ray has needed. There are a few of them, which take a few
  // steps each.
  constexpr std::uint64_t steps_of_growth = 64;
  CHECK_MESSAGE(of_large <= of_small + steps_of_growth, of_small, " allocations grow to ", of_large,
                " by ", rays, " rays");
}

std::vector<Ray> rays_towards_origin(std::size_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-9, 9);
  std::vector<Ray> rays(count);
  for (Ray& ray : rays) {
    for (int axis = 0; axis < 3; ++axis) {
      ray.origin[axis] = place(random);
      ray.direction[axis] = -ray.origin[axis] + place(random) / 3;
    }
  }
  return rays;
}

}  // namespace

TEST_CASE("rendering takes nothing from the heap per ray") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Scene scene = rich_scene();
    scene.settings.precision = precision;
    CAPTURE(static_cast<int>(precision));
    SUBCASE("with a lens") {
      check_rays_take_nothing(scene);
    }
    SUBCASE("without one") {
      scene.camera.aperture = 0;
      check_rays_take_nothing(scene);
    }
  }
}

TEST_CASE("queries take nothing from the heap once they know the longest ray") {
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    Scene scene = rich_scene();
    scene.settings.precision = precision;
    const PreparedScene prepared = prepare(scene);
    const std::vector<Ray> rays = rays_towards_origin(3000);
    RayQueries queries(prepared);
    std::vector<Hit> crossings;
    std::size_t found = 0;
    const auto ask_all = [&] {
      for (const Ray& ray : rays) {
        found += queries.intersect(ray).has_value();
        found += queries.occluded(ray);
        queries.crossings(ray, crossings);
        found += crossings.size();
      }
    };
    ask_all();
    const std::uint64_t before = allocations();
    ask_all();
    const std::uint64_t taken = allocations() - before;
    CHECK(found > 6 * rays.size());
    CHECK(taken == 0);
  }
}
