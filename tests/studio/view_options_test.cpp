// These tests hide statements, and compare what is left with a search among all of them.
#include "studio/view_options.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <crt/entity.hpp>
#include <crt/primitives.hpp>
#include <random>
#include <vector>

using namespace crt;
using namespace crt::studio;

namespace {

bool is_hidden(const EntityPlace& place, const std::vector<TextSpan>& hidden) {
  const auto encloses = [](const TextSpan& outer, const TextSpan& inner) {
    return outer.begin <= inner.begin && inner.end <= outer.end;
  };
  return std::any_of(hidden.begin(), hidden.end(), [&](const TextSpan& span) {
    return encloses(span, place.statement) || encloses(span, place.origin);
  });
}

/// Makes a span of a short text, whose end may come before its begin.
TextSpan random_span(std::mt19937& random) {
  const auto place = [&] { return static_cast<std::uint32_t>(random() % 40); };
  return {place(), place()};
}

/// Makes a ball whose place is a number.
Entity ball(std::uint32_t number) {
  return Sphere{.center = {static_cast<double>(number), 0, 0}, .radius = 0.25};
}

}  // namespace

TEST_CASE("what comes from a statement that one of many spans encloses is hidden, and no more") {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Scene scene;
    std::vector<EntityPlace> places;
    std::vector<std::uint32_t> left;
    ViewOptions options;
    for (auto count = random() % 6; count > 0; --count)
      options.hidden.push_back(random_span(random));
    for (std::uint32_t number = 0; number < 40; ++number) {
      scene.entities.push_back(ball(number));
      places.push_back({random_span(random), random_span(random)});
      if (!is_hidden(places.back(), options.hidden)) left.push_back(number);
    }
    // An entity without a place is never hidden.
    scene.entities.push_back(ball(40));
    left.push_back(40);
    const Scene shown = visible_scene(scene, places, options, {});
    std::vector<std::uint32_t> numbers;
    for (const BoundingBox& box : boxes_of(shown))
      numbers.push_back(static_cast<std::uint32_t>((box.lower.x + box.upper.x) / 2));
    CHECK(numbers == left);
  }
}

TEST_CASE("noise is smoothed away by how a picture is displayed, and by no other option") {
  const ViewOptions plain;
  ViewOptions smooth;
  smooth.display.denoise = true;
  CHECK(differ_in_display_alone(plain, smooth));
  CHECK_FALSE(differ_in_display_alone(smooth, smooth));
  CHECK(show_same_entities(plain, smooth));
  smooth.t = 1;
  CHECK_FALSE(differ_in_display_alone(plain, smooth));
}

TEST_CASE("a section cuts what light or the camera pass, which they then pass still") {
  Scene scene;
  const Entity ball = Sphere{};
  scene.entities = {ball, ball.with_shadow(false), ball.with_visible(false).with_shadow(false)};
  ViewOptions options;
  options.section = SectionPlane{.axis = 0, .offset = 0.5, .is_flipped = false};
  const std::vector<BoundingBox> boxes = boxes_of(scene);
  const Scene shown =
      visible_scene(scene, {}, options, [&]() -> const std::vector<BoundingBox>& { return boxes; });
  REQUIRE(shown.entities.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(shown.entities[i].casts_shadow() == scene.entities[i].casts_shadow());
    CHECK(shown.entities[i].is_visible() == scene.entities[i].is_visible());
    CHECK(shown.entities[i].primitive_count() == 2);
  }
}
