#include "core/geometry/quadric/form.hpp"

#include <algorithm>
#include <optional>

#include "core/geometry/checks.hpp"
#include "core/geometry/quadric/quadric.hpp"
#include "core/math/dyadic_vector.hpp"

namespace crt::core {
namespace {

/// This is less than any exponent of a double.
constexpr int no_exponent = -100000;

int exponent_of(double x) {
  return x == 0 ? no_exponent : std::ilogb(x);
}

/// QuadricExponents are the powers of two of a quadric's unit of length, and of the largest term of
/// f within that length of the origin.
struct QuadricExponents {
  int unit = 0;
  int value = 0;
  bool has_size = false;

  explicit QuadricExponents(const Quadric& quadric) {
    const int curving = exponent_of(
        std::max(largest_component(quadric.squares), largest_component(quadric.products)));
    const int slope = exponent_of(largest_component(quadric.linear));
    const int constant = exponent_of(quadric.constant);
    if (curving == no_exponent) {
      has_size = constant != no_exponent;
      if (has_size) unit = constant - slope;
      value = slope + unit;
      return;
    }
    // A half is rounded down.
    has_size = slope != no_exponent || constant != no_exponent;
    if (has_size) unit = std::max(slope - curving, (constant - curving) >> 1);
    value = curving + 2 * unit;
  }

  /// Returns a coefficient of this degree in lengths of the unit.
  double scaled(double coefficient, int degree) const {
    return std::ldexp(coefficient, degree * unit - value);
  }
  Vec3 scaled(const Vec3& coefficients, int degree) const {
    return {scaled(coefficients.x, degree), scaled(coefficients.y, degree),
            scaled(coefficients.z, degree)};
  }
};

template <std::size_t size>
using DyadicMatrix = std::array<std::array<Dyadic, size>, size>;

/// Returns the rank of a symmetric matrix, if it is positive semidefinite. It is brought to
/// diagonal form by elimination, with rows times positive numbers, so that nothing is divided.
template <std::size_t size>
std::optional<std::size_t> semidefinite_rank(DyadicMatrix<size> m) {
  std::array<bool, size> is_done{};
  for (std::size_t rank = 0;; ++rank) {
    std::size_t pivot = 0;
    while (pivot < size && (is_done[pivot] || m[pivot][pivot].sign() == 0)) ++pivot;
    if (pivot < size && m[pivot][pivot].sign() < 0) return std::nullopt;
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = 0; j < size; ++j) {
        if (is_done[i] || is_done[j] || i == pivot || j == pivot) continue;
        if (pivot < size) {
          m[i][j] = m[pivot][pivot] * m[i][j] - m[i][pivot] * m[pivot][j];
        } else if (m[i][j].sign() != 0) {
          return std::nullopt;
        }
      }
    }
    if (pivot == size) return rank;
    is_done[pivot] = true;
  }
}

DyadicMatrix<3> curving_of(const Quadric& q) {
  const auto twice = [](double x) { return Dyadic(x) + Dyadic(x); };
  const auto& [xy, xz, yz] = exactly(q.products);
  return {
      {{twice(q.squares.x), xy, xz}, {xy, twice(q.squares.y), yz}, {xz, yz, twice(q.squares.z)}}};
}

/// Returns the matrix of 2 f, as a form in x, y, z and 1, times some number.
DyadicMatrix<4> whole_form_of(const Quadric& q, const Dyadic& times) {
  DyadicMatrix<4> result;
  const DyadicMatrix<3> curving = curving_of(q);
  const DyadicVector linear = exactly(q.linear);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) result[i][j] = times * curving[i][j];
    result[i][3] = result[3][i] = times * linear[i];
  }
  result[3][3] = times * (Dyadic(q.constant) + Dyadic(q.constant));
  return result;
}

/// Returns the box of an ellipsoid. Its center is -A b / det H, with A the adjugate of H. f there
/// is c - b . A b / (2 det H), and the squared extent along an axis -2 f A_ii / det H.
Bounds bounds_of_ellipsoid(const Quadric& quadric) {
  const DyadicMatrix<3> h = curving_of(quadric);
  const DyadicVector b = exactly(quadric.linear);
  const DyadicMatrix<3> adjugate = {cross(h[1], h[2]), cross(h[2], h[0]), cross(h[0], h[1])};
  const Dyadic determinant = dot(h[0], adjugate[0]);
  const DyadicVector around = {dot(adjugate[0], b), dot(adjugate[1], b), dot(adjugate[2], b)};
  const Dyadic twice_c = Dyadic(quadric.constant) + Dyadic(quadric.constant);
  const Dyadic depth = dot(b, around) - twice_c * determinant;
  const ScaledNumber divisor = determinant.rounded();
  const ScaledNumber squared_divisor = square(determinant).rounded();
  Vec3 center;
  Vec3 extents;
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    center[axis] = (-around[i].rounded() / divisor).unscaled().hi;
    extents[axis] = sqrt((depth * adjugate[i][i]).rounded() / squared_divisor).unscaled().hi;
  }
  constexpr double farthest = 1e100;
  const bool is_near =
      largest_component(center) <= farthest && largest_component(extents) <= farthest;
  if (!is_near) return Bounds::everything();
  Bounds result;
  result.include_around(center, extents);
  return result;
}

void check_finite(const char* argument, const Vec3& value) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(value[axis])) reject(argument, "must be finite");
  }
}

/// Checks that none but 0 of the coefficients of a degree is too small in the quadric's unit.
void check_fair_sizes(const char* argument, const Vec3& coefficients, int degree,
                      const QuadricExponents& exponents) {
  constexpr double smallest = 1e-200;
  for (int axis = 0; axis < 3; ++axis) {
    const double coefficient = coefficients[axis];
    if (coefficient == 0 || std::abs(exponents.scaled(coefficient, degree)) >= smallest) continue;
    reject(argument,
           "must have no number but 0 below 1e-200 of the largest coefficient, with the size of "
           "the quadric as the unit of length");
  }
}

}  // namespace

QuadricForm::QuadricForm(const Quadric& quadric) {
  const QuadricExponents exponents(quadric);
  const Vec3 squares = exponents.scaled(quadric.squares, 2);
  const Vec3 products = exponents.scaled(quadric.products, 2);
  rows = {Vec3(2 * squares.x, products.x, products.y), Vec3(products.x, 2 * squares.y, products.z),
          Vec3(products.y, products.z, 2 * squares.z)};
  linear = exponents.scaled(quadric.linear, 1);
  constant = exponents.scaled(quadric.constant, 0);
  unit = std::ldexp(1.0, exponents.unit);
  has_size = exponents.has_size;
}

QuadricExtent::QuadricExtent(const Quadric& quadric) {
  const std::optional<std::size_t> rank = semidefinite_rank(curving_of(quadric));
  is_convex = rank.has_value();
  is_bounded = rank == 3;
  bounds = is_bounded ? bounds_of_ellipsoid(quadric) : Bounds::everything();
}

void validate(const Quadric& quadric) {
  check_finite("squares", quadric.squares);
  check_finite("products", quadric.products);
  check_finite("linear", quadric.linear);
  check_finite("constant", Vec3(quadric.constant));
  if (quadric.squares == Vec3(0) && quadric.products == Vec3(0) && quadric.linear == Vec3(0)) {
    reject("squares", "must not be 0 together with products and linear");
  }
  const QuadricExponents exponents(quadric);
  constexpr double smallest = 1e-100;
  constexpr double largest = 1e100;
  constexpr int most = 2000;
  const double unit = std::ldexp(1.0, std::clamp(exponents.unit, -most, most));
  if (!(unit >= smallest && unit <= largest)) {
    reject("constant", "and linear must give the quadric a size from 1e-100 to 1e100");
  }
  check_fair_sizes("squares", quadric.squares, 2, exponents);
  check_fair_sizes("products", quadric.products, 2, exponents);
  check_fair_sizes("linear", quadric.linear, 1, exponents);
  check_fair_sizes("constant", Vec3(quadric.constant), 0, exponents);
  if (semidefinite_rank(whole_form_of(quadric, 1.0))) {
    reject("constant", "must leave points where the sum is below 0, as the quadric is empty");
  }
  if (semidefinite_rank(whole_form_of(quadric, -1.0))) {
    reject("constant", "must leave points where the sum is above 0, as the quadric has no surface");
  }
}

}  // namespace crt::core
