// Threads have the numbers of ISO 68-1 and of ISO 724, which lists their diameters.
#include "crt/thread.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "crt/measure.hpp"
#include "csg/made_solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Returns how far from the axis the thread's surface is, along z, at an angle from x towards y.
double radius_at(const Entity& thread, double z, double angle) {
  double inside = 0;
  double outside = 100;
  for (int step = 0; step < 60; ++step) {
    const double radius = 0.5 * (inside + outside);
    const Vec3 place(radius * std::cos(angle), radius * std::sin(angle), z);
    (contains(thread, place) == PointSide::inside ? inside : outside) = radius;
  }
  return inside;
}

}  // namespace

TEST_CASE("diameters of a thread are those of ISO 724") {
  struct Size {
    double diameter;
    double pitch;
    double middle;  // the pitch diameter, where tooth and gap are as wide
    double inner;   // the minor diameter
  };
  for (const Size& size : {Size{3, 0.5, 2.675, 2.459}, Size{8, 1.25, 7.188, 6.647},
                           Size{12, 1.75, 10.863, 10.106}, Size{24, 3, 22.051, 20.752}}) {
    CAPTURE(size.diameter);
    const Entity thread = Thread{.from = {0, 0, 0},
                                 .to = {0, 0, 10 * size.pitch},
                                 .diameter = size.diameter,
                                 .pitch = size.pitch};
    // Crests along x are at whole turns.
    const double crest = 5 * size.pitch;
    CHECK(2 * radius_at(thread, crest, 0) == doctest::Approx(size.diameter));
    CHECK(2 * radius_at(thread, crest + size.pitch / 17, 0) == doctest::Approx(size.diameter));
    CHECK(2 * radius_at(thread, crest + 0.5 * size.pitch, 0) ==
          doctest::Approx(size.inner).epsilon(1e-4));
    CHECK(2 * radius_at(thread, crest + 0.5 * size.pitch - size.pitch / 9, 0) ==
          doctest::Approx(size.inner).epsilon(1e-4));
    CHECK(2 * radius_at(thread, crest + 0.25 * size.pitch, 0) ==
          doctest::Approx(size.middle).epsilon(1e-4));
    CHECK(2 * radius_at(thread, crest - 0.25 * size.pitch, 0) ==
          doctest::Approx(size.middle).epsilon(1e-4));
  }
}

TEST_CASE("a thread turns as usual, and a left one the other way") {
  // x is to the right, z up on the paper, and y points away from who turns the screw in along it.
  // So clockwise is from z towards x, and a quarter of a turn leads a quarter of the pitch.
  for (const bool left : {false, true}) {
    const Entity thread =
        Thread{.from = {0, 0, 0}, .to = {0, 10, 0}, .diameter = 8, .pitch = 2, .left = left};
    const double side = left ? -1 : 1;
    // Angles begin along z.
    CHECK(contains(thread, {0, 4, 3.99}) == PointSide::inside);
    CHECK(contains(thread, {-side * 3.99, 4.5, 0}) == PointSide::inside);
    CHECK(contains(thread, {side * 3.99, 4.5, 0}) == PointSide::outside);
    CHECK(contains(thread, {0, 5, -3.99}) == PointSide::inside);
  }
}

TEST_CASE("a thread cuts a nut, and has flat ends anywhere") {
  const Vec3 from(1, 2, 3);
  const Vec3 along(0.36, 0.48, 0.8);
  const Entity thread = Thread{.from = from, .to = from + 4.0 * along, .diameter = 2, .pitch = 0.4};
  CHECK(contains(thread, from + 0.01 * along) == PointSide::inside);
  CHECK(contains(thread, from - 0.01 * along) == PointSide::outside);
  CHECK(contains(thread, from + 3.99 * along) == PointSide::inside);
  CHECK(contains(thread, from + 4.01 * along) == PointSide::outside);
  const Entity nut =
      Entity(Box{.corner_a = {-2, -2, 0}, .corner_b = {2, 2, 1}}) -
      Entity(Thread{.from = {0, 0, -1}, .to = {0, 0, 2}, .diameter = 2, .pitch = 0.4});
  CHECK(contains(nut, {1.01, 0, 0.5}) == PointSide::inside);
  CHECK(contains(nut, {0.7, 0, 0.5}) == PointSide::outside);
  // The volume is that of what it has on the average of a turn, of any turn.
  const double pitch = 0.4;
  const double height = 0.5 * std::sqrt(3.0) * pitch;
  const double outer = 1;
  const double inner = outer - 5.0 / 8 * height;
  const double of_flanks = (outer * outer + outer * inner + inner * inner) / 3;
  const double mean = outer * outer / 8 + inner * inner / 4 + of_flanks * 5 / 8;
  const Entity turn = Thread{.to = {0, 0, pitch}, .diameter = 2, .pitch = pitch};
  CHECK(volume(turn, {.relative_width = 0.1}).contains(pi * mean * pitch));
}

TEST_CASE("what a thread can't be is said") {
  CHECK(fault_of(Thread{.diameter = 1, .pitch = 1}) == "pitch must be at most 0.9 diameters");
  CHECK(fault_of(Thread{.to = {0, 0, 1e5}}) == "pitch must be at least a 10000th of the length");
  CHECK(fault_of(Thread{.diameter = 0}).find("diameter") == 0);
  CHECK(fault_of(Thread{.to = {0, 0, 0}}).find("to must differ from from") == 0);
}
