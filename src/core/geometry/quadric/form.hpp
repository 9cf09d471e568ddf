// The polynomial of a quadric is kept in lengths of the quadric's size.
//
// Notation: f(p) = p . H p / 2 + b . p + c, with H the matrix of second derivatives. So the
// gradient is H p + b.
#pragma once

#include <array>
#include <cmath>

#include "core/geometry/bounds.hpp"
#include "core/math/vector_lanes.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// A QuadricForm is f in lengths of a unit, times some power of two. So it has the numbers of the
/// quadric without rounding, the largest of them near 1.
struct QuadricForm {
  explicit QuadricForm(const Quadric& quadric);

  std::array<Vec3, 3> rows;  ///< of H
  Vec3 linear;
  double constant;
  double unit;    ///< a power of two near the quadric's size
  bool has_size;  ///< f has terms of different degrees; otherwise the unit is 1

  /// Returns f without the rounding of its terms, up to that of twice the precision. The point is
  /// in units.
  template <class Vector>
  RealOf<Vector> value(const Vector& p) const;

  /// Returns the gradient at a point in units.
  template <class Vector>
  Vector gradient(const Vector& p) const {
    using Real = RealOf<Vector>;
    const auto component = [&](int axis) {
      const Vec3& row = rows[static_cast<std::size_t>(axis)];
      return Real(accurate_dot(broadcast<Real>(row), p).value() + broadcast<Real>(linear[axis]));
    };
    return {component(0), component(1), component(2)};
  }
};

/// This adds numbers and products in twice the precision.
/// Source: Ogita, Rump, Oishi, Accurate sum and dot product, 2005 (Sum2).
template <class Real>
struct PreciseSum {
  Real sum{};
  Real low{};

  void add(const Real& x) {
    const auto both = two_sum(sum, x);
    sum = both.hi;
    low = low + both.lo;
  }
  void add_product(const Real& x, const Real& y) {
    const auto product = two_product(x, y);
    add(product.hi);
    low = low + product.lo;
  }
  /// Adds x y z.
  void add_product(const Real& x, const Real& y, const Real& z) {
    const auto product = two_product(x, y);
    add_product(product.hi, z);
    low = low + product.lo * z;
  }
};

template <class Vector>
RealOf<Vector> QuadricForm::value(const Vector& p) const {
  using Real = RealOf<Vector>;
  PreciseSum<Real> result;
  result.add(broadcast<Real>(constant));
  for (int i = 0; i < 3; ++i) {
    const Vec3& row = rows[static_cast<std::size_t>(i)];
    result.add_product(broadcast<Real>(linear[i]), p[i]);
    result.add_product(broadcast<Real>(row[i] / 2), p[i], p[i]);
    for (int j = i + 1; j < 3; ++j) result.add_product(broadcast<Real>(row[j]), p[i], p[j]);
  }
  return result.sum + result.low;
}

/// A QuadricExtent says how far a quadric extends, by signs that are decided without rounding.
struct QuadricExtent {
  explicit QuadricExtent(const Quadric& quadric);

  bool is_convex = false;   ///< f is convex
  bool is_bounded = false;  ///< it is an ellipsoid
  Bounds bounds;            ///< rounded outwards
};

}  // namespace crt::core
