#include "core/math/dyadic_polynomial.hpp"

#include <doctest/doctest.h>

using namespace crt::core;

namespace {

/// Returns the product of x - root over all roots.
DyadicPolynomial with_roots(const std::vector<double>& roots) {
  DyadicPolynomial product({Dyadic(1)});
  for (const double root : roots) product = product * DyadicPolynomial({Dyadic(-root), Dyadic(1)});
  return product;
}

}  // namespace

TEST_CASE("a Sturm chain counts distinct real roots, multiple ones too") {
  CHECK(SturmChain(with_roots({1, 2, 3})).count() == 3);
  CHECK(SturmChain(with_roots({1, 1, 3, 3, 3})).count() == 2);
  CHECK(SturmChain(DyadicPolynomial({Dyadic(1), Dyadic(0), Dyadic(1)})).count() == 0);  // x^2 + 1
  CHECK(SturmChain(DyadicPolynomial({Dyadic(5)})).count() == 0);
  const SturmChain chain(with_roots({-4, -0x1p-60, 0x1p-60, 4}));
  CHECK(chain.count() == 4);
  CHECK(chain.count(-1, 1) == 2);
  CHECK(chain.count(0, 1) == 1);
  CHECK(chain.count(-100, 0) == 2);
}

TEST_CASE("separators have one root between each two") {
  const std::vector<double> roots{-1e30, -1, -1 + 0x1p-50, 0, 0x1p-200, 7, 1e30};
  const DyadicPolynomial polynomial = with_roots(roots);
  const std::vector<Dyadic> separators = root_separators(polynomial);
  REQUIRE(separators.size() == roots.size() + 1);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    CHECK((Dyadic(roots[i]) - separators[i]).sign() > 0);
    CHECK((separators[i + 1] - Dyadic(roots[i])).sign() > 0);
  }
  CHECK(root_separators(DyadicPolynomial({Dyadic(1), Dyadic(0), Dyadic(1)})).empty());
}

TEST_CASE("a refined root is good to 100 bits, whatever it is added to") {
  // This is the root of x^2 - 2 between 1 and 2, and that root less a number next to it.
  const DyadicPolynomial polynomial({Dyadic(-2), Dyadic(0), Dyadic(1)});
  const auto is_beyond = [&](const Dyadic& x) { return polynomial.value(x).sign() > 0; };
  const auto error_of = [&](const Dyadic& root) {
    // x^2 - 2 is 2 sqrt(2) times the error of x.
    const ScaledNumber height = polynomial.value(root).rounded();
    return std::abs(height.unscaled().hi) / 2.8;
  };
  CHECK(error_of(refined_root(polynomial, 1, 2, {}, is_beyond)) < 0x1p-100);
  constexpr double root_of_two = 0x1.6a09e667f3bcdp0;
  CHECK(error_of(refined_root(polynomial, 1, 2, -root_of_two, is_beyond)) < 0x1p-150);
}

TEST_CASE("a root of higher order is found by its sign alone") {
  const DyadicPolynomial polynomial = with_roots({3, 3, 3});
  const Dyadic root = refined_root(polynomial, 0, 10, {},
                                   [&](const Dyadic& x) { return polynomial.value(x).sign() > 0; });
  CHECK(std::abs((root - Dyadic(3)).rounded().unscaled().hi) < 0x1p-100);
}
