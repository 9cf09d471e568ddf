// Faces that coincide render without a speckle, from all sides, as if the winner stood out by a
// hair.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "extremes/support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double hair = 1e-6;

/// A Pair writes twice what must look alike: with faces that coincide, and with a hair between
/// them.
struct Pair {
  std::string name;
  std::vector<Entity> coincident;
  std::vector<Entity> separate;
};

Material paint(double r, double g, double b) {
  return {.color = Color{r, g, b}};
}

const Material red = paint(0.9, 0.1, 0.1);
const Material green = paint(0.1, 0.8, 0.1);

Entity box(const Vec3& a, const Vec3& b, const Material& material) {
  return Box{.corner_a = a, .corner_b = b, .material = material};
}

Entity ball(double radius, const Material& material) {
  return Sphere{.radius = radius, .material = material};
}

Entity behind(const Vec3& normal, double distance, const Material& material) {
  return Plane{.normal = normal, .position = distance * normal, .material = material};
}

Entity disc(double height, const Material& material) {
  return Disc{.center = {0.1, height, 0}, .radius = 0.5, .material = material};
}

Entity pillar(double low, double high, double radius, const Material& material) {
  return Cylinder{.from = {0, low, 0}, .to = {0, high, 0}, .radius = radius, .material = material};
}

Entity funnel(double low, double high, double wider, const Material& material) {
  return Cone{.from = {0, low, 0},
              .to = {0, high, 0},
              .radius = 1 - 0.5 * low + wider,
              .radius2 = 1 - 0.5 * high + wider,
              .material = material};
}

Entity ring(double thickness, const Material& material) {
  return Torus{.radius = 0.7, .thickness = thickness, .material = material};
}

std::vector<Pair> standing_pairs() {
  const Entity ground = behind({0, 1, 0}, 0, green);
  const auto block = [](double low) { return box({-0.5, low, -0.5}, {0.6, 1, 0.4}, red); };
  return {{"a box on a plane", {ground, block(0)}, {ground, block(hair)}},
          {"a plane under a box", {block(0), ground}, {block(-hair), ground}},
          {"a box and a plane in one", {block(0) + ground}, {block(-hair) + ground}},
          {"a cylinder on a plane",
           {ground, pillar(0, 1, 0.6, red)},
           {ground, pillar(hair, 1, 0.6, red)}},
          {"a disc on a box", {block(0), disc(1, green)}, {block(0), disc(1 - hair, green)}},
          {"a box under a disc", {disc(1, green), block(0)}, {disc(1 + hair, green), block(0)}},
          {"two discs", {disc(0, red), disc(0, green)}, {}}};
}

std::vector<Pair> cut_pairs() {
  const Entity block = box({-1, -1, -1}, {1, 1, 1}, red);
  const auto cutter = [](double over) {
    return box({0, -1 - over, -1 - over}, {1 + over, 1 + over, 1 + over}, green);
  };
  const Vec3 slanted(0.6, 0, 0.8);
  const Entity front = ball(1, red) ^ behind(slanted, 0.1, red);
  const Entity back = ball(1, green) - behind(slanted, 0.1, green);
  const Entity front_apart = ball(1, red) ^ behind(slanted, 0.1 + hair, red);
  return {{"a cutter flush with five faces", {block - cutter(0)}, {block - cutter(hair)}},
          {"a flush cutter and what it cut",
           {block - cutter(0), block ^ cutter(0)},
           {block - cutter(hair), block ^ cutter(hair)}},
          {"two halves of a ball", {front, back}, {front_apart, back}},
          {"two halves of a ball in one", {front + back}, {front_apart + back}}};
}

std::vector<Pair> flush_pairs() {
  const auto left = [](double out) {
    return box({-1 - out, -1 - out, -1 - out}, {0.3 + out, 1 + out, 1 + out}, red);
  };
  const Entity right = box({-0.3, -1, -0.5}, {1, 1, 1}, green);
  const Entity next = box({0.3, -1, -1}, {1, 1, 1}, green);
  const auto west = [](double radius) { return ball(radius, red) ^ behind({1, 0, 0}, 0.3, red); };
  const Entity east = ball(1, green) - behind({1, 0, 0}, -0.3, green);
  return {{"boxes with flush sides", {left(0), right}, {left(hair), right}},
          {"boxes with flush sides in one", {left(0) + right}, {left(hair) + right}},
          {"boxes with a common face", {left(0), next}, {left(hair), next}},
          {"boxes with a common face in one", {left(0) + next}, {left(hair) + next}},
          {"two pieces of one ball", {west(1), east}, {west(1 + hair), east}},
          {"two pieces of one ball in one", {west(1) + east}, {west(1 + hair) + east}},
          {"two cylinders in line",
           {pillar(-1, 0.3, 0.7, red), pillar(-0.3, 1, 0.7, green)},
           {pillar(-1, 0.3, 0.7 + hair, red), pillar(-0.3, 1, 0.7, green)}},
          {"two cylinders in one",
           {pillar(-1, 0.3, 0.7, red) + pillar(-0.3, 1, 0.7, green)},
           {pillar(-1, 0.3, 0.7 + hair, red) + pillar(-0.3, 1, 0.7, green)}},
          {"two pieces of a cone",
           {funnel(-0.5, 0.5, 0, red), funnel(0, 1, 0, green)},
           {funnel(-0.5, 0.5, hair, red), funnel(0, 1, 0, green)}},
          {"two rings",
           {ring(0.25, red) ^ behind({1, 0, 0}, 0.3, red), ring(0.25, green)},
           {ring(0.25 + hair, red) ^ behind({1, 0, 0}, 0.3, red), ring(0.25, green)}}};
}

/// Returns the picture of a camera from one of several places. `side` numbers them, the first 6
/// along an axis.
Image taken(std::vector<Entity> entities, const Transform& placed, int side, Precision precision) {
  Scene scene = dark_scene();
  scene.background = SolidBackground{{0.1, 0.1, 0.3}};
  scene.settings.width = 40;
  scene.settings.height = 40;
  scene.settings.precision = precision;
  for (Entity& entity : entities) entity = entity.transformed(placed);
  scene.entities = std::move(entities);
  const auto place = [&](const Vec3& p) { return apply(placed, p); };
  scene.lights = {PointLight{.origin = place({3, 5, -4}), .color = grey(0.7), .ambient = 0.3},
                  PointLight{.origin = place({-4, 2, 1}), .color = grey(0.4)},
                  PointLight{.origin = place({1, 3, 6}), .color = grey(0.4)}};
  Random random(static_cast<unsigned>(side));
  Vec3 from = random.direction();
  if (side < 6) {
    from = Vec3(0);
    from[side % 3] = side < 3 ? 1 : -1;
  }
  scene.camera = {
      .position = place(4.0 * from + Vec3(0, 0.2, 0)), .pointing = place({0, 0.2, 0}), .fov = 0.8};
  return render(prepare(scene), {.threads = 1});
}

std::vector<Transform> placements() {
  Transform far = rotate_degrees({33, 5, 67});
  far.translation = {30, -70, 20};
  return {Transform{}, rotate_degrees({17, 71, 41}), far};
}

void check_pairs(const std::vector<Pair>& pairs) {
  for (const Pair& pair : pairs) {
    const std::vector<Entity>& separate =
        pair.separate.empty() ? std::vector<Entity>{pair.coincident.front()} : pair.separate;
    for (const Transform& placed : placements()) {
      for (int side = 0; side < 14; ++side) {
        const Image reference = taken(separate, placed, side, Precision::standard);
        for (const Precision precision : {Precision::standard, Precision::exact}) {
          CAPTURE(pair.name);
          CAPTURE(side);
          CAPTURE(placed.translation.x);
          CAPTURE(placed.row_x.y);
          CHECK(speckles(taken(pair.coincident, placed, side, precision), reference) == 0);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("what stands or lies on something has no speckles") {
  check_pairs(standing_pairs());
}

TEST_CASE("flush cuts have no speckles") {
  check_pairs(cut_pairs());
}

TEST_CASE("flush sides have no speckles") {
  check_pairs(flush_pairs());
}

TEST_CASE("a solid less itself is nothing, with or from itself it is itself") {
  const std::vector<Entity> solids = {box({-1, -0.5, -0.7}, {0.8, 1, 1}, red),
                                      ball(1, red),
                                      pillar(-1, 1, 0.7, red),
                                      funnel(-1, 1, 0, red),
                                      ring(0.25, red),
                                      ball(1, red) - box({0, 0, 0}, {2, 2, 2}, green)};
  for (const Entity& solid : solids) {
    for (const Transform& placed : placements()) {
      for (int side = 0; side < 8; ++side) {
        for (const Precision precision : {Precision::standard, Precision::exact}) {
          const Image alone = taken({solid}, placed, side, precision);
          CHECK(same_pixels(taken({solid - solid}, placed, side, precision),
                            taken({}, placed, side, precision)));
          CHECK(same_pixels(taken({solid + solid}, placed, side, precision), alone));
          CHECK(same_pixels(taken({solid ^ solid}, placed, side, precision), alone));
          const Entity other = Entity(solid - solid) + solid;
          CHECK(same_pixels(taken({other}, placed, side, precision), alone));
        }
      }
    }
  }
}

TEST_CASE("of a solid that is there twice the first is seen") {
  const auto wearing = [](const Material& material) {
    return std::vector<Entity>{box({-1, -0.5, -0.7}, {0.8, 1, 1}, material),
                               ball(1, material),
                               pillar(-1, 1, 0.7, material),
                               funnel(-1, 1, 0, material),
                               ring(0.25, material),
                               ball(1, material) - box({0, 0, 0}, {2, 2, 2}, material)};
  };
  const std::vector<Entity> first = wearing(red);
  const std::vector<Entity> second = wearing(green);
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (const Transform& placed : placements()) {
      for (int side = 0; side < 8; ++side) {
        for (const Precision precision : {Precision::standard, Precision::exact}) {
          CHECK(same_pixels(taken({first[i], second[i]}, placed, side, precision),
                            taken({first[i]}, placed, side, precision)));
        }
      }
    }
  }
}
