// What is taken away in an entity is listed at its place.
#include "crt/cutters.hpp"

#include <doctest/doctest.h>

using namespace crt;

namespace {

constexpr std::size_t plenty = 1000;

Entity ball(double x) {
  return Sphere{.center = {x, 0, 0}, .radius = 0.5};
}

double middle_of(const Entity& entity) {
  const BoundingBox box = bounding_box(entity);
  return (box.lower.x + box.upper.x) / 2;
}

}  // namespace

TEST_CASE("all parts of a difference but the first are its cutters, in their order") {
  const std::vector<Entity> tools = {ball(1), ball(2), ball(3)};
  const std::vector<Entity> found = cutters(csg_difference(Box{}, tools), plenty);
  REQUIRE(found.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(middle_of(found[i]) == doctest::Approx(static_cast<double>(i) + 1));
}

TEST_CASE("cutters are found in unions, intersections and what is cut again, and no others") {
  CHECK(cutters(ball(1), plenty).empty());
  CHECK(cutters(ball(1) + ball(2), plenty).empty());
  CHECK(cutters(ball(1) ^ ball(1.5), plenty).empty());
  const Entity cut = Box{} - ball(1);
  CHECK(cutters(cut + ball(7), plenty).size() == 1);
  CHECK(cutters(cut ^ ball(0), plenty).size() == 1);
  CHECK(cutters(cut - ball(2), plenty).size() == 2);
  CHECK(cutters(Box{} - (ball(1) - ball(1.2)), plenty).size() == 1);
}

TEST_CASE("cutters are where their solid is moved to, from the inside outwards") {
  const Entity cut = (Box{} - ball(1)).transformed(scale(2)).with_id(7);
  const Entity moved = (cut + ball(0)).transformed(translate({10, 0, 0}));
  const std::vector<Entity> found = cutters(moved, plenty);
  REQUIRE(found.size() == 1);
  CHECK(middle_of(found[0]) == doctest::Approx(12));
}

TEST_CASE("solids that hold others often are searched as far as was asked for") {
  Entity many = Box{} - ball(1);
  for (int i = 0; i < 60; ++i) many = many + many.transformed(translate({0, 1, 0}));
  CHECK(cutters(many, 10).size() <= 10);
  Entity deep = Box{};
  for (int i = 0; i < 100000; ++i) deep = deep - ball(i);
  CHECK(cutters(deep, 5).size() <= 5);
  CHECK(cutters(deep, 0).empty());
}
