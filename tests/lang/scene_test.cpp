// These tests check what arrives in the Scene: values, units and defaults.
#include <doctest/doctest.h>

#include <numbers>

#include "lang/objects.hpp"
#include "lang/settings.hpp"
#include "run.hpp"

namespace {

constexpr double degree = std::numbers::pi / 180;

crt::Scene scene_of(const std::string& text) {
  crt::test::Run result = crt::test::run(text);
  for (const crt::Diagnostic& diagnostic : result.result.diagnostics)
    MESSAGE(crt::format_diagnostic(diagnostic));
  REQUIRE(result.ok());
  return std::move(*result.result.scene);
}

}  // namespace

TEST_CASE("without Settings a scene is that of the C++ API") {
  const crt::Scene scene = scene_of("Scene { }");
  const crt::Scene plain;
  CHECK(scene.entities.empty());
  CHECK(scene.lights.empty());
  CHECK(scene.settings.width == plain.settings.width);
  CHECK(scene.settings.min_weight == plain.settings.min_weight);
  CHECK(scene.camera.fov == plain.camera.fov);
  CHECK(std::holds_alternative<crt::SolidBackground>(scene.background));
}

TEST_CASE("all settings arrive") {
  const crt::Scene scene = scene_of(R"(Settings {
    title -> "T" author -> "A" date -> "D" notes -> "N" width -> 12 height -> 34 gamma -> 2.5
    supersampling -> 3 dofsamples -> 4 recursiondepth -> 5 minweight -> 0.25 falloffmodel -> "light"
    ambientmodel -> "surface" headlight -> false exposure -> -1.5 tonemap -> "filmic"
    lightsamples -> 9 indirect -> 6 cutoff -> "black"
    targeterror -> 0.25 timebudget -> 1.5 minsamples -> 32 maxsamples -> 64
    filter -> "blackmanharris" filterwidth -> 2.5 showclip -> true seed -> 77
    precision -> "exact" projection -> "cylindrical" unit -> "mm" frames -> 48
  } Scene { })");
  const crt::Settings& settings = scene.settings;
  CHECK(settings.title == "T");
  CHECK(settings.author == "A");
  CHECK(settings.date == "D");
  CHECK(settings.notes == "N");
  CHECK(settings.width == 12);
  CHECK(settings.height == 34);
  CHECK(settings.gamma == 2.5);
  CHECK(settings.supersampling == 3);
  CHECK(settings.dof_samples == 4);
  CHECK(settings.recursion_depth == 5);
  CHECK(settings.min_weight == 0.25);
  CHECK(settings.falloff_model == crt::FalloffModel::light);
  CHECK(settings.ambient_model == crt::AmbientModel::surface);
  CHECK(!settings.head_light);
  CHECK(settings.exposure == -1.5);
  CHECK(settings.tone_map == crt::ToneMap::filmic);
  CHECK(settings.light_samples == 9);
  CHECK(settings.indirect == 6);
  CHECK(settings.cutoff == crt::Cutoff::black);
  CHECK(settings.target_error == 0.25);
  CHECK(settings.time_budget == 1.5);
  CHECK(settings.min_samples == 32);
  CHECK(settings.max_samples == 64);
  CHECK(settings.filter == crt::PixelFilter::blackman_harris);
  CHECK(settings.filter_width == 2.5);
  CHECK(settings.show_clip);
  CHECK(settings.seed == 77);
  CHECK(settings.precision == crt::Precision::exact);
  CHECK(settings.unit == crt::Unit::mm);
  CHECK(settings.frames == 48);
  CHECK(scene.camera.projection == crt::Projection::cylindrical);
}

TEST_CASE("a camera's angles are degrees in a script and radians in the scene") {
  const crt::Scene scene = scene_of(R"(Settings {
    projection -> "orthographic"
    camera -> Camera {
      position -> vec3(1, 2, 3) pointing -> vec3(4, 5, 6) fov -> 90 roll -> -45
      aperture -> 8 focaldistance -> 7 apertureshape -> "octagon"
    }
  } Scene { })");
  CHECK(scene.camera.position == crt::Vec3(1, 2, 3));
  CHECK(scene.camera.pointing == crt::Vec3(4, 5, 6));
  CHECK(scene.camera.fov == doctest::Approx(90 * degree));
  CHECK(scene.camera.roll == doctest::Approx(-45 * degree));
  CHECK(scene.camera.aperture == 8);
  CHECK(scene.camera.focal_distance == 7);
  CHECK(scene.camera.aperture_shape == crt::ApertureShape::octagon);
  CHECK(scene.camera.projection == crt::Projection::orthographic);
}

TEST_CASE("lights arrive in their order, with their own defaults") {
  const crt::Scene scene = scene_of(R"(Settings { lights -> [
    PointLight { origin -> vec3(1, 0, 0) color -> rgb(2, 3, 4) },
    ParallelLight { from -> vec3(0, 1, 0) pointing -> vec3(0, 0, 0) color -> rgb(1, 1, 1)
      ambient -> 0.5 },
    SpotLight { origin -> vec3(0, 1, 0) pointing -> vec3(0, 0, 0) color -> rgb(1, 1, 1)
      angle -> 30 penumbra -> 10 falloff -> 2 },
    SpotLight { origin -> vec3(0, 1, 0) pointing -> vec3(0, 0, 0) color -> rgb(1, 1, 1) },
    CylinderLight { origin -> vec3(0, 1, 0) pointing -> vec3(0, 0, 0) color -> rgb(1, 1, 1)
      radius -> 3 }
  ] } Scene { })");
  REQUIRE(scene.lights.size() == 5);
  const auto& point = std::get<crt::PointLight>(scene.lights[0]);
  CHECK(point.origin == crt::Vec3(1, 0, 0));
  CHECK(point.color == crt::Color{2, 3, 4, 1});
  CHECK(point.falloff == 0);
  CHECK(point.ambient == 0);
  CHECK(std::get<crt::ParallelLight>(scene.lights[1]).ambient == 0.5);
  const auto& spot = std::get<crt::SpotLight>(scene.lights[2]);
  CHECK(spot.angle == doctest::Approx(30 * degree));
  CHECK(spot.penumbra == doctest::Approx(10 * degree));
  CHECK(spot.falloff == 2);
  const auto& plain = std::get<crt::SpotLight>(scene.lights[3]);
  CHECK(plain.angle == doctest::Approx(60 * degree));
  CHECK(plain.penumbra == doctest::Approx(5 * degree));
  CHECK(std::get<crt::CylinderLight>(scene.lights[4]).radius == 3);
}

TEST_CASE("a background is of the kind that its attributes say") {
  const auto background = [](const std::string& attributes) {
    return scene_of("Settings { background -> Background { " + attributes + " } } Scene { }")
        .background;
  };
  CHECK(std::get<crt::SolidBackground>(background("")).color == crt::Color{1, 1, 1, 1});
  CHECK(std::get<crt::SolidBackground>(background("color -> rgba(1, 0, 0, 0.5)")).color ==
        crt::Color{1, 0, 0, 0.5});
  const auto gradient =
      std::get<crt::GradientBackground>(background("horizon -> rgb(1, 0, 0) sky -> rgb(0, 0, 1)"));
  CHECK(gradient.horizon == crt::Color{1, 0, 0, 1});
  CHECK(gradient.sky == crt::Color{0, 0, 1, 1});
}

TEST_CASE("a group is one entity of all its parts") {
  const crt::Scene scene = scene_of(R"(
    row = Macro (n) { for (i in range(n)) { Sphere { center -> vec3(i, 0, 0) radius -> 1 } } }
    Scene {
      row(3)
      row(4) <scale 2>
      [row(2), row(1)]
    }
  )");
  REQUIRE(scene.entities.size() == 6);
  CHECK(scene.entities[0].primitive_count() == 1);
  CHECK(scene.entities[3].primitive_count() == 4);
  CHECK(scene.entities[4].primitive_count() == 2);
  CHECK(scene.entities[5].primitive_count() == 1);
}

TEST_CASE("surfaces and solids keep what they are") {
  const crt::Scene scene = scene_of(R"(Scene {
    Disc { center -> vec3(0, 0, 0) normal -> vec3(0, 1, 0) radius -> 1 }
    Sphere { center -> vec3(0, 0, 0) radius -> 1 }
    Disc { center -> vec3(0, 0, 0) normal -> vec3(0, 1, 0) radius -> 1 } +
      Sphere { center -> vec3(0, 0, 0) radius -> 1 }
  })");
  CHECK_FALSE(scene.entities[0].is_solid());
  CHECK(scene.entities[1].is_solid());
  CHECK_FALSE(scene.entities[2].is_solid());
}

TEST_CASE("names in the table of objects are unique, and required attributes have no default") {
  for (const crt::lang::ObjectType& type : crt::lang::object_types()) {
    CHECK(crt::lang::find_object_type(type.name) == &type);
    for (std::size_t i = 0; i < type.attributes.size(); ++i) {
      CHECK(crt::lang::find_attribute(type, type.attributes[i].name) == i);
      CHECK(type.attributes[i].required == type.attributes[i].default_text.empty());
      CHECK_FALSE(type.attributes[i].type.empty());
    }
  }
}

TEST_CASE("the default that the table states is the default") {
  const auto fov = [](const std::string& attribute) {
    return scene_of(
               "Settings { camera -> Camera { position -> vec3(0, 0, 0) pointing -> vec3(0, 0, "
               "1) " +
               attribute + " } } Scene { }")
        .camera;
  };
  CHECK(fov("").fov == fov("fov -> 60").fov);
  CHECK(fov("").focal_distance == fov("focaldistance -> 1").focal_distance);
  const crt::lang::ObjectType& settings = crt::lang::settings_type();
  for (const crt::lang::AttributeType& attribute : settings.attributes) {
    if (attribute.name == "camera") continue;
    CAPTURE(attribute.name);
    // Each stated default is an expression that the attribute takes.
    const std::string text = "Settings { " + std::string(attribute.name) + " -> " +
                             std::string(attribute.default_text) + " } Scene { }";
    CHECK(crt::test::run(text).ok());
  }
}

TEST_CASE("clamped light arrives, and of it no accuracy can be claimed") {
  CHECK(scene_of("Settings { clamp -> 12 }\nScene { }").settings.clamp == 12);
  CHECK(!crt::test::run("Settings { clamp -> 12 targeterror -> 0.1 }\nScene { }").ok());
}
