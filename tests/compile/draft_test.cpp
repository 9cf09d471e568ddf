#include <doctest/doctest.h>

#include <crt/draft.hpp>
#include <crt/error.hpp>

namespace {

using namespace crt;

Scene detailed_scene() {
  Scene scene;
  scene.entities = {Sphere{.center = {0, 0, 2}, .radius = 0.5}};
  scene.camera.aperture = 0.1;
  scene.camera.fov = 0.5;
  scene.settings = {.width = 65,
                    .height = 7,
                    .supersampling = 4,
                    .dof_samples = 8,
                    .target_error = 0.01,
                    .time_budget = 5,
                    .recursion_depth = 7};
  return scene;
}

}  // namespace

TEST_CASE("a draft has a pixel for step by step of the picture, and at least one") {
  const Settings settings = draft_of(detailed_scene(), 8).settings;
  CHECK(settings.width == 8);
  CHECK(settings.height == 1);
}

TEST_CASE("a draft has one ray a pixel and no lens, and all else is as in the scene") {
  const Scene draft = draft_of(detailed_scene(), 1);
  CHECK(draft.settings.width == 65);
  CHECK(draft.settings.height == 7);
  CHECK(draft.settings.supersampling == 1);
  CHECK(draft.settings.dof_samples == 1);
  CHECK(draft.settings.target_error == 0);
  CHECK(draft.settings.time_budget == 0);
  CHECK(draft.camera.aperture == 0);
  Scene in_units = detailed_scene();
  in_units.camera = {.lens_radius = 0.1};
  CHECK_FALSE(has_lens(draft_of(in_units, 1).camera));
  CHECK(draft.camera.fov == 0.5);
  CHECK(draft.settings.recursion_depth == 7);
  CHECK(draft.entities.size() == 1);
}

TEST_CASE("a draft with a step below 1 is an error") {
  for (const int step : {0, -1})
    CHECK_THROWS_WITH_AS(draft_of(Scene{}, step), "the step of a draft must be at least 1", Error);
}
