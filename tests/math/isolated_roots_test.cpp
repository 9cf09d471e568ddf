#include "core/math/isolated_roots.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>
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
