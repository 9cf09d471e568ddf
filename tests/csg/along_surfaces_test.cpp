// A surface that is all but parallel to the ray takes nothing else with it.
#include "csg/places.hpp"

using namespace crt;
using namespace crt::test::places_of;

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

TEST_CASE("facets along a ray are met where they are") {
  // A star's prism is seen nearly along its sides.
  constexpr std::uint32_t corners = 8;
  Random random(3);
  std::size_t count = 0;
  for (int i = 0; i < 60; ++i) {
    const Vec3 axis = random.in_cube();
    const auto [x, y] = across(axis);
    const auto corner = [&](std::uint32_t k, double along) {
      const double angle = 2 * std::numbers::pi * k / corners;
      return (k % 2 == 0 ? 1 : 0.4) * (std::cos(angle) * x + std::sin(angle) * y) + along * axis;
    };
    std::vector<Vec3> positions;
    for (std::uint32_t k = 0; k < corners; ++k) positions.push_back(corner(k, 0));
    for (std::uint32_t k = 0; k < corners; ++k) positions.push_back(corner(k, 1));
    positions.emplace_back(0, 0, 0);
    positions.push_back(axis);
    std::vector<TriangleIndices> triangles;
    for (std::uint32_t k = 0; k < corners; ++k) {
      const std::uint32_t next = (k + 1) % corners;
      triangles.push_back({k, next, next + corners});
      triangles.push_back({k, next + corners, k + corners});
      triangles.push_back({2 * corners, next, k});
      triangles.push_back({2 * corners + 1, k + corners, next + corners});
    }
    const Entity star = Mesh{.triangles = mesh_triangles(positions, triangles)};
    const PreparedScene standard = scene_of({star});
    const PreparedScene exact = scene_of({star}, Precision::exact);
    for (std::uint32_t k = 0; k < 400; ++k) {
      const std::uint32_t side = k % corners;
      const Vec3 from = corner(side, random.between(0, 1));
      const Vec3 way = corner(side + 1, 0) - corner(side, 0);
      const Vec3 along = axis + random.between(-0.5, 0.5) * way;
      const Vec3 direction = along + std::pow(10.0, random.between(-17, -4)) * random.in_cube();
      const Ray ray{.origin = from + random.between(0, 1) * way - random.between(2, 20) * direction,
                    .direction = direction,
                    .t_min = -1000};
      const std::vector<double> found = places(standard, ray);
      const std::vector<double> truth = places(exact, ray);
      CAPTURE(i);
      CAPTURE(k);
      REQUIRE(found.size() == truth.size());
      for (std::size_t n = 0; n < found.size(); ++n) CHECK(std::abs(found[n] - truth[n]) < 1e-8);
      count += found.size();
    }
  }
  CHECK(count > 1000);
}
