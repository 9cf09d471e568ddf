// Double-double arithmetic is compared with quadruple precision, which has a few more bits.
#include "core/math/double_double.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/math/vector.hpp"
#include "support/quad.hpp"

using namespace crt::core;

namespace {

using Real = crt::test::Quad;

Real exact(const DoubleDouble& a) {
  return Real(a.hi) + Real(a.lo);
}
Real magnitude(Real x) {
  return x < 0 ? -x : x;
}

class Numbers {
 public:
  double next() {
    const double mantissa = std::uniform_real_distribution<double>(-1, 1)(engine_);
    return std::ldexp(mantissa, std::uniform_int_distribution<int>(-40, 40)(engine_));
  }
  DoubleDouble next_pair() {
    const double high = next();
    return quick_two_sum(high,
                         high * std::uniform_real_distribution<double>(-0x1p-54, 0x1p-54)(engine_));
  }

 private:
  std::mt19937_64 engine_{42};
};

constexpr int rounds = 200000;
const Real u = 0x1p-53;

}  // namespace

TEST_CASE("sums and products of two doubles lose nothing") {
  Numbers numbers;
  for (int i = 0; i < rounds; ++i) {
    const double a = numbers.next();
    const double b = numbers.next();
    REQUIRE(exact(two_product(a, b)) == Real(a) * Real(b));
    const double large = std::abs(a) > std::abs(b) ? a : b;
    const double small = std::abs(a) > std::abs(b) ? b : a;
    // The sum may need more bits than quadruple precision has, but its parts do not.
    const DoubleDouble sum = two_sum(a, b);
    REQUIRE(sum.hi == a + b);
    REQUIRE(Real(large) - Real(sum.hi) + Real(small) == Real(sum.lo));
    REQUIRE(quick_two_sum(large, small).lo == two_sum(large, small).lo);
  }
}

TEST_CASE("double-double operations keep the proven bounds") {
  Numbers numbers;
  // By Joldes, Muller, Popescu 2017 the bounds are 3u^2 + 13u^3 for the sum, 5u^2 for the product,
  // and 15u^2 for the quotient.
  const Real slack = 1 + 0x1p-4;  // quadruple precision is itself rounded
  for (int i = 0; i < rounds; ++i) {
    const DoubleDouble a = numbers.next_pair();
    const DoubleDouble b = numbers.next_pair();
    const Real sum = exact(a) + exact(b);
    REQUIRE(magnitude(exact(a + b) - sum) <=
            slack * 3 * u * u * magnitude(sum) + 0x1p-112 * magnitude(exact(a)));
    const Real difference = exact(a) - exact(b);
    REQUIRE(magnitude(exact(a - b) - difference) <=
            slack * 3 * u * u * magnitude(difference) + 0x1p-112 * magnitude(exact(a)));
    const Real product = exact(a) * exact(b);
    REQUIRE(magnitude(exact(a * b) - product) <= slack * 5 * u * u * magnitude(product));
    const Real quotient = exact(a) / exact(b);
    REQUIRE(magnitude(exact(a / b) - quotient) <= slack * 15 * u * u * magnitude(quotient));
    const DoubleDouble positive = a.hi > 0 ? a : -a;
    const DoubleDouble root = sqrt(positive);
    REQUIRE(magnitude(exact(root) * exact(root) - exact(positive)) <= 16 * u * u * exact(positive));
  }
}

TEST_CASE("double-double numbers stay normalised") {
  Numbers numbers;
  for (int i = 0; i < rounds; ++i) {
    const DoubleDouble a = numbers.next_pair();
    const DoubleDouble b = numbers.next_pair();
    for (const DoubleDouble& result : {a + b, a - b, a * b, a / b})
      REQUIRE(result.hi + result.lo == result.hi);
  }
}

TEST_CASE("differences of products and cross products keep their digits when they cancel") {
  Numbers numbers;
  for (int i = 0; i < rounds; ++i) {
    const double a = numbers.next();
    const double b = numbers.next();
    const double c = a * (1 + 0x1p-60 * numbers.next());
    const double d = b * (1 + 0x1p-60 * numbers.next());
    const Real difference = Real(a) * Real(b) - Real(c) * Real(d);
    REQUIRE(magnitude(difference_of_products(a, b, c, d) - difference) <=
            2 * u * magnitude(difference));
  }
}

TEST_CASE("dot products are as good as in twice the precision") {
  Numbers numbers;
  for (int i = 0; i < rounds; ++i) {
    const crt::Vec3 a(numbers.next(), numbers.next(), numbers.next());
    const crt::Vec3 b(numbers.next(), numbers.next(), numbers.next());
    const Real x = Real(a.x) * Real(b.x);
    const Real y = Real(a.y) * Real(b.y);
    const Real z = Real(a.z) * Real(b.z);
    const Real condition = magnitude(x) + magnitude(y) + magnitude(z);
    REQUIRE(magnitude(exact(accurate_dot(a, b)) - (x + y + z)) <= 16 * u * u * condition);
  }
}

TEST_CASE("the power of two below a number brings it into [1, 2)") {
  Numbers numbers;
  for (int i = 0; i < rounds; ++i) {
    const double x = std::abs(numbers.next());
    const double scaled = x / power_of_two_below(x);
    REQUIRE(scaled >= 1);
    REQUIRE(scaled < 2);
  }
  CHECK(power_of_two_below(1) == 1);
  CHECK(power_of_two_below(1e300) == std::ldexp(1.0, std::ilogb(1e300)));
  CHECK(power_of_two_below(5e-324) == 0x1p-1022);
  CHECK(std::isfinite(1 / power_of_two_below(5e-324)));
  CHECK(1 / power_of_two_below(1.7e308) > 0);
}

TEST_CASE("unit vectors have length 1 whatever they are made of, and axes are exact") {
  Numbers numbers;
  for (int i = 0; i < rounds / 10; ++i) {
    const crt::Vec3 v(numbers.next(), numbers.next(), numbers.next());
    for (const double scale : {0x1p-900, 1.0, 0x1p900}) {
      const crt::Vec3 n = unit_vector(v * scale);
      const Real squared = Real(n.x) * n.x + Real(n.y) * n.y + Real(n.z) * n.z;
      REQUIRE(magnitude(squared - 1) <= 6 * u);
    }
  }
  CHECK(unit_vector(crt::Vec3(0, -7, 0)) == crt::Vec3(0, -1, 0));
  CHECK(coordinate_axis({0, -7, 0}) == 1);
  CHECK(coordinate_axis({1e-300, -7, 0}) == -1);
}
