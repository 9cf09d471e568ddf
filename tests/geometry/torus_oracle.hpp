// This is the oracle of tori.
#pragma once

#include <vector>

#include "geometry/oracle.hpp"

namespace crt::test {

inline Real value(const std::vector<Real>& polynomial, Real x) {
  Real result = 0;
  for (std::size_t i = polynomial.size(); i-- > 0;) result = result * x + polynomial[i];
  return result;
}

/// Returns all real roots within [low, high], isolated by the roots of the derivative.
inline std::vector<Real> polynomial_roots(const std::vector<Real>& polynomial, Real low,
                                          Real high) {
  if (polynomial.size() < 2) return {};
  std::vector<Real> derivative;
  for (std::size_t i = 1; i < polynomial.size(); ++i)
    derivative.push_back(static_cast<int>(i) * polynomial[i]);
  std::vector<Real> ends = polynomial_roots(derivative, low, high);
  ends.insert(ends.begin(), low);
  ends.push_back(high);
  std::vector<Real> roots;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    Real a = ends[i];
    Real b = ends[i + 1];
    if ((value(polynomial, a) < 0) == (value(polynomial, b) < 0)) continue;
    const bool negative_first = value(polynomial, a) < 0;
    for (int step = 0; step < 116; ++step) {
      const Real middle = (a + b) / 2;
      ((value(polynomial, middle) < 0) == negative_first ? a : b) = middle;
    }
    roots.push_back((a + b) / 2);
  }
  return roots;
}

/// Returns the roots of the textbook quartic (|p|^2 + R^2 - r^2)^2 = 4 R^2 rho^2, about the closest
/// approach.
inline std::vector<Real> torus_candidates(const RealRay& ray, const RealVec& center,
                                          const RealVec& axis, Real ring, Real tube) {
  const RealVec d = normalized(ray.direction);
  const RealVec from_center = ray.origin - center;
  const Real closest = -dot(from_center, d);
  const RealVec q = from_center + closest * d;
  const Real reach = 2 * (ring + tube);
  if (length(q) > reach) return {};
  const Real b = dot(q, d);
  const Real c = dot(q, q) + ring * ring - tube * tube;
  const RealVec p = cross(q, axis);
  const RealVec m = cross(d, axis);
  const Real k = 4 * ring * ring;
  const std::vector<Real> quartic = {c * c - k * dot(p, p), 4 * b * c - 2 * k * dot(p, m),
                                     2 * c + 4 * b * b - k * dot(m, m), 4 * b, 1};
  std::vector<Real> roots = polynomial_roots(quartic, -reach, reach);
  for (Real& root : roots) root = (root + closest) / length(ray.direction);
  return roots;
}

}  // namespace crt::test
