#include "crt/implicit_shapes.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "crt/error.hpp"
#include "geometry/field_tools.hpp"

using namespace crt;
using namespace crt::test;

TEST_CASE("blob: a part alone is a ball or a capsule, and parts flow together") {
  // (1 - 1/4)^2 of a strength of 2 is 9/8.
  const double level = 9.0 / 8;
  const BlobPart ball{.radius = 2, .strength = 2};
  check_against(blob(std::array{ball}, level), Sphere{}, 1000);
  const BlobPart line{.from = {0, -0.5, 0}, .to = {0, 0.5, 0}, .radius = 1, .strength = 2};
  check_against(blob(std::array{line}, level),
                Capsule{.from = line.from, .to = line.to, .radius = 0.5}, 1000);
  const auto at = [](double place, double strength) {
    return BlobPart{.from = {place, 0, 0}, .to = {place, 0, 0}, .strength = strength};
  };
  const core::ObjectRay ray{.origin = {-5, 0, 0}, .direction = {1, 0, 0}};
  CHECK(crossings(blob(std::array{at(-1, 1), at(1, 1)}, 0.25), ray).size() == 4);
  CHECK(crossings(blob(std::array{at(-0.6, 1), at(0.6, 1)}, 0.25), ray).size() == 2);
  CHECK(crossings(blob(std::array{at(-0.6, 1), at(0.6, 1), at(0, -1)}, 0.25), ray).size() == 4);
}

TEST_CASE("blob: parts that are wrong are named") {
  const auto refused = [](const BlobPart& part, double threshold) {
    try {
      blob(std::array{BlobPart{}, part}, threshold);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const double nan = std::nan("");
  CHECK(refused({}, 0.5).empty());
  CHECK(refused({}, 0).starts_with("threshold"));
  CHECK(refused({}, nan).starts_with("threshold"));
  CHECK(refused({.from = {nan, 0, 0}}, 1).starts_with("parts: part 1 "));
  CHECK(refused({.radius = 0}, 1).starts_with("parts: part 1 "));
  CHECK(refused({.strength = 0}, 1).starts_with("parts: part 1 "));
  CHECK(refused({.strength = nan}, 1).starts_with("parts: part 1 "));
  CHECK_THROWS_AS(blob({}, 1), Error);
  CHECK_THROWS_AS(blob(std::array{BlobPart{.strength = -1}}, 1), Error);
  CHECK_THROWS_AS(blob(std::vector<BlobPart>(2000), 1), Error);
}

TEST_CASE("superellipsoid: it goes from a ball to an octahedron and a cube") {
  check_against(superellipsoid(1, 1), Sphere{}, 1000);
  const Vec3 reach(1.0625);
  const Field octahedron = abs(x) + abs(y) + abs(z) - 1;
  Random random(17);
  for (int i = 0; i < 500; ++i) {
    const core::ObjectRay ray = random_ray(random, 1);
    const core::CrossingList one = crossings(superellipsoid(2, 2), ray);
    const core::CrossingList other = crossings({octahedron, -reach, reach}, ray);
    REQUIRE(one.size() == other.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
      REQUIRE(std::abs(one[k].t - other[k].t) <= one[k].error + other[k].error);
    }
  }
  const core::CrossingList cube =
      crossings(superellipsoid(0.01, 0.01), {{-5, 0.9, 0.9}, {}, {1, 0, 0}});
  REQUIRE(cube.size() == 2);
  CHECK(cube[0].t == doctest::Approx(4));
  CHECK_THROWS_AS(superellipsoid(0, 1), Error);
  CHECK_THROWS_AS(superellipsoid(1, 10.5), Error);
  CHECK_THROWS_AS(superellipsoid(std::nan(""), 1), Error);
}
