// Quadrics of all kinds are made at random for the tests.
#pragma once

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "geometry/oracle.hpp"

namespace crt::test {

/// Returns f of a quadric at a point, or along a line its values at t^0, and halves of those at
/// t^1.
struct QuadricTerms {
  Real a = 0, b = 0, c = 0;

  QuadricTerms(const Quadric& q, const RealVec& p, const RealVec& d) {
    const auto curved = [&](const RealVec& v) {
      return RealVec(2 * Real{q.squares.x} * v.x + Real{q.products.x} * v.y + q.products.y * v.z,
                     Real{q.products.x} * v.x + 2 * Real{q.squares.y} * v.y + q.products.z * v.z,
                     Real{q.products.y} * v.x + Real{q.products.z} * v.y + 2 * q.squares.z * v.z);
    };
    const RealVec linear(q.linear);
    gradient = curved(p) + linear;
    a = dot(d, curved(d)) / 2;
    b = dot(d, gradient) / 2;
    c = dot(p, gradient + linear) / 2 + Real{q.constant};
  }

  RealVec gradient;
};

/// Returns the quadric with signs[i] (e_i . (p - center) / sizes[i])^2 and `lifts` . (p - center),
/// summed up, of three vectors e_i that are across one another.
inline Quadric quadric_about(const Vec3& center, const std::array<Vec3, 3>& across,
                             const Vec3& sizes, const Vec3& signs, const Vec3& lifts,
                             double constant) {
  Quadric q{.squares = {0, 0, 0}, .constant = constant};
  for (int i = 0; i < 3; ++i) {
    const Vec3& e = across[static_cast<std::size_t>(i)];
    const double k = signs[i] / (sizes[i] * sizes[i]);
    const double lift = lifts[i] / sizes[i];
    const double at = glm::dot(e, center);
    q.squares += k * e * e;
    q.products += 2 * k * Vec3(e.x * e.y, e.x * e.z, e.y * e.z);
    q.linear += (lift - 2 * k * at) * e;
    q.constant += k * at * at - lift * at;
  }
  return q;
}

inline std::array<Vec3, 3> random_frame(Random& random) {
  if (random.one_in(3)) return {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const Vec3 x = glm::normalize(random.in_cube());
  const Vec3 y = glm::normalize(glm::cross(x, random.in_cube()));
  return {x, y, glm::cross(x, y)};
}

struct PlacedQuadric {
  Quadric quadric;
  Vec3 center;
  double size;
};

/// Returns an ellipsoid.
inline PlacedQuadric random_ellipsoid(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (size * random.power_of_ten(-2, 1));
  const Vec3 shares(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
  const Vec3 sizes = size * shares;
  return {quadric_about(center, random_frame(random), sizes, {1, 1, 1}, {0, 0, 0}, -1), center,
          size};
}

/// Returns a quadric of any kind.
inline PlacedQuadric random_quadric(Random& random) {
  const double size = random.power_of_ten(-6, 6);
  const Vec3 center = random.in_cube() * (size * random.power_of_ten(-2, 1));
  while (true) {
    const Vec3 shares(random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1));
    Vec3 signs(0);
    Vec3 lifts(0);
    for (int i = 0; i < 3; ++i) {
      signs[i] = random.one_in(3) ? -1 : (random.one_in(4) ? 0 : 1);
      if (signs[i] == 0 && random.one_in(2)) lifts[i] = 1;
    }
    const double constant = random.one_in(3) ? 0 : (random.one_in(2) ? 1 : -1) * 0.3;
    const Quadric quadric =
        quadric_about(center, random_frame(random), size * shares, signs, lifts, constant);
    try {
      core::validate(quadric);
      return {quadric, center, size};
    } catch (const std::exception&) {
      continue;
    }
  }
}

inline Subject subject_of(const PlacedQuadric& placed) {
  const Quadric q = placed.quadric;
  return {.primitive = q,
          .center = placed.center,
          .size = placed.size,
          .candidates =
              [=](const RealRay& ray) {
                const QuadricTerms terms(q, ray.origin, ray.direction);
                return quadratic_roots(terms.a, terms.b, terms.c);
              },
          .field =
              [=](const RealVec& p) {
                const QuadricTerms terms(q, p, {});
                const Real slope = length(terms.gradient);
                return slope > 0 ? terms.c / slope : terms.c;
              }};
}

}  // namespace crt::test
