#include "crt/offset.hpp"

#include <doctest/doctest.h>

#include "contours/simple_contours.hpp"
#include "contours/winding_oracle.hpp"
#include "crt/error.hpp"

using namespace crt;
using namespace crt::test;

namespace {

using Contours = std::vector<Contour>;

/// Checks points: those of the offset are within the distance of the region, and no others.
void check_offset(const Contours& contours, double distance, Random& random, double size) {
  // What contours have in common is no boundary by the even-odd rule.
  const Contours region = offset_contours(contours, 0);
  const Contours moved = offset_contours(contours, distance);
  if (!moved.empty()) CHECK_NOTHROW(make_profile(moved));
  const double margin = 1e-3 * size;  // View takes chords of arcs
  for (int i = 0; i < 20; ++i) {
    const Point point{random.uniform(-size, size), random.uniform(-size, size)};
    const View before(region, point);
    const bool is_in = before.winding == 1;
    CHECK((before.distance < margin || is_in == View(contours, point).is_odd()));
    const long double beyond = (is_in ? -before.distance : before.distance) - distance;
    if (std::fabs(beyond) < margin) continue;
    CAPTURE(distance);
    CAPTURE(static_cast<double>(point.x));
    CAPTURE(static_cast<double>(point.y));
    CAPTURE(static_cast<double>(beyond));
    CHECK((View(moved, point).winding == 1) == (beyond < 0));
  }
}

}  // namespace

TEST_CASE("a square grows by quarters of a circle, and shrinks to a square") {
  const Contours square = {rectangle(0, 0, 4, 4)};
  const Contours larger = offset_contours(square, 1);
  REQUIRE(larger.size() == 1);
  CHECK(larger[0].size() == 8);
  CHECK(area_of(larger) == doctest::Approx(16 + 16 + std::numbers::pi));
  const Contours smaller = offset_contours(square, -1);
  REQUIRE(smaller.size() == 1);
  CHECK(smaller[0].size() == 4);
  CHECK(area_of(smaller) == doctest::Approx(4));
  CHECK(offset_contours(square, -2.5).empty());
  CHECK(area_of(offset_contours(square, 0)) == 16);
}

TEST_CASE("circles, rings and slots have other radii, and vanish when these would be below 0") {
  const double pi = std::numbers::pi;
  const Contours ring = {circle(1, 2, 3), circle(1, 2, 1)};
  CHECK(area_of(offset_contours(ring, 0.5)) == doctest::Approx(pi * (3.5 * 3.5 - 0.25)));
  CHECK(area_of(offset_contours(ring, 1.5)) == doctest::Approx(pi * 4.5 * 4.5));
  CHECK(area_of(offset_contours(ring, -0.5)) == doctest::Approx(pi * (2.5 * 2.5 - 1.5 * 1.5)));
  CHECK(offset_contours(ring, -1.5).empty());
  CHECK(offset_contours(Contours{circle(0, 0, 1)}, -1).empty());
  CHECK(offset_contours(Contours{circle(0, 0, 1)}, -3).empty());
  const Contours slot = {{{-2, -1}, {2, -1}, {2, 1, 1}, {-2, 1}, {-2, -1, 1}}};
  const Contours grown = offset_contours(slot, 1);
  CHECK(area_of(grown) == doctest::Approx(4 * 4 + 4 * pi));
  // A fillet that is as large as the distance becomes a corner.
  const Contours corner = {
      {{0, 0}, {9, 0}, {9, 5}, {6, 5}, {5, 6, -std::tan(pi / 8)}, {5, 9}, {0, 9}}};
  const Contours sharp = offset_contours(corner, 1);
  REQUIRE(sharp.size() == 1);
  CHECK(area_of(sharp) == doctest::Approx(11 * 11 - 4 * 4 - 5 * (1 - pi / 4)));
}

TEST_CASE("parts join and fall apart, and holes close") {
  const Contours two = {rectangle(0, 0, 2, 2), rectangle(3, 0, 5, 2)};
  CHECK(offset_contours(two, 0.4).size() == 2);
  CHECK(offset_contours(two, 0.6).size() == 1);
  const Contours bone = {{{0, 0},
                          {2, 0},
                          {2, 0.8},
                          {4, 0.8},
                          {4, 0},
                          {6, 0},
                          {6, 2},
                          {4, 2},
                          {4, 1.2},
                          {2, 1.2},
                          {2, 2},
                          {0, 2}}};
  CHECK(offset_contours(bone, -0.1).size() == 1);
  CHECK(offset_contours(bone, -0.3).size() == 2);
  const Contours frame = {rectangle(0, 0, 10, 10), rectangle(4, 4, 6, 6)};
  CHECK(offset_contours(frame, 0.9).size() == 2);
  CHECK(offset_contours(frame, 1.1).size() == 1);
  // Contours that cross enclose what the even-odd rule says.
  const Contours crossing = {rectangle(0, 0, 4, 4), rectangle(2, 2, 6, 6)};
  CHECK(area_of(offset_contours(crossing, -0.5)) ==
        doctest::Approx(2 * (3 * 3 - 2 * 2 + 0.25 * (1 - std::numbers::pi / 4))));
}

TEST_CASE("points of offsets are those within the distance") {
  Random random(7);
  for (int i = 0; i < 400; ++i) {
    // A star about the origin does not cross itself.
    Contour star;
    const int corners = 3 + i % 7;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + random.uniform(0.1, 0.9)) / corners;
      const double radius = random.uniform(0.3, 1);
      ProfilePoint corner{radius * std::cos(angle), radius * std::sin(angle)};
      if (random.one_in(3)) corner.bulge = random.uniform(-0.2, 0.6);
      star.push_back(corner);
    }
    Contours contours = {star};
    if (random.one_in(3)) contours.push_back(circle(0, 0, random.uniform(0.05, 0.2)));
    if (random.one_in(3)) contours.push_back(circle(random.uniform(0.5, 2), 0, 0.5));
    check_offset(contours, random.uniform(-0.4, 0.6), random, 2);
  }
}

TEST_CASE("offsets of what coincides in many places are right, too") {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    const auto whole = [&] { return std::floor(random.uniform(-3, 4)); };
    Contours contours;
    for (int k = 0; k <= i % 3; ++k) {
      const double left = whole();
      const double low = whole();
      contours.push_back(random.one_in(3) ? circle(left, low, 1)
                                          : rectangle(left, low, left + 1 + k, low + 2));
    }
    const double steps[] = {-1, -0.5, -0.25, 0.5, 1, 1.5};
    check_offset(contours, steps[i % 6], random, 5);
  }
}

TEST_CASE("distances and contours out of range are refused") {
  const Contours square = {rectangle(0, 0, 1, 1)};
  CHECK_THROWS_WITH_AS(offset_contours(square, std::nan("")), doctest::Contains("distance"), Error);
  CHECK_THROWS_WITH_AS(offset_contours(Contours{{{0, 0}, {1, 1}}}, 1),
                       doctest::Contains("contour 0"), Error);
}
