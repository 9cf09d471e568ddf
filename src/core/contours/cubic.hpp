// Cubic Bézier curves of the plane in Bernstein form, and what bounds them.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "core/math/plane_vector.hpp"

namespace crt::core {

/// A Bernstein polynomial of the degree. Its values on [0, 1] are between its least and its largest
/// coefficient.
template <class Value, std::size_t degree>
using Bernstein = std::array<Value, degree + 1>;

/// Returns how many ways there are to choose k of n.
constexpr double choices(std::size_t n, std::size_t k) {
  double result = 1;
  for (std::size_t i = 0; i < k; ++i) {
    result *= static_cast<double>(n - i) / static_cast<double>(i + 1);
  }
  return result;
}

/// Returns the polynomial whose value is product(a's value, b's value).
template <class A, std::size_t n, class B, std::size_t m, class Product>
auto bernstein_product(const std::array<A, n>& a, const std::array<B, m>& b, Product product) {
  constexpr std::size_t degree = n + m - 2;
  Bernstein<decltype(product(a[0], b[0])), degree> result{};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < m; ++k) {
      const double weight = choices(n - 1, i) * choices(m - 1, k) / choices(degree, i + k);
      result[i + k] += weight * product(a[i], b[k]);
    }
  }
  return result;
}

/// A Cubic is a curve by its control points.
using Cubic = Bernstein<Vec2, 3>;

/// Returns a third of the derivative.
inline Bernstein<Vec2, 2> steps_of(const Cubic& curve) {
  return {curve[1] - curve[0], curve[2] - curve[1], curve[3] - curve[2]};
}

/// Returns the parts before and after a parameter, by de Casteljau's algorithm.
inline std::pair<Cubic, Cubic> split(const Cubic& curve, double t) {
  const auto between = [t](const Vec2& a, const Vec2& b) { return a + t * (b - a); };
  const Vec2 ab = between(curve[0], curve[1]);
  const Vec2 bc = between(curve[1], curve[2]);
  const Vec2 cd = between(curve[2], curve[3]);
  const Vec2 abc = between(ab, bc);
  const Vec2 bcd = between(bc, cd);
  const Vec2 middle = between(abc, bcd);
  return {{curve[0], ab, abc, middle}, {middle, bcd, cd, curve[3]}};
}

}  // namespace crt::core
