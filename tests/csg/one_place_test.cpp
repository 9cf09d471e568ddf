// What is at one place along a ray: gaps of a few roundings are none, films of a hundred are seen,
// and a surface that is all but parallel to the ray takes nothing else with it.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/scene.hpp"
#include "crt/transform.hpp"

using namespace crt;

namespace {

constexpr double u = 0x1p-53;

/// A Random gives numbers that are the same everywhere.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }
  Vec3 in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }

 private:
  std::mt19937_64 engine_;
};

PreparedScene scene_of(const std::vector<Entity>& entities,
                       Precision precision = Precision::standard) {
  Scene scene;
  scene.entities = entities;
  scene.settings.precision = precision;
  return prepare(scene);
}

std::vector<double> places(const PreparedScene& scene, const Ray& ray) {
  std::vector<double> result;
  for (const Hit& hit : crossings(scene, ray)) result.push_back(hit.t);
  return result;
}

std::shared_ptr<const Profile> profile_of(const std::vector<Contour>& contours) {
  return make_profile(contours);
}

std::shared_ptr<const Profile> disc_of(double radius) {
  return profile_of({{{radius, 0, 1}, {-radius, 0, 1}}});
}

/// Returns a letter's outline: straight walls, an arc and a hole.
std::shared_ptr<const Profile> letter() {
  return profile_of({{{-1, -1}, {1, -1}, {1, 0.5, 0.6}, {-0.3, 1}, {-1, 1}},
                     {{-0.5, -0.5}, {0.2, -0.5}, {0.2, 0.1}, {-0.5, 0.1}}});
}

/// Returns two vectors across a direction.
std::array<Vec3, 2> across(const Vec3& direction) {
  const Vec3 one = glm::normalize(glm::cross(direction, Vec3(0.3, -1, 0.7)));
  return {one, glm::normalize(glm::cross(direction, one))};
}

/// Checks that both tiers cross a scene alike, by rays side by side along a direction. Returns the
/// number of crossings.
std::size_t check_tiers(const Entity& entity, const Vec3& from, const Vec3& direction,
                        double half_width, int rays) {
  const PreparedScene standard = scene_of({entity});
  const PreparedScene exact = scene_of({entity}, Precision::exact);
  const auto [x, y] = across(direction);
  Random random(1);
  std::size_t count = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 beside = half_width * (random.between(-1, 1) * x + random.between(-1, 1) * y);
    const Ray ray{.origin = from + beside, .direction = direction};
    const std::vector<double> found = places(standard, ray);
    const std::vector<double> truth = places(exact, ray);
    CAPTURE(i);
    CAPTURE(found);
    CAPTURE(truth);
    REQUIRE(found.size() == truth.size());
    for (std::size_t k = 0; k < found.size(); ++k)
      CHECK(found[k] == doctest::Approx(truth[k]).epsilon(1e-10));
    count += found.size();
    CHECK(intersect(standard, ray).has_value() == !truth.empty());
  }
  return count;
}

Transform turned(const Vec3& degrees, const Vec3& offset = {0, 0, 0}) {
  Transform map = rotate(degrees);
  map.translation = offset;
  return map;
}

Entity box(const Vec3& a, const Vec3& b) {
  return Box{.corner_a = a, .corner_b = b};
}

/// Returns boxes from i * 0.1 to i * 0.1 + 0.1, of which some touch and others are a rounding
/// apart.
std::vector<Entity> row_of_boxes(int count) {
  std::vector<Entity> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(box({i * 0.1, 0, 0}, {i * 0.1 + 0.1, 0.1, 0.1}));
  return boxes;
}

Entity united(const std::vector<Entity>& entities) {
  Entity all = entities[0];
  for (std::size_t i = 1; i < entities.size(); ++i) all = all + entities[i];
  return all;
}

Vec3 moved(const Transform& map, const Vec3& p) {
  return Vec3(glm::dot(map.row_x, p), glm::dot(map.row_y, p), glm::dot(map.row_z, p)) +
         map.translation;
}

/// Checks that rays through the row meet one block.
void check_is_block(const PreparedScene& scene, const Transform& map, int count, int rays) {
  Random random(7);
  const double end = count * 0.1;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from(random.between(0.01, end - 0.01), random.between(0.01, 0.09),
                    random.between(0.01, 0.09));
    const Vec3 to(random.between(0.01, end - 0.01), random.between(0.01, 0.09),
                  random.between(0.01, 0.09));
    const Vec3 direction = moved(map, to) - moved(map, from);
    const Ray ray{.origin = moved(map, from) - 30.0 / glm::length(direction) * direction,
                  .direction = direction};
    const std::vector<double> found = places(scene, ray);
    CAPTURE(i);
    CAPTURE(found);
    REQUIRE(found.size() == 2);
    const Ray inside{.origin = moved(map, from), .direction = direction};
    const std::vector<double> ahead = places(scene, inside);
    CAPTURE(ahead);
    REQUIRE(ahead.size() == 1);
    const std::optional<Hit> hit = intersect(scene, inside);
    REQUIRE(hit);
    CHECK(hit->t == ahead[0]);
  }
}

}  // namespace

TEST_CASE("a disc's extrusion is met by all rays along its axis") {
  const Vec3 axis(1, 2, 3);
  const Entity rod = extruded(disc_of(1), {0, 0, 0}, axis);
  for (const Precision tier : {Precision::standard, Precision::exact}) {
    const PreparedScene scene = scene_of({rod}, tier);
    const auto [x, y] = across(axis);
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 64; ++column) {
        const Vec3 beside = (row - 31.5) / 48 * x + (column - 31.5) / 48 * y;
        const Ray ray{.origin = -2.0 * axis + beside, .direction = axis};
        CAPTURE(row);
        CAPTURE(column);
        REQUIRE(intersect(scene, ray).has_value() == (glm::length(beside) < 1));
      }
    }
  }
}

TEST_CASE("a hole along a ray through a ball is seen") {
  const Vec3 axis(1, 2, 3);
  const Entity holed = Entity(Sphere{.radius = 5}) - extruded(disc_of(1), -axis, axis);
  for (const Precision tier : {Precision::standard, Precision::exact}) {
    const std::vector<double> found =
        places(scene_of({holed}, tier), {.origin = {-10, -20, -30}, .direction = axis});
    const double chord = 5 / glm::length(axis);
    const std::vector<double> truth = {10 - chord, 9, 11, 10 + chord};
    CAPTURE(found);
    REQUIRE(found.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) CHECK(found[i] == doctest::Approx(truth[i]).epsilon(1e-14));
  }
}

TEST_CASE("extrusions along rays are met alike in both tiers") {
  Random random(3);
  std::size_t count = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec3 from = 3.0 * random.in_cube();
    const Vec3 axis = random.in_cube();
    const Entity rod = extruded(letter(), from, from + axis);
    CAPTURE(i);
    count += check_tiers(rod, from - 5.0 * axis, axis, 1.2, 60);
    count += check_tiers(Entity(Sphere{.center = from, .radius = 4}) - rod, from - 9.0 * axis, axis,
                         1.2, 20);
  }
  CHECK(count > 1000);
}

TEST_CASE("a turn that is not whole is met alike in both tiers along its ends") {
  Random random(5);
  std::size_t count = 0;
  const auto profile = profile_of({{{0.5, 0}, {2, 0, 0.3}, {2, 1}, {1.2, 1.5}, {0.5, 1}}});
  for (int i = 0; i < 40; ++i) {
    const double angle = random.between(0.3, 6);
    const Vec3 end(std::sin(angle), 0, std::cos(angle));
    const Vec3 direction = end + random.between(-1, 1) * Vec3(0, 1, 0);
    const Entity part = Revolution{.profile = profile, .angle = angle};
    CAPTURE(i);
    count += check_tiers(part, Vec3(0, 0.7, 0) - 5.0 * direction, direction, 1.5, 60);
    const Transform map = turned(180.0 * random.in_cube(), random.in_cube());
    count += check_tiers(part.transformed(map), moved(map, Vec3(0, 0.7, 0) - 5.0 * direction),
                         moved(map, direction) - map.translation, 1.5, 60);
  }
  CHECK(count > 1000);
}

TEST_CASE("a half-space that is all but parallel to a ray takes no ball with it") {
  Random random(11);
  int balls = 0;
  for (int i = 0; i < 3000; ++i) {
    Vec3 direction = glm::normalize(random.in_cube());
    const auto [normal, other] = across(direction);
    // The ball is all in the half-space, or all beyond it.
    const double height = random.between(0, 1) < 0.5 ? 3 : -3;
    // What is crossed 1e16 ahead may be at the start for all that is known.
    const std::vector<double> plane = places(
        scene_of({Entity(Plane{.normal = normal})}),
        {.origin = height * normal - 6.0 * direction, .direction = direction, .t_min = -1e300});
    if (!plane.empty() && plane[0] > 0) direction = -direction;
    const PreparedScene scene =
        scene_of({Entity(Sphere{.center = height * normal}) ^ Plane{.normal = -normal}});
    const Vec3 beside = random.between(-0.5, 0.5) * normal + random.between(-0.5, 0.5) * other;
    const Ray ray{.origin = height * normal + beside - 6.0 * direction, .direction = direction};
    CAPTURE(i);
    REQUIRE(places(scene, ray).size() == (height > 0 ? 2 : 0));
    balls += height > 0 ? 1 : 0;
  }
  CHECK(balls > 1000);
}

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
    const Transform map = i % 2 == 0 ? Transform{} : rotate(180.0 * random.in_cube());
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

TEST_CASE("a line that all but touches a bore is parted by it twice or not at all") {
  const double radius = 0x1.6f31ba6c42e88p+0;
  const auto plate =
      profile_of({{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, {{radius, 0, 1}, {-radius, 0, 1}}});
  const Ray ray{.origin = {0x1.65b2725c19ed6p+0, -0x1.a339616001a35p-1, 0x1.38ab5a23dc2ecp+1},
                .direction = {0x1.e25227fa7b238p-6, 0x1.3ee6a92b00e66p-1, -0x1.90460afee21f1p-1},
                .t_min = -10};
  for (const Precision tier : {Precision::standard, Precision::exact}) {
    const std::vector<double> found =
        places(scene_of({Entity(Extrusion{.profile = plate, .from = 0, .to = 3})}, tier), ray);
    CAPTURE(found);
    REQUIRE(found.size() == 4);
    CHECK(found[0] == doctest::Approx(-0.7128).epsilon(1e-4));
    CHECK(found[1] == doctest::Approx(1.205868606).epsilon(1e-7));
    CHECK(found[2] == doctest::Approx(1.205868617).epsilon(1e-7));
    CHECK(found[3] == doctest::Approx(3.1246).epsilon(1e-4));
  }
}

TEST_CASE("lines that all but touch an arc are never inside out") {
  Random random(29);
  int near = 0;
  for (int i = 0; i < 400; ++i) {
    const double radius = random.between(0.5, 2);
    const auto plate =
        profile_of({{{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, {{radius, 0, 1}, {-radius, 0, 1}}});
    const PreparedScene scene = scene_of({Entity(Extrusion{.profile = plate, .from = 0, .to = 3})});
    for (int k = 0; k < 50; ++k) {
      const double angle = random.between(0, 2 * std::numbers::pi);
      const double off = std::pow(10.0, random.between(-17, -13)) * (k % 2 == 0 ? 1 : -1);
      const Vec3 outwards(std::cos(angle), std::sin(angle), 0);
      const Vec3 along(-std::sin(angle), std::cos(angle), random.between(-0.3, 0.3));
      const Vec3 touched = (radius + off) * outwards + Vec3(0, 0, 1.5);
      const Ray ray{
          .origin = touched - random.between(0.1, 1) * along, .direction = along, .t_min = -10};
      const std::vector<double> found = places(scene, ray);
      CAPTURE(i);
      CAPTURE(k);
      CAPTURE(found);
      REQUIRE((found.size() == 2 || found.size() == 4));
      if (found.size() == 4) {
        // The part in the bore is about where the line touches it.
        CHECK(found[2] - found[1] < 1e-5);
        ++near;
      }
      CHECK(found.back() - found.front() > 2);
    }
  }
  CHECK(near > 1000);
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

TEST_CASE("facets along a ray are met within themselves") {
  // A prism whose sides are nearly parallel to the rays.
  Random random(37);
  std::size_t count = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 axis = random.in_cube();
    const auto [x, y] = across(axis);
    const auto corner = [&](int k, double along) {
      const double angle = 2 * std::numbers::pi * k / 5;
      return std::cos(angle) * x + std::sin(angle) * y + along * axis;
    };
    std::vector<Vec3> positions;
    std::vector<TriangleIndices> triangles;
    for (int k = 0; k < 5; ++k) positions.push_back(corner(k, 0));
    for (int k = 0; k < 5; ++k) positions.push_back(corner(k, 1));
    for (std::uint32_t k = 0; k < 5; ++k) {
      const std::uint32_t next = (k + 1) % 5;
      triangles.push_back({k, next, next + 5});
      triangles.push_back({k, next + 5, k + 5});
    }
    for (std::uint32_t k = 1; k < 4; ++k) {
      triangles.push_back({0, k + 1, k});
      triangles.push_back({5, k + 5, k + 6});
    }
    const Entity prism = Mesh{.triangles = mesh_triangles(positions, triangles)};
    const PreparedScene standard = scene_of({prism});
    const PreparedScene exact = scene_of({prism}, Precision::exact);
    for (int k = 0; k < 200; ++k) {
      // The line is in a side's plane to rounding, and leaves or enters it somewhere.
      const int side = k % 5;
      const double share = random.between(0, 1);
      const Vec3 start = (1 - share) * corner(side, 0) + share * corner((side + 1) % 5, 0);
      const Vec3 tilt = std::pow(10.0, random.between(-17, -12)) * random.in_cube();
      const Ray ray{.origin = start - 2.0 * axis, .direction = axis + tilt};
      const std::vector<double> found = places(standard, ray);
      const std::vector<double> truth = places(exact, ray);
      CAPTURE(i);
      CAPTURE(k);
      CAPTURE(found);
      CAPTURE(truth);
      REQUIRE(found.size() == truth.size());
      for (std::size_t n = 0; n < found.size(); ++n)
        CHECK(found[n] == doctest::Approx(truth[n]).epsilon(1e-9));
      count += found.size();
    }
  }
  CHECK(count > 1000);
}
