// These tests compare the quick numbers of the oracle with MPFR: all give the same truth, and no
// wrong answer passes.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "oracle/equations.hpp"
#include "oracle/measure.hpp"

using namespace crt::test;

namespace {

/// Returns a double of any of many sizes, now and then 0 or a small whole number.
double random_double(Counted& random) {
  const int form = random.integer(0, 9);
  if (form == 0) return 0;
  if (form == 1) return random.integer(-4, 4);
  return random.uniform(-1, 1) * random.power_of_ten(-12, 12);
}

template <std::size_t parts>
bool holds(const Ball<parts>& ball, const Interval& truth) {
  Interval middle(0.0);
  for (std::size_t i = 0; i < parts; ++i) middle = middle + Interval(ball.part(i));
  const Interval distance = magnitude(truth - middle);
  return !Interval(ball.radius()).surely_below(distance) || std::isnan(ball.radius());
}

template <std::size_t parts>
void check_arithmetic() {
  constexpr std::uint64_t rounds = 20'000;
  Bits::now = 2048;
  for (std::uint64_t number = 0; number < rounds; ++number) {
    Counted random(200 + parts, number);
    Ball<parts> ball(random_double(random));
    Interval truth(ball.value());
    for (int step = 0; step < 6; ++step) {
      const double next = random_double(random);
      // Now and then the operand cancels nearly all.
      const double operand = random.integer(0, 3) == 0 ? -ball.value() : next;
      switch (random.integer(0, 4)) {
        case 0:
          ball = ball + Ball<parts>(operand);
          truth = truth + Interval(operand);
          break;
        case 1:
          ball = ball * (Ball<parts>(next) + Ball<parts>(operand));
          truth = truth * (Interval(next) + Interval(operand));
          break;
        case 2:
          if (next == 0) break;
          ball = ball / Ball<parts>(next);
          truth = truth / Interval(next);
          break;
        case 3:
          if (ball.certain_sign() <= 0) break;
          ball = sqrt(ball);
          truth = sqrt(truth);
          break;
        default:
          ball = square(ball) - Ball<parts>(next) * ball;
          truth = square(truth) - Interval(next) * truth;
      }
      CAPTURE(number);
      CAPTURE(step);
      REQUIRE(holds(ball, truth));
      if (ball.certain_sign() != 0) REQUIRE(ball.certain_sign() == truth.certain_sign());
    }
  }
  Bits::now = Bits::lowest;
}

bool agree(const TrueLine& a, const TrueLine& b) {
  if (a.inside_before != b.inside_before || a.crossings.size() != b.crossings.size()) return false;
  for (std::size_t i = 0; i < a.crossings.size(); ++i) {
    const TrueCrossing& one = a.crossings[i];
    const TrueCrossing& other = b.crossings[i];
    if (one.entering != other.entering || one.at_edge != other.at_edge) return false;
    if ((one.t - other.t).certain_sign() != 0) return false;
    if (std::abs(one.approach - other.approach) > 0x1p-20 * one.approach) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("sums of a few doubles hold what MPFR computes") {
  check_arithmetic<2>();
  check_arithmetic<3>();
  check_arithmetic<4>();
}

TEST_CASE("the truth about a ray is the same from all numbers") {
  constexpr std::uint64_t rays = 2'000;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    for (std::uint64_t number = 0; number < rays; ++number) {
      const TestRay ray = make_ray(kind, number);
      const TrueLine quick = truth_of(ray).line;
      const TrueLine slow = truth_of(ray, FirstTry::mpfr).line;
      if (!agree(quick, slow)) {
        FAIL_CHECK(fmt::format("ray {}: {}", number, description(ray)));
      }
    }
  }
}
