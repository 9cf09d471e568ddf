#include "core/math/real_root.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace crt::core;

namespace {

/// Returns x^2 - c.
DyadicPolynomial square_less(const Dyadic& c) {
  return DyadicPolynomial({-c, 0, 1});
}
DyadicPolynomial line_through(const Dyadic& root) {
  return DyadicPolynomial({-root, 1});
}
/// Returns 2 to a power that may be beyond the range of doubles.
Dyadic power_of_two(int exponent) {
  Dyadic result = 1;
  for (; exponent <= -1000; exponent += 1000) result = result * Dyadic(0x1p-1000);
  return result * Dyadic(std::ldexp(1.0, exponent));
}

RealRoot last_root(const DyadicPolynomial& polynomial) {
  return *RealRoot::of_index(polynomial, 99);
}

}  // namespace

TEST_CASE("roots are one if they are so by other equations, too") {
  const DyadicPolynomial two = square_less(2);
  // (x^2 - 2)(x^2 - 3) has the root of 2 as its third.
  RealRoot a = last_root(two);
  RealRoot b = *RealRoot::of_index(two * square_less(3), 2);
  CHECK(order(a, b) == 0);
  CHECK(order(b, a) == 0);
  // (x^2 - 2)^2 and (x^2 - 2)^3 have it with other multiplicities.
  RealRoot c = last_root(two * two);
  RealRoot d = last_root(two * two * two);
  CHECK(order(a, c) == 0);
  CHECK(order(c, d) == 0);
  RealRoot e = *RealRoot::of_index(two, 0);
  CHECK(order(e, c) == -1);
  // This is 3 as it is, and as a root of x^2 - 9.
  RealRoot three = RealRoot::at(3);
  RealRoot root = last_root(square_less(9));
  CHECK(order(three, root) == 0);
  CHECK(order(root, three) == 0);
}

TEST_CASE("roots are separated however close they are") {
  for (const int exponent : {-10, -100, -200, -1000, -5000}) {
    CAPTURE(exponent);
    const Dyadic little = power_of_two(exponent);
    RealRoot a = last_root(square_less(2));
    RealRoot b = last_root(square_less(Dyadic(2) + little));
    CHECK(order(a, b) == -1);
    CHECK(order(b, a) == 1);
    RealRoot c = last_root(line_through(3));
    RealRoot d = last_root(line_through(Dyadic(3) + little));
    CHECK(order(c, d) == -1);
    CHECK(order(d, c) == 1);
    RealRoot e = last_root(square_less(Dyadic(9) - little));
    CHECK(order(e, c) == -1);
    CHECK(order(c, e) == 1);
    // These are both roots of one equation: (x - 3)(x - 3 - little).
    const DyadicPolynomial both = line_through(3) * line_through(Dyadic(3) + little);
    if (exponent < -300) continue;  // which root_separators() does not separate
    RealRoot first = *RealRoot::of_index(both, 0);
    RealRoot second = *RealRoot::of_index(both, 1);
    CHECK(order(first, second) == -1);
    CHECK(order(first, c) == 0);
    CHECK(order(second, c) == 1);
  }
}

TEST_CASE("a root is found by where it nearly is, if it is alone there") {
  const DyadicPolynomial polynomial = line_through(1) * line_through(Dyadic(1) + power_of_two(-60));
  CHECK_FALSE(RealRoot::near(polynomial, 1.0, 0x1p-50));
  std::optional<RealRoot> one = RealRoot::near(polynomial, 1.0, 0x1p-70);
  REQUIRE(one);
  RealRoot exactly = RealRoot::at(1);
  CHECK(order(*one, exactly) == 0);
  CHECK_FALSE(RealRoot::near(polynomial, 2.0, 0x1p-70));
  CHECK(RealRoot::near(polynomial, 1.0, 0));
  CHECK_FALSE(RealRoot::near(polynomial, 2.0, 0));
}

TEST_CASE("a number is found between two roots, and a root is rounded to 100 bits") {
  for (const int exponent : {-10, -100, -1000}) {
    CAPTURE(exponent);
    RealRoot a = last_root(square_less(2));
    RealRoot b = last_root(square_less(Dyadic(2) + power_of_two(exponent)));
    const Dyadic middle = RealRoot::between(a, b);
    CHECK((square(middle) - Dyadic(2)).sign() > 0);
    CHECK((square(middle) - Dyadic(2) - power_of_two(exponent)).sign() < 0);
    CHECK((square(a.below()) - Dyadic(2)).sign() < 0);
    CHECK((square(b.above()) - Dyadic(2) - power_of_two(exponent)).sign() > 0);
  }
  for (const double size : {0x1p-600, 1.0, 0x1p600}) {
    CAPTURE(size);
    const DoubleDouble root = last_root(square_less(Dyadic(2 * size) * Dyadic(size))).rounded();
    const Dyadic rounded = Dyadic(root.hi) + Dyadic(root.lo);
    const Dyadic off = square(rounded) - Dyadic(2 * size) * Dyadic(size);
    CHECK((off + Dyadic(0x1p-99 * size) * Dyadic(size)).sign() > 0);
    CHECK((off - Dyadic(0x1p-99 * size) * Dyadic(size)).sign() < 0);
  }
  CHECK(RealRoot::of_index(DyadicPolynomial({0, -3, 0, 1}), 1)->rounded().hi == 0);
  CHECK(RealRoot::at(-5).rounded().hi == -5);
}
