// Scenes that are cut open by their camera.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include "crt/error.hpp"
#include "crt/prepared_scene.hpp"
#include "crt/primitives.hpp"
#include "crt/query.hpp"
#include "crt/render.hpp"
#include "crt/section.hpp"

using namespace crt;

namespace {

/// Two balls across x, a third one beyond the plane, and a disc.
Scene three_balls() {
  Scene scene;
  scene.entities = {Sphere{.center = {0, 0, 0}, .radius = 1},
                    Entity(Sphere{.center = {0, 4, 0}, .radius = 1}).with_id(70),
                    Sphere{.center = {9, 0, 0}, .radius = 1},
                    Disc{.center = {5, 9, 0}, .normal = {1, 0, 0}, .radius = 1},
                    Sphere{.center = {-9, 0, 0}, .radius = 1}};
  return scene;
}

/// Returns what a ray along -x from x = 20 hits.
std::optional<Hit> hit_from_right(const Scene& scene, double y, double z) {
  return intersect(prepare(scene), {.origin = {20, y, z}, .direction = {-1, 0, 0}});
}

}  // namespace

TEST_CASE("a camera's section leaves what is against its normal, with ids as they were") {
  Scene scene = three_balls();
  scene.camera.section_normal = {2, 0, 0};
  scene.camera.section_offset = 0.25;
  const std::optional<Hit> first = hit_from_right(scene, 0.1, 0.2);
  REQUIRE(first);
  CHECK(first->t == doctest::Approx(19.75));
  CHECK(first->entity_id == 0);
  CHECK(first->normal.x == doctest::Approx(1));
  const std::optional<Hit> second = hit_from_right(scene, 4.1, 0.2);
  REQUIRE(second);
  CHECK(second->t == doctest::Approx(19.75));
  CHECK(second->entity_id == 70);
  // Surfaces are not cut, and without a section all is as it was.
  const std::optional<Hit> disc = hit_from_right(scene, 9.1, 0.1);
  REQUIRE(disc);
  CHECK(disc->entity_id == 3);
  scene.camera.section_normal = {0, 0, 0};
  const std::optional<Hit> whole = hit_from_right(scene, 0, 0);
  REQUIRE(whole);
  CHECK(whole->t == doctest::Approx(10));
  CHECK(whole->entity_id == 2);
}

TEST_CASE("what is beyond the plane is gone, and what is before it stays the same entity") {
  const Scene scene = three_balls();
  const Scene cut = sectioned(scene, {1, 0, 0}, 0.25);
  REQUIRE(cut.entities.size() == scene.entities.size());
  CHECK(cut.entities[2].is_empty());
  CHECK(cut.entities[3].shared_node() == scene.entities[3].shared_node());
  CHECK(cut.entities[4].shared_node() == scene.entities[4].shared_node());
  CHECK(cut.entities[0].shared_node() != scene.entities[0].shared_node());
  CHECK(!has_section(cut.camera));
  // From the other side the third ball is there alone.
  const Scene other = sectioned(scene, {-1, 0, 0}, -2);
  CHECK(other.entities[0].is_empty());
  CHECK(other.entities[2].shared_node() == scene.entities[2].shared_node());
}

TEST_CASE("solids that cast no shadow or are not seen are cut as others, and stay so") {
  Scene scene;
  scene.entities = {Entity(Sphere{}).with_shadow(false).with_id(3),
                    Entity(Sphere{.center = {0, 3, 0}}).with_visible(false)};
  const Scene cut = sectioned(scene, {1, 1, 0}, 0.1);
  CHECK(!cut.entities[0].casts_shadow());
  CHECK(cut.entities[0].is_visible());
  CHECK(cut.entities[1].is_empty());
  const Scene both = sectioned(scene, {1, 0, 0}, 0.1);
  CHECK(both.entities[1].casts_shadow());
  CHECK(!both.entities[1].is_visible());
}

TEST_CASE("cuts are hatched in the colour of the part, turned from one to the next") {
  Scene scene;
  scene.entities = {Box{.corner_a = {0, 0, 0},
                        .corner_b = {8, 8, 1},
                        .material = Material{.color = Color{1, 0, 0}}},
                    Box{.corner_a = {0, 0, 2},
                        .corner_b = {8, 8, 3},
                        .material = Material{.color = Color{0, 1, 0}}}};
  scene.camera.section_normal = {0, 1, 0};
  scene.camera.section_offset = 4;
  scene.camera.section_hatch = 0.5;
  scene.camera.position = {4, 20, 1.5};
  scene.camera.pointing = {4, 0, 1.5};
  scene.camera.projection = Projection::orthographic;
  scene.camera.fov = 0.05;
  scene.camera.focal_distance = 60;
  scene.settings.width = scene.settings.height = 120;
  const Image image = render(prepare(scene), {.aovs = {.albedo = true}});
  // Pixels are squares: a step along the diagonal is one of x and one of y.
  const auto is_line = [&](int x, int y, const char* channel) {
    return image.channel(channel)[static_cast<std::size_t>(y * 120 + x)] < 0.5;
  };
  bool is_held[2] = {};
  for (const bool is_first : {true, false}) {
    const char* const channel = is_first ? "albedo.R" : "albedo.G";
    int lines = 0;
    int of_part = 0;
    int held = 0;
    int turned = 0;
    for (int y = 1; y < 119; ++y) {
      for (int x = 1; x < 119; ++x) {
        const std::size_t pixel = static_cast<std::size_t>(y * 120 + x);
        const bool is_of_part = image.channel(channel)[pixel] >
                                10 * image.channel(is_first ? "albedo.G" : "albedo.R")[pixel];
        if (!is_of_part) continue;
        ++of_part;
        if (!is_line(x, y, channel)) continue;
        ++lines;
        if (is_line(x + 1, y + 1, channel)) ++held;
        if (is_line(x + 1, y - 1, channel)) ++turned;
      }
    }
    CAPTURE(channel);
    CHECK(of_part > 2000);
    CHECK(lines == doctest::Approx(0.25 * of_part).epsilon(0.15));
    const int along = std::max(held, turned);
    const int across = std::min(held, turned);
    CHECK(along > 0.9 * lines);
    CHECK(across < 0.8 * lines);
    is_held[is_first ? 0 : 1] = held > turned;
  }
  CHECK(is_held[0] != is_held[1]);
}

TEST_CASE("what is no plane or no distance is refused") {
  const Scene scene = three_balls();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(sectioned(scene, {0, 0, 0}, 0), Error);
  CHECK_THROWS_AS(sectioned(scene, {infinity, 0, 0}, 0), Error);
  CHECK_THROWS_AS(sectioned(scene, {1, 0, 0}, infinity), Error);
  CHECK_THROWS_AS(sectioned(scene, {1, 0, 0}, 0, -1), Error);
  Scene wrong = scene;
  wrong.camera.section_normal = {infinity, 0, 0};
  CHECK_THROWS_AS(prepare(wrong), Error);
}
