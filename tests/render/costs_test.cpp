// A scene pays only for what it uses, as the counts show.
#include <doctest/doctest.h>

#include "pictures.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr std::uint64_t pixels = 30 * 20;

Scene small_scene(const Material& material) {
  Scene scene;
  scene.settings.width = 30;
  scene.settings.height = 20;
  scene.camera = {.position = {0, 1, -4}, .pointing = {0, 0.5, 0}};
  scene.entities = {Plane{.material = material},
                    Sphere{.center = {0, 1, 0}, .radius = 0.8, .material = material}};
  return scene;
}

RenderStats stats_of(const Scene& scene) {
  return render(prepare(scene)).stats();
}

}  // namespace

TEST_CASE("without light there are no shadow rays, with an opaque scene only camera rays") {
  Scene scene = small_scene({});
  scene.settings.head_light = false;
  const RenderStats stats = stats_of(scene);
  CHECK(stats.camera_rays == pixels);
  CHECK(stats.pixels == pixels);
  CHECK(stats.shadow_rays == 0);
  CHECK(stats.reflection_rays == 0);
  CHECK(stats.refraction_rays == 0);
  CHECK(stats.media_lookups == 0);
  CHECK(stats.media_changes == 0);
  CHECK(stats.pattern_lookups == 0);
  CHECK(stats.lens_samples == 0);
  CHECK(stats.interval_events == 0);
  CHECK(stats.intersection_tests > 0);
}

TEST_CASE("an empty scene costs a camera ray a pixel") {
  Scene scene = small_scene({});
  scene.entities.clear();
  const RenderStats stats = stats_of(scene);
  CHECK(stats.camera_rays == pixels);
  CHECK(stats.intersection_tests == 0);
}

TEST_CASE("a shadow ray is sent only where the light would count") {
  Scene scene = small_scene({});
  const auto shadow_rays = [&](const Light& light) {
    scene.lights = {light};
    return stats_of(scene).shadow_rays;
  };
  CHECK(shadow_rays(ParallelLight{}) > 0);
  CHECK(shadow_rays(ParallelLight{}) < pixels);
  // From below the floor a light reaches nothing that is seen. Nor does black light, or a cone that
  // points away.
  CHECK(shadow_rays(ParallelLight{.from = {0, -1, 0}, .pointing = {0, 0, 0}}) <
        shadow_rays(ParallelLight{}));
  CHECK(shadow_rays(PointLight{.origin = {0, 5, 0}, .color = {0, 0, 0}}) == 0);
  CHECK(shadow_rays(SpotLight{.origin = {0, 5, 0}, .pointing = {0, 6, 0}}) == 0);
  // A surface that answers no light asks for none either.
  scene = small_scene(inert());
  CHECK(shadow_rays(PointLight{.origin = {0, 5, 0}, .ambient = 1}) == 0);
}

TEST_CASE("each light costs at most one shadow ray a hit") {
  Scene scene = small_scene({});
  scene.lights = {PointLight{.origin = {0, 5, 0}}};
  const std::uint64_t one = stats_of(scene).shadow_rays;
  scene.lights.push_back(scene.lights[0]);
  CHECK(stats_of(scene).shadow_rays == 2 * one);
  CHECK(one <= pixels);
}

TEST_CASE("mirrors cost reflection rays, glass refraction rays and media") {
  const RenderStats mirror = stats_of(small_scene(inert(0.5)));
  CHECK(mirror.reflection_rays > 0);
  CHECK(mirror.refraction_rays == 0);
  CHECK(mirror.media_lookups == 0);
  CHECK(mirror.media_changes == 0);

  const RenderStats window = stats_of(small_scene(glass(1.5)));
  CHECK(window.refraction_rays > 0);
  CHECK(window.media_changes == window.refraction_rays);
}

TEST_CASE(
    "what surrounds the camera is looked up once a picture, or for each ray where their starts "
    "differ") {
  Scene scene = small_scene(glass(1.5));
  CHECK(stats_of(scene).media_lookups == 1);
  scene.camera.projection = Projection::spherical;
  CHECK(stats_of(scene).media_lookups == 1);
  scene.camera.projection = Projection::orthographic;
  CHECK(stats_of(scene).media_lookups == pixels);
  scene.camera.projection = Projection::pinhole;
  scene.camera.aperture = 10;
  CHECK(stats_of(scene).media_lookups == 1);
  scene.settings.dof_samples = 4;
  CHECK(stats_of(scene).media_lookups == 1);
  scene.camera.aperture = 1e5;  // Now the lens reaches to solids.
  CHECK(stats_of(scene).media_lookups == 4 * pixels);
}

TEST_CASE("a lens is sampled only if it has a size and more than one sample") {
  Scene scene = small_scene({});
  scene.settings.dof_samples = 5;
  CHECK(stats_of(scene).lens_samples == 0);
  CHECK(stats_of(scene).camera_rays == pixels);
  scene.camera.aperture = 10;
  scene.settings.supersampling = 2;
  CHECK(stats_of(scene).lens_samples == 20 * pixels);
  CHECK(stats_of(scene).camera_rays == 20 * pixels);
  scene.settings.dof_samples = 1;
  CHECK(stats_of(scene).lens_samples == 0);
  CHECK(stats_of(scene).camera_rays == 4 * pixels);
}

TEST_CASE("patterns are looked up once a hit, bumps by the neighbours that a slope needs") {
  Scene scene = small_scene({.color = Pattern(Checker{})});
  scene.entities = {scene.entities[1], Sphere{.center = {0, 0, 50}, .radius = 45}};
  const std::uint64_t lookups = stats_of(scene).pattern_lookups;
  CHECK(lookups > 0);
  CHECK(lookups < pixels);
  scene.entities[0] =
      Sphere{.center = {0, 1, 0}, .radius = 0.8, .material = Material{.bump = Noise{}}};
  CHECK(stats_of(scene).pattern_lookups == 6 * lookups);
}

TEST_CASE("csg objects alone have interval events") {
  Scene scene = small_scene({});
  CHECK(stats_of(scene).interval_events == 0);
  scene.entities = {Entity(Box{}) - Entity(Sphere{.radius = 0.5})};
  CHECK(stats_of(scene).interval_events > 0);
}
