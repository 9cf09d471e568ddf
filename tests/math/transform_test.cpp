#include <doctest/doctest.h>
#include <crt/error.hpp>
#include <crt/transform.hpp>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

using crt::Transform;
using crt::Vec3;

namespace {

Vec3 apply(const Transform& transform, const Vec3& p) {
  return Vec3(glm::dot(transform.row_x, p), glm::dot(transform.row_y, p),
              glm::dot(transform.row_z, p)) +
         transform.translation;
}

template <class Call>
std::string rejected_argument(Call call) {
  try {
    call();
  } catch (const crt::Error& error) {
    CHECK(error.code() == crt::ErrorCode::invalid_argument);
    CHECK(std::string(error.what()).find(error.argument()) == 0);
    return error.argument();
  }
  return "";
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("a rotation about an axis turns by its angle, and a mirror's normal turns over") {
  const auto moved = [](const crt::Transform& map, const crt::Vec3& p) {
    return crt::Vec3(glm::dot(map.row_x, p), glm::dot(map.row_y, p), glm::dot(map.row_z, p));
  };
  const auto near = [](const crt::Vec3& a, const crt::Vec3& b) {
    return glm::length(a - b) < 1e-14;
  };
  const crt::Vec3 axis(1, 2, -2);
  const crt::Vec3 across(2, 1, 2);  // normal to it, and as long
  const crt::Vec3 third = glm::cross(axis, across) / 3.0;
  for (const double degrees : {30.0, 90.0, -75.0, 180.0, 400.0}) {
    const crt::Transform map = crt::rotate_degrees(axis, degrees);
    const double radians = degrees * 3.14159265358979323846 / 180;
    CHECK(near(moved(map, axis), axis));
    CHECK(near(moved(map, across), std::cos(radians) * across + std::sin(radians) * third));
  }
  CHECK(crt::rotate_degrees({0, 0, 1e-200}, 90) == crt::rotate_degrees({0, 0, 90}));
  CHECK(crt::rotate_degrees({0, 1e200, 0}, 270) == crt::rotate_degrees({0, 270, 0}));
  const crt::Transform map = crt::mirror(axis);
  CHECK(near(moved(map, axis), -axis));
  CHECK(near(moved(map, across), across));
  CHECK(near(moved(map, third), third));
  CHECK(crt::mirror({0, -7, 0}) == crt::scale({1, -1, 1}));
  CHECK_THROWS_AS(crt::mirror({0, 0, 0}), crt::Error);
  CHECK_THROWS_AS(crt::rotate_degrees({0, 0, 1}, std::nan("")), crt::Error);
}

TEST_CASE("translate and scale do what they say") {
  CHECK(apply(crt::translate({1, 2, 3}), {10, 20, 30}) == Vec3(11, 22, 33));
  CHECK(apply(crt::scale(2), {1, 2, 3}) == Vec3(2, 4, 6));
  CHECK(apply(crt::scale({2, -3, 0.5}), {1, 2, 4}) == Vec3(2, -6, 2));
}

TEST_CASE("a quarter turn takes one axis exactly to the next") {
  CHECK(apply(crt::rotate_degrees({0, 0, 90}), {1, 0, 0}) == Vec3(0, 1, 0));
  CHECK(apply(crt::rotate_degrees({90, 0, 0}), {0, 1, 0}) == Vec3(0, 0, 1));
  CHECK(apply(crt::rotate_degrees({0, 90, 0}), {0, 0, 1}) == Vec3(1, 0, 0));
  CHECK(apply(crt::rotate_degrees({-90, 0, 0}), {0, 0, 1}) == Vec3(0, 1, 0));
}

TEST_CASE("every multiple of 90 degrees is exact, however often it turns") {
  for (int quarters = -4000; quarters <= 4000; ++quarters) {
    const int turn = ((quarters % 4) + 4) % 4;
    const double cosine = turn == 0 ? 1 : (turn == 2 ? -1 : 0);
    const double sine = turn == 1 ? 1 : (turn == 3 ? -1 : 0);
    const Transform rotation = crt::rotate_degrees({0, 0, 90.0 * quarters});
    REQUIRE(rotation.row_x == Vec3(cosine, -sine, 0));
    REQUIRE(rotation.row_y == Vec3(sine, cosine, 0));
    REQUIRE(rotation.row_z == Vec3(0, 0, 1));
  }
}

TEST_CASE("a rotation turns about x, then y, then z") {
  const Vec3 p(0.3, -0.7, 1.9);
  const Vec3 one_by_one =
      apply(crt::rotate_degrees({0, 0, 70}),
            apply(crt::rotate_degrees({0, -140, 0}), apply(crt::rotate_degrees({20, 0, 0}), p)));
  CHECK(glm::distance(apply(crt::rotate_degrees({20, -140, 70}), p), one_by_one) < 1e-15);
}

TEST_CASE("a rotation keeps lengths and handedness") {
  for (int i = 0; i < 1000; ++i) {
    const Transform r = crt::rotate_degrees({i * 0.77, i * -1.31, i * 2.9});
    REQUIRE(glm::length(r.row_x) == doctest::Approx(1).epsilon(1e-15));
    REQUIRE(std::abs(glm::dot(r.row_x, r.row_y)) < 1e-15);
    REQUIRE(glm::distance(glm::cross(r.row_x, r.row_y), r.row_z) < 1e-15);
  }
}

TEST_CASE("angles whole turns apart give equal bits") {
  CHECK(crt::rotate_degrees({30, 45, 60}) == crt::rotate_degrees({30 + 360, 45 - 720, 60 + 36000}));
}

TEST_CASE("rotate, the name in version 1.0, still takes degrees") {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
  CHECK(crt::rotate({30, 45, 60}) == crt::rotate_degrees({30, 45, 60}));
#pragma GCC diagnostic pop
}

TEST_CASE("transforms that are not finite or flatten space are refused by name") {
  CHECK(rejected_argument([] { crt::translate({0, not_a_number, 0}); }) == "offset");
  CHECK(rejected_argument([] { crt::translate({0, 0, -1.1e100}); }) == "offset");
  CHECK(rejected_argument([] { crt::scale(0.0); }) == "factor");
  CHECK(rejected_argument([] { crt::scale(inf); }) == "factor");
  CHECK(rejected_argument([] { crt::scale(1e101); }) == "factor");
  CHECK(rejected_argument([] { crt::scale(-1e-101); }) == "factor");
  CHECK(rejected_argument([] { crt::scale({1, 0, 1}); }) == "factors");
  CHECK(rejected_argument([] { crt::scale({1, 1, not_a_number}); }) == "factors");
  CHECK(rejected_argument([] { crt::rotate_degrees({0, inf, 0}); }) == "degrees");
}

TEST_CASE("transforms at their limits are accepted") {
  CHECK(crt::translate({1e100, -1e100, 0}).translation == Vec3(1e100, -1e100, 0));
  CHECK(crt::scale(1e-100).row_y.y == 1e-100);
  CHECK(crt::scale({-1e100, 1, 1}).row_x.x == -1e100);
  CHECK(crt::rotate_degrees({1e300, 0, 0}).row_x == Vec3(1, 0, 0));
}
