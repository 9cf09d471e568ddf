// These scripts are in the manner of 2015 (the folder scripts_2015). The tests check what each
// construct gives, by closed form. What they print and the messages about them are in their
// comments, which corpus_test.cpp checks.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>

#include "crt/prepared_scene.hpp"
#include "crt/render.hpp"
#include "crt/transform.hpp"
#include "lang/value.hpp"
#include "run.hpp"

namespace {

namespace fs = std::filesystem;
using crt::Color;
using crt::Image;
using crt::Scene;
using crt::ScriptOptions;
using crt::Settings;
using crt::Vec3;
using crt::test::run_statements;
using Strings = std::vector<std::string>;

constexpr double pi = std::numbers::pi;

Scene scene_of(const char* script, const ScriptOptions& options = {}) {
  const fs::path path = fs::path(CRT_SOURCE_DIR) / "tests" / "lang" / "scripts_2015" / script;
  crt::ScriptResult result = crt::run_script_file(path, options);
  CAPTURE(crt::diagnostics_to_json(result.diagnostics));
  REQUIRE(result.scene);
  return std::move(*result.scene);
}

Image picture_of(const Scene& scene, const crt::RenderOptions& options = {}) {
  return crt::render(crt::prepare(scene), options);
}

/// Returns the colour of a picture of one pixel.
Color pixel_of(const Scene& scene) {
  return picture_of(scene).at(0, 0);
}

void check_close(const Color& a, const Color& b, double tolerance = 1e-6) {
  CHECK(std::abs(a.r - b.r) <= tolerance);
  CHECK(std::abs(a.g - b.g) <= tolerance);
  CHECK(std::abs(a.b - b.b) <= tolerance);
}

// ---- the panorama of squares.png: eight columns and four rows, each square of a colour of its own

constexpr int columns = 8;
constexpr int rows = 4;

Color square(int column, int row) {
  return {column * 32 / 255.0, row * 64 / 255.0, (255 - column * 16) / 255.0, 1};
}

/// Returns a direction at an angle from straight ahead to the right, and at a height.
Vec3 direction(double yaw, double y) {
  const double level = std::sqrt(1 - y * y);
  return {std::sin(yaw) * level, y, std::cos(yaw) * level};
}

/// Returns the colour in a direction. All rays of an orthographic camera have the direction in
/// which it looks.
Color seen(Scene scene, const Vec3& towards) {
  scene.camera.pointing = scene.camera.position + towards;
  return pixel_of(scene);
}

/// Looks into the middle of each square: the middle column is straight ahead, turned by an angle to
/// the right.
void check_squares(const Scene& scene, double to_the_right) {
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      CAPTURE(row);
      CAPTURE(column);
      const double yaw = ((column + 0.5) / columns - 0.5) * 2 * pi + to_the_right;
      check_close(seen(scene, direction(yaw, 1 - 2 * (row + 0.5) / rows)), square(column, row));
    }
  }
  CHECK(seen(scene, {0, 1, 0}).g == doctest::Approx(square(0, 0).g));
  CHECK(seen(scene, {0, -1, 0}).g == doctest::Approx(square(0, rows - 1).g));
}

// ---- the lens

/// Returns how much of the lens sees the white background beside an edge at twice the distance in
/// focus. A point at p of the plane in focus is seen by the lens's point l along a line that passes
/// the edge's plane at 2 p - l.
double seen_beside_edge(double p, double half_width) {
  return 1 - std::clamp(0.5 + p / half_width, 0.0, 1.0);
}

Image row_of(const Scene& scene, int y) {
  return picture_of(scene, {.region = crt::Region{0, y, scene.settings.width, 1}});
}

}  // namespace

TEST_CASE("a panorama of 2015 is of equal area, and its angle turns it to the right") {
  check_squares(scene_of("panorama.crt"), pi / 2);
}

TEST_CASE("a script of today has the same panorama by its name and the opposite angle") {
  const Scene scene = scene_of("equal_area.crt");
  CHECK(scene.settings.compat == 0);
  check_squares(scene, pi / 2);
}

TEST_CASE("the mode turns equal-area and cylindrical panoramas the other way, too") {
  Scene scene = scene_of("panorama.crt");
  std::get<crt::PanoramaBackground>(scene.background).projection =
      crt::PanoramaProjection::equal_area;
  check_squares(scene, pi / 2);
  auto& panorama = std::get<crt::PanoramaBackground>(scene.background);
  panorama.projection = crt::PanoramaProjection::cylindrical;
  const Color before = seen(scene, direction(0.3, 0.1));
  panorama.angle = -panorama.angle;
  scene.settings.compat = 0;
  check_close(seen(scene, direction(0.3, 0.1)), before);
}

TEST_CASE("rand of 2015 is java.util.Random's nextDouble from the seed 1337") {
  // Its documentation says that next(bits) takes the upper bits of a linear congruential generator
  // modulo 2^48.
  std::uint64_t state = (1337 ^ 0x5DEECE66D) & 0xFFFFFFFFFFFF;
  const auto next = [&state](int bits) {
    state = (state * 0x5DEECE66D + 0xB) & 0xFFFFFFFFFFFF;
    return static_cast<std::int64_t>(state >> (48 - bits));
  };
  Strings expected;
  for (int i = 0; i < 100; ++i) {
    const std::int64_t high = next(26);
    const double number = static_cast<double>((high << 27) + next(27)) / 9007199254740992.0;
    expected.push_back(crt::lang::float_text(number));
  }
  const auto drawn =
      run_statements("Settings { compat -> 2015 }\nfor (i in range(100)) { print(rand()) }");
  CHECK(drawn.printed == expected);
  // These numbers came from `new java.util.Random(1337)`.
  CHECK(drawn.printed[0] == "0.6599297847448217");
  CHECK(drawn.printed[1] == "0.6892426740281012");
  CHECK(drawn.printed[99] == "0.3344566363092968");
}

TEST_CASE("a lens of 2015 blurs as many pixels at every size: half its width is aperture / width") {
  const Scene small = scene_of("lens.crt");
  Scene large = small;
  large.settings.width *= 2;
  large.settings.height *= 2;
  constexpr double tolerance = 0.04;  // five standard deviations of the mean of 4096 lens points
  for (const Scene* scene : std::array<const Scene*, 2>{&small, &large}) {
    const int width = scene->settings.width;
    const Image row = row_of(*scene, scene->settings.height / 2);
    const double half_width = 20.0 / width;
    int blurred = 0;
    for (int x = 0; x < width; ++x) {
      // The sample lies on the pixel's left side, and the plane in focus is 8 wide.
      const double p = 8.0 * x / width - 4;
      const double value = row.at(x, 0).r;
      CAPTURE(x);
      CHECK(std::abs(value - seen_beside_edge(p, half_width)) < tolerance);
      blurred += value > 0.02 && value < 0.98;
    }
    CHECK(blurred == 3);
  }
}

TEST_CASE("a lens of 2015 reaches aperture / height up and down") {
  ScriptOptions options;
  options.variables = {{"side", "vec3(0, 1, 0)"}};
  const Scene scene = scene_of("lens.crt", options);
  constexpr double tolerance = 0.04;
  for (int y = 0; y < scene.settings.height; ++y) {
    const double p = 2 - 4.0 * y / scene.settings.height;
    CAPTURE(y);
    CHECK(std::abs(row_of(scene, y).at(0, 0).r -
                   seen_beside_edge(p, 20.0 / scene.settings.height)) < tolerance);
  }
}

TEST_CASE("a script of 2015 has a lens by default, with and without a camera") {
  const Scene scene = scene_of("lens_by_default.crt");
  CHECK(scene.camera.aperture == 3);
  CHECK(scene.camera.focal_distance == 0.5);
  CHECK(scene.camera.aperture_shape == crt::ApertureShape::pentagon);
  const auto without_camera = run_statements("Settings { compat -> 2015 }");
  CHECK(without_camera.result.scene->camera.aperture == 3);
  CHECK(without_camera.result.scene->camera.focal_distance == 0.5);
  const auto of_today = run_statements("");
  CHECK(of_today.result.scene->camera.aperture == 0);
  CHECK(of_today.result.scene->camera.focal_distance == 1);
}

TEST_CASE("a script of 2015 that says how large the lens is in units has no other") {
  const auto radii = [](const char* lens) {
    const auto run = run_statements(
        std::string("Settings { compat -> 2015 camera -> Camera { position -> vec3(0, 0, -1) "
                    "pointing -> vec3(0, 0, 0) ") +
        lens + " } }");
    const crt::Camera& camera = run.result.scene->camera;
    return std::array{camera.aperture, camera.lens_radius};
  };
  CHECK(radii("") == std::array{3.0, 0.0});
  CHECK(radii("aperture -> 20") == std::array{20.0, 0.0});
  CHECK(radii("lensradius -> 0.5") == std::array{0.0, 0.5});
  CHECK(radii("lensradius -> 0") == std::array{0.0, 0.0});
}

TEST_CASE("a script of 2015 begins with the settings of that year, wherever the year is said") {
  const auto settings = [](const std::string& statements, const ScriptOptions& options = {}) {
    return run_statements(statements, options).result.scene->settings;
  };
  const auto check = [](const Settings& found, const Settings& expected) {
    CHECK(found.gamma == expected.gamma);
    CHECK(found.falloff_model == expected.falloff_model);
    CHECK(found.ambient_model == expected.ambient_model);
    CHECK(found.compat == expected.compat);
  };
  const Settings of_2015 = crt::settings_of_2015();
  CHECK(of_2015.gamma == 1);
  CHECK(of_2015.falloff_model == crt::FalloffModel::path);
  CHECK(of_2015.ambient_model == crt::AmbientModel::light);
  ScriptOptions in_options;
  in_options.compat = 2015;
  ScriptOptions in_settings;
  in_settings.settings = {{"compat", "2015"}};
  ScriptOptions turned_off;
  turned_off.settings = {{"compat", "0"}};
  check(settings("Settings { compat -> 2015 }"), of_2015);
  check(settings("", in_options), of_2015);
  check(settings("Settings { width -> 9 }", in_options), of_2015);
  check(settings("", in_settings), of_2015);
  check(settings(""), Settings{});
  check(settings("Settings { compat -> 2015 }", turned_off), Settings{});
  // What a script says itself holds.
  const Settings own = settings(
      "Settings { compat -> 2015 gamma -> 2.2 falloffmodel -> \"light\" ambientmodel -> "
      "\"surface\" }");
  CHECK(own.gamma == 2.2);
  CHECK(own.falloff_model == crt::FalloffModel::light);
  CHECK(own.ambient_model == crt::AmbientModel::surface);
}

TEST_CASE("light of 2015 fades over the way from the camera, and lights what is black") {
  // The camera is 3 from the wall, and the light 1.
  const char* script = R"(
    Settings { @ width -> 1 height -> 1
      camera -> Camera {
        position -> vec3(0, 0, 0) pointing -> vec3(0, 0, 1) fov -> 0.1 aperture -> 0
      }
      lights -> [PointLight {
        origin -> vec3(0, 0, 2) color -> rgb(1, 1, 1) falloff -> 0.5 ambient -> 0.25
      }]
    }
    wall = Plane { normal -> vec3(0, 0, -1) position -> vec3(0, 0, 3)
      material -> Material { color -> rgb(1, 0.5, 0) } }
    Scene { wall })";
  const auto wall = [&](const char* compat, ScriptOptions options = {}) {
    std::string text = script;
    text.replace(text.find('@'), 1, compat);
    const crt::test::Run run = crt::test::run(text, options);
    REQUIRE(run.result.scene);
    return picture_of(*run.result.scene);
  };
  const Image of_2015 = wall("compat -> 2015 supersampling -> 1");
  // A share of 0.5 / (3 + 1)^2 or 0.5 / 1^2 is diffuse.
  check_close(of_2015.at(0, 0), {0.25 + 0.5 / 16, 0.25 + 0.25 / 16, 0.25, 1}, 2e-3);
  check_close(wall("").at(0, 0), {0.25 + 0.5, 0.125 + 0.25, 0, 1}, 2e-3);
  // Its files store light as it is, cut to steps.
  CHECK(of_2015.to_rgba8()[2] == 63);
}

TEST_CASE("a colour above 1 sends back more light than comes") {
  check_close(pixel_of(scene_of("bright_colours.crt")),
              {0.5 * 162 / 102, 0.5 * 255 / 204, 0.25, 1});
}

TEST_CASE("what has no size draws nothing and cuts nothing; it grows with t") {
  const Scene at_start = scene_of("growing.crt");
  const auto is_there = [](const Scene& scene, std::size_t i) {
    return !scene.entities[i].is_empty();
  };
  REQUIRE(at_start.entities.size() == 9);
  CHECK(is_there(at_start, 0));
  CHECK(at_start.entities[0].primitive_count() == 1);
  for (std::size_t i = 1; i < 9; ++i) CHECK_FALSE(is_there(at_start, i));
  Scene rest = at_start;
  rest.settings.width = rest.settings.height = 9;
  const auto is_white = [](const Scene& scene) {
    const Image picture = picture_of(scene);
    return std::all_of(picture.pixels().begin(), picture.pixels().end(),
                       [](float value) { return value == 1; });
  };
  CHECK_FALSE(is_white(rest));
  rest.entities.erase(rest.entities.begin());
  CHECK(is_white(rest));

  ScriptOptions later;
  later.t = 1;
  const Scene grown = scene_of("growing.crt", later);
  for (std::size_t i = 0; i < 9; ++i) CHECK(is_there(grown, i));
  CHECK(grown.entities[0].primitive_count() == 2);
}

TEST_CASE("a cone of radius 0 that widens has its tip at from") {
  const auto scripts = {
      "Cone { from -> vec3(0, 0, 0) to -> vec3(0, 2, 0) radius -> 0 radius2 -> 1 }",
      "Cone { from -> vec3(0, 2, 0) to -> vec3(0, 0, 0) radius -> 1 }"};
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const char* script : scripts) {
    const auto run = crt::test::run(
        std::string("Settings { width -> 16 height -> 16 camera -> Camera { ") +
        "position -> vec3(0, 1, -4) pointing -> vec3(0, 1, 0) } }\nScene { " + script + " }");
    REQUIRE(run.ok());
    CHECK(run.result.diagnostics.empty());
    pictures.push_back(picture_of(*run.result.scene).to_rgba8());
  }
  CHECK(pictures[0] == pictures[1]);
}

TEST_CASE("a flat box is not seen and cuts nothing") {
  const Scene scene = scene_of("flat_boxes.crt");
  CHECK(scene.entities[0].primitive_count() == 1);
  CHECK(scene.entities[1].is_empty());
}

TEST_CASE("a light with a falloff of 0 or less never fades") {
  check_close(pixel_of(scene_of("lasting_light.crt")), {0.75, 0.75, 1, 1});
}

TEST_CASE("8-bit values of 2015 are cut to the step below") {
  Scene scene = scene_of("cut_values.crt");
  CHECK(picture_of(scene).to_rgba8() == std::vector<std::uint8_t>{254, 127, 255, 255});
  scene.settings.compat = 0;
  CHECK(picture_of(scene).to_rgba8() == std::vector<std::uint8_t>{255, 128, 255, 255});
}

TEST_CASE("the samples of a grid of 2015 lie at i / n - 1/2, across and down") {
  Scene scene = scene_of("grid.crt");
  const crt::Entity on_the_left = scene.entities[0];
  for (const Vec3& turn : {Vec3(0), Vec3(0, 0, -90)}) {
    scene.entities[0] = on_the_left.transformed(crt::rotate_degrees(turn));
    scene.settings.compat = 2015;
    CHECK(pixel_of(scene).r == 0.75);
    scene.settings.compat = 0;
    CHECK(pixel_of(scene).r == 1);
  }
}

TEST_CASE("without the mode what it allows is an error") {
  const auto fails = [](const char* script) { return !run_statements(script).ok(); };
  for (const char* script : {"print(rand(2, 1))", "in = 1", "if = 1", "for = 1", "while = 1",
                             "import = 1", "a = Material { caustics -> 1 }"}) {
    CAPTURE(script);
    CHECK(fails(script));
    CHECK(fails((std::string("Settings { compat -> 0 }\n") + script).c_str()));
    CHECK_FALSE(fails((std::string("Settings { compat -> 2015 }\n") + script).c_str()));
  }
}

TEST_CASE("the mode is asked for by the options, a setting from outside, or the script itself") {
  const char* script = "in = 1";
  ScriptOptions by_option;
  by_option.compat = 2015;
  const auto ran = run_statements(script, by_option);
  REQUIRE(ran.ok());
  CHECK(ran.result.scene->settings.compat == 2015);
  ScriptOptions by_setting;
  by_setting.settings = {{"compat", "0"}, {"compat", "2015"}};
  CHECK(run_statements(script, by_setting).result.scene->settings.compat == 2015);
  // These stand anywhere in the script, but in Settings only.
  for (const char* settings :
       {"Settings { compat -> 2015 }", "Settings{title->\"}\" -- compat -> 0 }\ncompat\n->2015}",
        "Settings { camera -> Camera { position -> vec3(0, 0, 0) pointing -> vec3(1, 0, 0) }"
        " compat -> 2015 }"}) {
    CHECK(run_statements(std::string(script) + "\n" + settings).ok());
  }
  for (const char* no_settings :
       {"", "-- Settings { compat -> 2015 }", "a = \"Settings { compat -> 2015 }\"",
        "compat = 2015", "Settings { } Scene { compat -> 2015 }"}) {
    CHECK_FALSE(run_statements(std::string(script) + "\n" + no_settings).ok());
  }
}

TEST_CASE("options win over the script, and can turn the mode off") {
  ScriptOptions off;
  off.settings = {{"compat", "0"}};
  const auto run = run_statements("Settings { compat -> 2015 }\nprint(rand())", off);
  CHECK(run.result.scene->settings.compat == 0);
  CHECK(run.printed[0] == run_statements("print(rand())").printed[0]);
  ScriptOptions on;
  on.compat = 2015;
  CHECK(run_statements("Settings { compat -> 0 }\nin = 1", on).result.scene->settings.compat ==
        2015);
}

TEST_CASE("a year that there is not is refused, wherever it comes from") {
  CHECK(run_statements("Settings { compat -> 2014 }").failed_with(crt::ErrorCode::script));
  CHECK(run_statements("Settings { compat -> 2015 - 2015 }").failed_with(crt::ErrorCode::script));
  ScriptOptions option;
  option.compat = 2014;
  CHECK(run_statements("", option).failed_with(crt::ErrorCode::invalid_argument));
  ScriptOptions setting;
  setting.settings = {{"compat", "2014"}};
  CHECK_FALSE(run_statements("", setting).ok());
  setting.settings = {{"compat", "2000 + 15"}};
  CHECK_FALSE(run_statements("", setting).ok());
}

TEST_CASE("an imported script is read as the script that imports it") {
  ScriptOptions options;
  options.open_file = [](const fs::path&) {
    const std::string text = "Settings { compat -> 0 }\nin = 7\nimport = in + 1\n";
    const auto* begin = reinterpret_cast<const std::byte*>(text.data());
    return std::vector<std::byte>(begin, begin + text.size());
  };
  const char* script = "import \"names.crt\"\nprint(in, import)";
  CHECK(run_statements(std::string("Settings { compat -> 2015 }\n") + script, options).printed ==
        Strings{"7 8"});
  CHECK_FALSE(run_statements(script, options).ok());
}
