#include "core/math/dyadic.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

using crt::core::DoubleDouble;
using crt::core::Dyadic;
using crt::core::ScaledNumber;

namespace {

/// Returns a double of any size that makes sense, and sometimes 0 or a small whole number.
double any_double(std::mt19937_64& random) {
  if (random() % 4 == 0) return static_cast<double>(random() % 5) - 2;
  const double fraction = static_cast<double>(static_cast<std::int64_t>(random()) >> 8);
  return std::ldexp(fraction, static_cast<int>(random() % 1800) - 900);
}

}  // namespace

TEST_CASE("what a Dyadic is made of comes out again") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const double x = any_double(random);
    REQUIRE(Dyadic(x).rounded().unscaled().hi == x);
    REQUIRE(Dyadic(x).rounded().unscaled().lo == 0);
    REQUIRE(Dyadic(x).sign() == (x > 0) - (x < 0));
  }
  for (const double x :
       {std::numeric_limits<double>::max(), std::numeric_limits<double>::min(),
        std::numeric_limits<double>::denorm_min(), -0.0, 0x1p63, 0x1p64, -0x1p-64}) {
    CHECK(Dyadic(x).rounded().unscaled().hi == x);
  }
}

TEST_CASE("Dyadic arithmetic is that of whole numbers") {
  __extension__ using Wide = __int128;
  std::mt19937_64 random(2);
  const auto exact = [](Wide whole) {
    const auto high = static_cast<std::int64_t>(whole >> 40);
    return Dyadic(std::ldexp(static_cast<double>(high), 40)) +
           Dyadic(static_cast<double>(static_cast<std::int64_t>(whole - (Wide{high} << 40))));
  };
  for (int i = 0; i < 20000; ++i) {
    const auto a = static_cast<std::int64_t>(random()) >> (12 + random() % 50);
    const auto b = static_cast<std::int64_t>(random()) >> (12 + random() % 50);
    const Dyadic x(static_cast<double>(a));
    const Dyadic y(static_cast<double>(b));
    // Two products of 52 bits fill what exact() can take apart: 40 low bits and a double of the
    // others.
    const Wide product = (Wide{a} >> 8) * (b >> 8);
    REQUIRE(
        (Dyadic(static_cast<double>(a >> 8)) * Dyadic(static_cast<double>(b >> 8)) - exact(product))
            .sign() == 0);
    REQUIRE((x + y - Dyadic(static_cast<double>(a + b))).sign() == 0);
    REQUIRE((x - y).sign() == (a > b) - (a < b));
  }
}

TEST_CASE("identities of algebra hold exactly for doubles of very different sizes") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 5000; ++i) {
    const Dyadic a(any_double(random));
    const Dyadic b(any_double(random));
    const Dyadic c(any_double(random));
    REQUIRE((a * (b + c) - (a * b + a * c)).sign() == 0);
    REQUIRE((square(a + b) - (square(a) + a * b + a * b + square(b))).sign() == 0);
    REQUIRE(((a + b) * (a - b) - (square(a) - square(b))).sign() == 0);
    REQUIRE((a + b + c - c - b - a).sign() == 0);
  }
}

TEST_CASE("a difference far below a double's rounding has the right sign") {
  const Dyadic one = 1;
  const Dyadic tiny(0x1p-1000);
  CHECK((square(one + tiny) - one - tiny - tiny).sign() == 1);
  CHECK((square(one + tiny) - one - tiny - tiny - square(tiny)).sign() == 0);
  CHECK((one - square(one - tiny) - tiny - tiny).sign() == -1);
  // These are beyond the range of doubles.
  const Dyadic huge(0x1p1000);
  CHECK((huge * huge * huge - huge * huge).sign() == 1);
  CHECK((huge * huge * tiny * tiny - one).sign() == 0);
}

TEST_CASE("rounding keeps a hundred bits, beyond the range of doubles too") {
  const Dyadic third_power = Dyadic(0x1p1000) * Dyadic(0x1p1000) * (Dyadic(1) + Dyadic(0x1p-90));
  const ScaledNumber rounded = third_power.rounded();
  CHECK(rounded.value.hi == 0.5);
  CHECK(rounded.value.lo == 0x1p-91);
  CHECK(rounded.exponent == 2001);
  const ScaledNumber root = sqrt(Dyadic(0x1.1p601).rounded());
  const ScaledNumber square = Dyadic(root.unscaled().hi).rounded();
  CHECK(square.unscaled().hi == std::sqrt(0x1.1p601));
  const DoubleDouble quotient = (Dyadic(1).rounded() / Dyadic(3).rounded()).unscaled();
  CHECK(std::abs(std::fma(quotient.hi, 3, -1) + 3 * quotient.lo) < 0x1p-100);
}
