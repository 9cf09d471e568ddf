// What is at one place along a ray: gaps of a few roundings are none, and films of a hundred are
// seen.
#include "csg/places.hpp"

using namespace crt;
using namespace crt::test::places_of;

TEST_CASE("boxes in a row are one block, as they are and turned") {
  constexpr int count = 12;
  const std::vector<Entity> boxes = row_of_boxes(count);
  check_is_block(scene_of({united(boxes)}), Transform{}, count, 20000);
  Random random(13);
  for (int i = 0; i < 10; ++i) {
    const Transform map = turned(180.0 * random.in_cube(), random.in_cube());
    CAPTURE(i);
    check_is_block(scene_of({united(boxes).transformed(map)}), map, count, 3000);
    std::vector<Entity> one_by_one;
    for (const Entity& one : boxes) one_by_one.push_back(one.transformed(map));
    check_is_block(scene_of({united(one_by_one)}), map, count, 3000);
  }
}

TEST_CASE("a block of boxes shows no face within it") {
  constexpr int count = 12;
  const Transform map = turned({20, 30, 40});
  const PreparedScene scene = scene_of({united(row_of_boxes(count)).transformed(map)});
  Random random(17);
  for (int i = 0; i < 30000; ++i) {
    const Vec3 target(random.between(0, count * 0.1), random.between(0, 0.1),
                      random.between(0, 0.1));
    const Vec3 from = Vec3(0.6, 0.05, 0.05) + 2.0 * glm::normalize(random.in_cube());
    const std::optional<Hit> hit = intersect(
        scene, {.origin = moved(map, from), .direction = moved(map, target) - moved(map, from)});
    if (!hit) continue;
    // Faces across the row are only at its ends.
    if (std::abs(glm::dot(hit->normal, moved(map, {1, 0, 0}))) < 0.5) continue;
    const double along = glm::dot(hit->position, moved(map, {1, 0, 0}));
    CHECK(std::min(std::abs(along), std::abs(along - count * 0.1)) < 1e-12);
  }
}

TEST_CASE("films of a hundred roundings are seen, and gaps of two are none") {
  Random random(19);
  for (int i = 0; i < 400; ++i) {
    const double place = std::pow(10.0, random.between(-3, 6));
    const double size = std::pow(10.0, random.between(-3, 3));
    const auto pair = [&](double roundings) {
      const double gap = roundings * u * (size + place);
      return box({place - size, -size, -size}, {place, size, size}) +
             box({place + gap, -size, -size}, {place + gap + size, size, size});
    };
    const Vec3 beside = 0.4 * size * random.in_cube();
    const Vec3 direction(1, random.between(-0.2, 0.2), random.between(-0.2, 0.2));
    const Transform map = i % 2 == 0 ? Transform{} : rotate_degrees(180.0 * random.in_cube());
    const Ray ray{.origin = moved(map, Vec3(place, 0, 0) + beside - 2 * size * direction),
                  .direction = moved(map, direction)};
    CAPTURE(i);
    CAPTURE(place);
    CAPTURE(size);
    CHECK(places(scene_of({pair(100).transformed(map)}), ray).size() == 4);
    CHECK(places(scene_of({pair(2).transformed(map)}), ray).size() == 2);
    // In the exact tier a gap is a gap.
    const bool is_gap = place + 2 * u * (size + place) > place;
    CHECK(places(scene_of({pair(2).transformed(map)}, Precision::exact), ray).size() ==
          (is_gap ? 4 : 2));
  }
}

TEST_CASE("a film between a hundred roundings of solids of their own is seen") {
  const Entity lower = box({-1, -1, -1}, {1, 0, 1});
  const double film = 100 * u * 3;
  const Entity upper = box({-1, film, -1}, {1, 1, 1});
  const std::vector<double> found =
      places(scene_of({lower, upper}), {.origin = {0.1, -3, 0.2}, .direction = {0.1, 1, 0.05}});
  REQUIRE(found.size() == 4);
  CHECK(found[1] < found[2]);
}

TEST_CASE("all queries give solids that touch one t") {
  Random random(23);
  int touched = 0;
  for (int i = 0; i < 300; ++i) {
    const Transform map = turned(180.0 * random.in_cube(), 3.0 * random.in_cube());
    std::vector<Entity> boxes = row_of_boxes(8);
    for (Entity& one : boxes) one = one.transformed(map);
    const PreparedScene scene = scene_of(boxes);
    for (int k = 0; k < 100; ++k) {
      const double x = random.between(0.05, 0.75);
      const Vec3 from(x, random.between(0.01, 0.09), random.between(0.01, 0.09));
      const Vec3 to(random.between(0.05, 0.75), random.between(0.01, 0.09),
                    random.between(0.01, 0.09));
      const Ray ray{.origin = moved(map, from), .direction = moved(map, to) - moved(map, from)};
      const std::vector<Hit> all = crossings(scene, ray);
      const std::optional<Hit> first = intersect(scene, ray);
      REQUIRE(first);
      CHECK(first->t == all[0].t);
      // Between the first and the last, solids are left where others are entered.
      REQUIRE(all.size() % 2 == 1);
      for (std::size_t n = 0; n + 1 < all.size(); n += 2) {
        CHECK(all[n].t == all[n + 1].t);
        CHECK_FALSE(all[n].entering);
        CHECK(all[n + 1].entering);
        ++touched;
      }
    }
  }
  CHECK(touched > 10000);
}

TEST_CASE("a union is not lost from far away, if its parts are not") {
  Random random(31);
  for (const Precision tier : {Precision::standard, Precision::exact}) {
    for (int i = 0; i < 3000; ++i) {
      const Entity one = Sphere{.center = random.in_cube(), .radius = random.between(0.5, 1)};
      const Entity other = box(random.in_cube(), Vec3(0.2) + random.in_cube());
      const Vec3 direction = glm::normalize(random.in_cube());
      const double far = std::pow(10.0, random.between(9, 12));
      const Ray ray{.origin = random.in_cube() - far * direction, .direction = direction};
      const auto longest = [&](const Entity& entity) {
        const std::vector<double> found = places(scene_of({entity}, tier), ray);
        double length = 0;
        for (std::size_t k = 0; k + 1 < found.size(); k += 2)
          length = std::max(length, found[k + 1] - found[k]);
        return length;
      };
      const double part = std::max(longest(one), longest(other));
      CAPTURE(i);
      CAPTURE(far);
      CHECK(longest(one + other) >= part - 4 * far * 0x1p-52);
    }
  }
}

TEST_CASE("a chord of one unit in the last place of t is not lost in a union") {
  // The box is so long along the ray, from where t has so many digits left.
  const double far = 0x1p50;
  const Ray ray{.origin = {0.5 - far, 0.5, 0.5}, .direction = {1, 0, 0}};
  const Entity one = box({0, 0, 0}, {0x1p-2, 1, 1});
  const Entity other = box({0, 0.25, 0.25}, {0x1p-2, 0.75, 0.75});
  REQUIRE(places(scene_of({one}), ray).size() == 2);
  REQUIRE(places(scene_of({other}), ray).size() == 2);
  const std::vector<double> found = places(scene_of({one + other}), ray);
  CHECK(found == places(scene_of({one}), ray));
  Random random(41);
  int chords = 0;
  for (int i = 0; i < 2000; ++i) {
    const Entity ball = Sphere{.center = random.in_cube(), .radius = random.between(0.5, 1)};
    const Entity block = box(random.in_cube(), Vec3(0.2) + random.in_cube());
    const Vec3 direction = glm::normalize(random.in_cube());
    const Ray from_afar{
        .origin = random.in_cube() - std::pow(2.0, random.between(45, 50)) * direction,
        .direction = direction};
    for (const Entity& part : {ball, block}) {
      const std::vector<double> own = places(scene_of({part}), from_afar);
      if (own.size() != 2) continue;
      const std::vector<double> of_all = places(scene_of({ball + block}), from_afar);
      CAPTURE(i);
      REQUIRE(!of_all.empty());
      // The other's face may be at one place with an end, and known as well.
      const double last_place = 0x1p-52 * own.back();
      CHECK(of_all.front() <= own.front() + last_place);
      CHECK(of_all.back() >= own.back() - last_place);
      ++chords;
    }
  }
  CHECK(chords > 500);
}
