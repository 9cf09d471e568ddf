#include "core/contours/fill.hpp"

#include <doctest/doctest.h>

#include "contours/simple_contours.hpp"
#include "contours/winding_oracle.hpp"
#include "crt/error.hpp"

using namespace crt;
using namespace crt::core;
using namespace crt::test;

namespace {

using Contours = std::vector<Contour>;

Contour turned(Contour contour) {
  Contour result;
  for (std::size_t i = contour.size(); i-- > 0;) {
    const ProfilePoint& corner = contour[i];
    result.push_back({corner.x, corner.y, -contour[(i + 1) % contour.size()].bulge});
  }
  return result;
}

std::vector<Contour> nonzero(const std::vector<Contour>& contours) {
  return fill_contours(contours, WindingRule::nonzero);
}

/// Checks that points are inside of what is returned as the rule says of what is given.
void check_same_region(const std::vector<Contour>& given, WindingRule rule,
                       const std::vector<Contour>& returned, Random& random, int points,
                       double size, double margin) {
  for (int i = 0; i < points; ++i) {
    const Point point{random.uniform(-size, size), random.uniform(-size, size)};
    const View before(given, point);
    if (before.distance < margin) continue;
    const View after(returned, point);
    INFO(static_cast<double>(point.x), " ", static_cast<double>(point.y));
    CHECK(after.is_odd() == is_inside(rule, before.winding));
  }
}

Contour random_contour(Random& random) {
  Contour contour;
  const double corners = std::floor(random.uniform(3, 8));
  for (double i = 0; i < corners; ++i) {
    ProfilePoint corner{.x = random.uniform(-1, 1), .y = random.uniform(-1, 1)};
    if (random.one_in(2)) corner.bulge = random.uniform(-1.5, 1.5);
    if (random.one_in(8)) corner.bulge = random.uniform(-1e-3, 1e-3);
    contour.push_back(corner);
  }
  return contour;
}

/// Returns a contour with corners on a grid, so that much coincides.
Contour random_contour_of_grid(Random& random) {
  const auto whole = [&] { return std::floor(random.uniform(-3, 4)); };
  while (true) {
    Contour contour;
    const double corners = std::floor(random.uniform(3, 7));
    for (double i = 0; i < corners; ++i) {
      ProfilePoint corner{.x = whole(), .y = whole()};
      if (random.one_in(3)) corner.bulge = random.one_in(2) ? 1 : -1;
      if (contour.empty() || corner.x != contour.back().x || corner.y != contour.back().y) {
        contour.push_back(corner);
      }
    }
    const bool is_open =
        contour.front().x != contour.back().x || contour.front().y != contour.back().y;
    if (is_open && encloses_area(contour)) return contour;
  }
}

/// Returns one to three contours.
template <class Make>
std::vector<Contour> some_contours(Random& random, const Make& make) {
  std::vector<Contour> contours;
  const double count = std::floor(random.uniform(1, 4));
  for (double k = 0; k < count; ++k) contours.push_back(make(random));
  return contours;
}

/// Checks that the contours by the even-odd rule enclose what those given do by each rule.
void check_rules(const std::vector<Contour>& contours, Random& random, double size, double margin) {
  for (const WindingRule rule : {WindingRule::nonzero, WindingRule::odd, WindingRule::positive}) {
    const std::vector<Contour> returned = fill_contours(contours, rule);
    check_same_region(contours, rule, returned, random, 12, size, margin);
    if (!returned.empty()) CHECK_NOTHROW(make_profile(returned));
  }
}

}  // namespace

TEST_CASE("contours that do not meet stay as they are, or go as a whole") {
  const Contour outer = rectangle(0, 0, 10, 10);
  const Contour hole = turned(rectangle(1, 1, 9, 9));
  const Contour island = circle(5, 5, 2);
  const Contour beside = circle(20, 0, 3);
  CHECK(nonzero(Contours{outer, hole, island, beside}) == Contours{outer, hole, island, beside});
  CHECK(nonzero(Contours{outer, island}) == Contours{outer});
  CHECK(nonzero(Contours{island, hole, outer, rectangle(2, 2, 3, 3)}) ==
        Contours{island, hole, outer, rectangle(2, 2, 3, 3)});
  CHECK(nonzero(Contours{turned(outer), turned(island)}) == Contours{turned(outer)});
}

TEST_CASE("what several contours cover is one region") {
  const auto area = [](const std::vector<Contour>& contours) { return area_of(nonzero(contours)); };
  const Contour square = rectangle(0, 0, 2, 2);
  CHECK(area({square, rectangle(1, 1, 3, 3)}) == doctest::Approx(7));
  CHECK(area({square, rectangle(2, 0, 4, 2)}) == doctest::Approx(8));
  CHECK(area({square, square, square}) == doctest::Approx(4));
  CHECK(area({square, rectangle(0, 0, 1, 1)}) == doctest::Approx(4));
  CHECK(nonzero(Contours{square, turned(square)}).empty());
  const double pi = std::numbers::pi;
  CHECK(area({circle(0, 0, 1), circle(0, 0, 1)}) == doctest::Approx(pi));
  CHECK(area({circle(0, 0, 1), circle(2, 0, 1)}) == doctest::Approx(2 * pi));
  // Two circles of radius 1 at a distance of 1.
  const double lens = 2 * pi / 3 - std::sqrt(3.0) / 2;
  CHECK(area({circle(0, 0, 1), circle(1, 0, 1)}) == doctest::Approx(2 * pi - lens));
  // A star in one stroke is filled.
  Contour star;
  for (int i = 0; i < 5; ++i) star.push_back({std::cos(0.8 * pi * i), std::sin(0.8 * pi * i)});
  const double decagon = 5 * std::sin(0.2 * pi) * std::sqrt((7 - 3 * std::sqrt(5.0)) / 2);
  CHECK(area({star}) == doctest::Approx(decagon));
}

TEST_CASE("contours of any shape enclose the same region by the even-odd rule") {
  Random random(3);
  for (int i = 0; i < 250; ++i) {
    check_rules(some_contours(random, random_contour), random, 2, 2e-3);
  }
}

TEST_CASE("contours that touch and lie on each other enclose the same region") {
  Random random(4);
  for (int i = 0; i < 400; ++i) {
    check_rules(some_contours(random, random_contour_of_grid), random, 5, 1e-2);
  }
}

TEST_CASE("the place and size of contours do not matter") {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    std::vector<Contour> contours = {random_contour(random), random_contour(random)};
    const std::vector<Contour> here = nonzero(contours);
    const double scale = random.one_in(2) ? 0x1p-320 : 0x1p320;
    for (Contour& contour : contours) {
      for (ProfilePoint& corner : contour) {
        corner.x *= scale;
        corner.y *= scale;
      }
    }
    std::vector<Contour> there = nonzero(contours);
    REQUIRE(there.size() == here.size());
    for (std::size_t k = 0; k < here.size(); ++k) REQUIRE(there[k].size() == here[k].size());
  }
}

TEST_CASE("a contour that is next to nothing beside another is refused, not left out") {
  CHECK(nonzero(Contours{rectangle(-1e9, 0, 1e9, 1e9), rectangle(0, -1, 1, 1)}).size() >= 1);
  CHECK_THROWS_WITH_AS(nonzero(Contours{rectangle(-1e15, 0, 1e15, 1e15), rectangle(0, -1, 1, 1)}),
                       doctest::Contains("touch so closely"), Error);
}

TEST_CASE("many contours take no more than their share of time") {
  std::vector<Contour> apart;
  for (int i = 0; i < 20000; ++i) apart.push_back(circle(3 * (i % 100), 3 * (i / 100), 1));
  CHECK(nonzero(apart).size() == apart.size());
  std::vector<Contour> on_each_other;
  for (int i = 0; i < 10000; ++i) on_each_other.push_back(circle(1e-3 * i, 0, 1e3));
  CHECK_THROWS_WITH_AS(nonzero(on_each_other), doctest::Contains("too many pieces"), Error);
  std::uint64_t steps = 0;
  const auto work = [&](std::uint64_t more) {
    steps += more;
    if (steps > 10'000'000) throw Error(ErrorCode::cancelled, "enough");
  };
  CHECK_THROWS_WITH_AS(fill_contours(on_each_other, WindingRule::nonzero, work), "enough", Error);
  CHECK(steps < 12'000'000);
}

TEST_CASE("a contour with corners on one line encloses nothing") {
  CHECK_FALSE(encloses_area({}));
  CHECK_FALSE(encloses_area({{1, 2}}));
  CHECK_FALSE(encloses_area({{0, 0}, {1, 3}, {0, 0}, {2, 6}}));
  CHECK(encloses_area({{0, 0}, {1, 3}, {0, 0}, {2, 6.5}}));
  CHECK(encloses_area({{0, 0}, {1, 3, 0.1}}));
}
