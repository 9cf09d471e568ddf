// These tests check the affine maps of the C interface.
#include <numbers>

#include "support.hpp"

using namespace crt::test;

namespace {

using Affine = std::array<double, 12>;

constexpr double quarter_turn = std::numbers::pi / 2;

Affine rotation(const Numbers& axis, double angle) {
  Affine map{};
  REQUIRE(crt_affine_rotation(axis.data(), angle, map.data()) == CRT_OK);
  return map;
}

Numbers image_of(const Affine& m, const Numbers& p) {
  Numbers result{};
  for (std::size_t row = 0; row < 3; ++row) {
    const double* const r = m.data() + 4 * row;
    result[row] = r[0] * p[0] + r[1] * p[1] + r[2] * p[2] + r[3];
  }
  return result;
}

SceneHandle from_script(const std::string& text) {
  return made<SceneHandle>([&](crt_scene** out) {
    return crt_scene_from_script(text.data(), text.size(), "test", nullptr, nullptr, out);
  });
}

/// Makes a scene of a plane that is moved by a map.
SceneHandle scene_of_plane(const Affine& map) {
  const Numbers normal = {1, 2, 3};
  const Numbers position = {0.3, 0.2, 0.1};
  const EntityHandle plane = made<EntityHandle>(
      [&](crt_entity** out) { return crt_plane_create(normal.data(), position.data(), out); });
  const EntityHandle moved = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_transform(plane.get(), map.data(), out); });
  SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), moved.get()) == CRT_OK);
  return scene;
}

/// Returns where a ray through all of space meets what is there.
double distance_to(crt_scene* scene) {
  const double infinity = std::numeric_limits<double>::infinity();
  const crt_ray ray = {{0.1, 0.2, -0.3}, {0.3, -0.5, 0.8}, -infinity, infinity};
  crt_hit hit{};
  const PreparedHandle prepared = prepare(scene);
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  REQUIRE(std::isfinite(hit.t));
  return hit.t;
}

const Affine not_written = {7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7};

}  // namespace

TEST_CASE("identity, translation and scaling are what they say") {
  Affine map{};
  const Numbers p = {2, 3, 4};
  crt_affine_identity(map.data());
  CHECK(image_of(map, p) == p);
  crt_affine_translation(Numbers{1, 10, 100}.data(), map.data());
  CHECK(image_of(map, p) == Numbers{3, 13, 104});
  crt_affine_scaling(Numbers{1, 10, -100}.data(), map.data());
  CHECK(image_of(map, p) == Numbers{2, 30, -400});
}

TEST_CASE("a quarter turn takes x to y, y to z and z to x, exactly") {
  CHECK(image_of(rotation({0, 0, 5}, quarter_turn), {1, 0, 0}) == Numbers{0, 1, 0});
  CHECK(image_of(rotation({1e-200, 0, 0}, quarter_turn), {0, 1, 0}) == Numbers{0, 0, 1});
  CHECK(image_of(rotation({0, 1e300, 0}, quarter_turn), {0, 0, 1}) == Numbers{1, 0, 0});
  CHECK(image_of(rotation({0, 0, 1}, 2 * quarter_turn), {1, 2, 3}) == Numbers{-1, -2, 3});
  CHECK(image_of(rotation({0, 0, 1}, 0), {1, 2, 3}) == Numbers{1, 2, 3});
}

TEST_CASE("rotations about the axes are those of scripts") {
  const std::string plane =
      "Plane { normal -> vec3(1, 2, 3) position -> vec3(0.3, 0.2, 0.1) } <rotate vec3(";
  const char* const places[] = {"{}, 0, 0", "0, {}, 0", "0, 0, {}"};
  for (const double degrees : {-200.0, -33.0, 45.0, 90.0, 123.0, 720.0}) {
    CAPTURE(degrees);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::string angles = places[axis];
      angles.replace(angles.find("{}"), 2, std::to_string(degrees));
      const double wanted = distance_to(from_script("Scene { " + plane + angles + ")> }").get());
      Numbers unit = {0, 0, 0};
      unit[axis] = 1;
      const Affine map = rotation(unit, degrees * std::numbers::pi / 180);
      CHECK(distance_to(scene_of_plane(map).get()) == doctest::Approx(wanted).epsilon(1e-12));
    }
  }
}

TEST_CASE("about any axis, what is on it stays, and lengths stay") {
  const Numbers axis = {1, -2, 0.5};
  const Numbers there = image_of(rotation(axis, 1.1), axis);
  for (std::size_t i = 0; i < 3; ++i) CHECK(there[i] == doctest::Approx(axis[i]));
  const Numbers turned = image_of(rotation(axis, 1.1), {3, 4, 12});
  CHECK(std::hypot(turned[0], turned[1], turned[2]) == doctest::Approx(13));
}

TEST_CASE("a product does the first map, then the other, also in the place of either") {
  Affine move{};
  crt_affine_translation(Numbers{1, 0, 0}.data(), move.data());
  const Affine turn = rotation({0, 0, 1}, quarter_turn);
  Affine both{};
  crt_affine_product(move.data(), turn.data(), both.data());
  CHECK(image_of(both, {1, 0, 0}) == Numbers{0, 2, 0});
  crt_affine_product(turn.data(), move.data(), both.data());
  CHECK(image_of(both, {1, 0, 0}) == Numbers{1, 1, 0});
  Affine in_place = turn;
  crt_affine_product(in_place.data(), move.data(), in_place.data());
  CHECK(in_place == both);
  in_place = move;
  crt_affine_product(turn.data(), in_place.data(), in_place.data());
  CHECK(in_place == both);
}

TEST_CASE("maps of the C interface move entities as the maps of scripts do") {
  const EntityHandle ball = sphere({2, 0, 0}, 0.5);
  Affine map = rotation({0, 1, 0}, -quarter_turn);
  Affine lift{};
  crt_affine_translation(Numbers{0, 1, 0}.data(), lift.data());
  crt_affine_product(map.data(), lift.data(), map.data());
  const EntityHandle moved = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_transform(ball.get(), map.data(), out); });
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), moved.get()) == CRT_OK);
  const PreparedHandle prepared = prepare(scene.get());
  const crt_ray ray = {{0, 1, -5}, {0, 0, 1}, 0, std::numeric_limits<double>::infinity()};
  crt_hit hit{};
  REQUIRE(crt_intersect(prepared.get(), &ray, 0, 1, &hit, 0) == CRT_OK);
  CHECK(hit.t == doctest::Approx(6.5));
}

TEST_CASE("what is no axis or angle is refused, and nothing is written") {
  const double inf = std::numeric_limits<double>::infinity();
  const Numbers up = {0, 1, 0};
  Affine map = not_written;
  CHECK(crt_affine_rotation(nullptr, 1, map.data()) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_affine_rotation(Numbers{0, 0, 0}.data(), 1, map.data()) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_affine_rotation(Numbers{0, inf, 0}.data(), 1, map.data()) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_affine_rotation(up.data(), inf, map.data()) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(crt_affine_rotation(up.data(), 1, nullptr) == CRT_ERROR_INVALID_ARGUMENT);
  crt_affine_identity(nullptr);
  crt_affine_translation(nullptr, map.data());
  crt_affine_translation(up.data(), nullptr);
  crt_affine_scaling(nullptr, map.data());
  crt_affine_scaling(up.data(), nullptr);
  crt_affine_product(nullptr, not_written.data(), map.data());
  crt_affine_product(not_written.data(), nullptr, map.data());
  crt_affine_product(not_written.data(), not_written.data(), nullptr);
  CHECK(map == not_written);
}
