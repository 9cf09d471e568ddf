#include "core/math/isolated_roots.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

using namespace crt::core;

namespace {

/// Requires that the roots of a product of x - root, times another factor, are isolated.
void check_roots(std::vector<double> roots, const DyadicPolynomial& factor) {
  DyadicPolynomial product = factor;
  for (const double root : roots) product = product * DyadicPolynomial({Dyadic(-root), Dyadic(1)});
  const IsolatedRoots isolated = isolated_roots(product);
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  REQUIRE(isolated.brackets.size() == roots.size());
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const auto& [low, high] = isolated.brackets[i];
    REQUIRE(isolated.polynomial.value(roots[i]).sign() == 0);
    REQUIRE((Dyadic(roots[i]) - low).sign() > 0);
    REQUIRE((high - Dyadic(roots[i])).sign() > 0);
    REQUIRE(isolated.polynomial.value(low).sign() * isolated.polynomial.value(high).sign() < 0);
    if (i > 0) REQUIRE((low - isolated.brackets[i - 1].high).sign() >= 0);
  }
}

}  // namespace

TEST_CASE("roots of any multiplicity are isolated by a polynomial that changes its sign there") {
  const DyadicPolynomial one({Dyadic(1)});
  const DyadicPolynomial without_roots({Dyadic(3), Dyadic(-2), Dyadic(1)});
  for (const auto& factor : {one, Dyadic(-0x1p300) * one, without_roots}) {
    check_roots({2, 2, 2, 2}, factor);
    check_roots({-1, -1, 3}, factor);
    check_roots({-1, -1, -1, 3}, factor);
    check_roots({0, 0, 1, 1}, factor);
    check_roots({1, 1 + 0x1p-50}, factor);
    check_roots({1, 1 + 0x1p-40, 1 + 0x1p-30, 1e30}, factor);
    check_roots({5, 5 + 0x1p-40, 5 + 0x1p-39, 5 + 0x1p-38}, factor);
    check_roots({0x1p-200, 1}, factor);
  }
  CHECK(isolated_roots(without_roots).brackets.empty());
}

TEST_CASE("roots of small whole numbers are isolated, however many are one") {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> roots(1 + random() % 4);
    for (double& root : roots) root = static_cast<double>(random() % 5) - 2;
    check_roots(roots, DyadicPolynomial({Dyadic(1)}));
  }
}

TEST_CASE("roots of quartics that all but coincide are isolated, far from 0 as well") {
  std::mt19937_64 random(2);
  const auto share = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const std::vector<DyadicPolynomial> factors = {
      DyadicPolynomial({Dyadic(1)}), DyadicPolynomial({Dyadic(5), Dyadic(-4), Dyadic(1)}),
      DyadicPolynomial({Dyadic(1), Dyadic(0), Dyadic(0x1p-70)})};
  for (int i = 0; i < 3000; ++i) {
    const double gap = std::ldexp(1 + share(), -static_cast<int>(random() % 52));
    const double begin = std::ldexp(share(), static_cast<int>(random() % 40) - 10);
    const DyadicPolynomial& factor = factors[random() % factors.size()];
    check_roots({begin, begin + gap * std::max(begin, 1.0)}, factor);
    check_roots({begin, begin + gap * std::max(begin, 1.0), -begin, 3},
                DyadicPolynomial({Dyadic(-1)}));
  }
}

TEST_CASE("polynomials of small numbers have as many roots as Sturm's theorem counts") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::vector<Dyadic> coefficients(2 + random() % 4);
    for (Dyadic& coefficient : coefficients) {
      coefficient = static_cast<double>(random() % 9) - 4;
    }
    const DyadicPolynomial polynomial(std::move(coefficients));
    if (polynomial.degree() < 1) continue;
    const IsolatedRoots isolated = isolated_roots(polynomial);
    REQUIRE(isolated.brackets.size() == static_cast<std::size_t>(SturmChain(polynomial).count()));
    for (const auto& [low, high] : isolated.brackets) {
      REQUIRE(SturmChain(isolated.polynomial).count(low, high) == 1);
    }
  }
}

TEST_CASE("two roots beside a place that double-doubles do not tell from them are isolated") {
  for (const int exponent : {-60, -150, -200, -208, -250, -400}) {
    CAPTURE(exponent);
    for (const int sign : {-1, 1}) {
      const Dyadic middle = 1.0 / 3;
      const Dyadic off(std::ldexp(sign, exponent));
      const DyadicPolynomial pair({square(middle) + off, Dyadic(-2) * middle, Dyadic(1)});
      const IsolatedRoots isolated =
          isolated_roots(pair * DyadicPolynomial({Dyadic(-2), Dyadic(0), Dyadic(1)}));
      REQUIRE(isolated.brackets.size() == (sign < 0 ? 4 : 2));
      for (const auto& [low, high] : isolated.brackets) {
        REQUIRE(SturmChain(isolated.polynomial).count(low, high) == 1);
      }
      if (sign > 0) continue;
      // The parabola has its root between both ends.
      const auto& [low, high] = isolated.brackets[1];
      REQUIRE((middle - high).sign() > 0);
      REQUIRE((square(middle - high) + off).sign() < 0);
      REQUIRE((square(middle - low) + off).sign() > 0);
    }
  }
}
