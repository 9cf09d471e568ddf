#include "core/geometry/implicit/profile_distance.hpp"

#include <doctest/doctest.h>

#include "contours/winding_oracle.hpp"
#include "crt/error.hpp"
#include "crt/field.hpp"
#include "crt/query.hpp"
#include "crt/svg_path.hpp"

using namespace crt;
using namespace crt::core;
using crt::test::Point;
using crt::test::Random;
using crt::test::View;

namespace {

using Contours = std::vector<Contour>;

/// Returns a star about a point with straight and round pieces, which does not cross itself.
Contour star(Random& random, double x, double y) {
  Contour result;
  const int corners = 3 + static_cast<int>(random.uniform(0, 6));
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * (k + random.uniform(0.3, 0.7)) / corners;
    const double radius = random.uniform(0.5, 1);
    ProfilePoint corner{x + radius * std::cos(angle), y + radius * std::sin(angle)};
    if (random.one_in(3)) corner.bulge = random.uniform(0.02, 0.3);
    result.push_back(corner);
  }
  return result;
}

double true_distance(const Contours& contours, double x, double y) {
  const View view(contours, Point{x, y});
  return static_cast<double>(view.is_odd() ? -view.distance : view.distance);
}

const Contours& smooth_slot() {
  static const Contours slot = {{{-2, -1}, {2, -1}, {2, 1, 1}, {-2, 1}, {-2, -1, 1}}};
  return slot;
}

}  // namespace

TEST_CASE("distances and slopes of a box hold those of its points") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    Contours contours = {star(random, 0, 0)};
    if (i % 2 == 0) contours.push_back(star(random, 3, 1));
    if (i % 8 == 0) contours = smooth_slot();
    const ProfileDistance distance(make_profile(contours));
    const double x = random.uniform(-2.5, 4);
    const double y = random.uniform(-2.5, 2.5);
    const double size = std::pow(10, random.uniform(-9, 0));
    const auto at = [&](double a, double b) { return Interval{a, b}; };
    const ProfileDistance::Values values =
        distance.evaluate({at(x, x), at(y, y)}, {at(x - size, x + size), at(y - size, y + size)});
    // The oracle sees arcs by chords where it tells inside from outside.
    const double middle = true_distance(contours, x, y);
    if (std::abs(middle) < 2e-3 + 2 * size) continue;
    CHECK(values.middle.width() < 1e-11);
    CHECK(values.middle.contains(middle) == true);
    CHECK(values.all.width() <= 2.9 * size + 1e-12);
    double before = middle;
    Vec2 place(x, y);
    for (int k = 0; k < 20; ++k) {
      const Vec2 next(x + random.uniform(-size, size), y + random.uniform(-size, size));
      const double there = true_distance(contours, next.x, next.y);
      CHECK(values.all.contains(there));
      const Interval change = values.slope_x * Interval::of(next.x - place.x) +
                              values.slope_y * Interval::of(next.y - place.y);
      CHECK(change.lo - 1e-14 <= there - before);
      CHECK(there - before <= change.hi + 1e-14);
      before = there;
      place = next;
    }
  }
}

TEST_CASE("next to a piece or a smooth joint the slope is the normal, at a corner between both") {
  const ProfileDistance square(make_profile(Contours{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}));
  const auto slopes = [](const ProfileDistance& distance, double x, double y, double size) {
    return distance.evaluate({Interval::of(x), Interval::of(y)},
                             {Interval{x - size, x + size}, Interval{y - size, y + size}});
  };
  const auto right = slopes(square, 4, 2, 0.1);
  CHECK(right.slope_x.lo > 1 - 1e-12);
  CHECK(right.slope_y.width() < 1e-12);
  const auto corner = slopes(square, 4, 4, 0.1);
  CHECK(corner.slope_x.lo > -1e-12);
  CHECK(corner.slope_x.hi == 1);
  CHECK(corner.slope_y.lo > -1e-12);
  const ProfileDistance slot(make_profile(smooth_slot()));
  const auto joint = slopes(slot, 2, 1, 1e-3);
  CHECK(joint.slope_y.lo > 0.99);
  CHECK(joint.slope_x.magnitude() < 0.01);
}

TEST_CASE("what is within a distance of a profile is a solid that rays meet") {
  const auto profile = make_profile(smooth_slot());
  const Field distance = profile_distance(profile, Field::x(), Field::y());
  // A rounded bar: a torus at its ends, a plane in between.
  const Field level = abs(Field::z()) - 0.5;
  const auto positive = [](const Field& f) { return max(f, 0); };
  const Field field =
      sqrt(pow(positive(distance + 0.25), 2) + pow(positive(level + 0.25), 2)) - 0.25;
  Scene scene;
  scene.entities = {Implicit{.field = field, .lower = {-4, -2, -1}, .upper = {4, 2, 1}}};
  const PreparedScene prepared = prepare(scene);
  const auto t = [&](const Vec3& origin, const Vec3& direction) {
    const auto hit = intersect(prepared, {.origin = origin, .direction = direction});
    return hit ? hit->t : -1;
  };
  CHECK(t({0, 0, -3}, {0, 0, 1}) == doctest::Approx(2.5).epsilon(1e-12));
  CHECK(t({0, -5, 0}, {0, 1, 0}) == doctest::Approx(4).epsilon(1e-12));
  CHECK(t({9, 0, 0}, {-1, 0, 0}) == doctest::Approx(6).epsilon(1e-12));
  // The edge is rounded: a ray at 45 degrees through its middle.
  CHECK(t({0, -3.75, -3.25}, {0, 1, 1}) ==
        doctest::Approx(3 - 0.25 / std::sqrt(2.0)).epsilon(1e-9));
  CHECK(t({0, 1.01, -3}, {0, 0, 1}) == -1);
}

TEST_CASE("profiles whose distance has no meaning are refused") {
  const auto refuses = [](const Contours& contours, const char* why) {
    CHECK_THROWS_WITH_AS(profile_distance(make_profile(contours), Field::x(), Field::y()),
                         doctest::Contains(why), Error);
  };
  const Contour square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  refuses({square, {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}, "cross or touch");
  refuses({square, {{2, 0}, {3, 0}, {3, 3}, {2, 3}}}, "cross or touch");
  refuses({{{0, 0}, {2, 2}, {2, 0}, {0, 2}}}, "cross or touch");
  refuses({square, {{1, 0, 1}, {1, 1, 1}}}, "cross or touch");
  CHECK_THROWS_WITH_AS(profile_distance(nullptr, Field::x(), Field::y()),
                       doctest::Contains("profile must be given"), Error);
  Contour many;
  for (int i = 0; i < 5000; ++i)
    many.push_back(
        {std::cos(2e-3 * std::numbers::pi / 5 * i), std::sin(2e-3 * std::numbers::pi / 5 * i)});
  refuses({many}, "at most 4096 pieces");
}
