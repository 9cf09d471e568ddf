// The oracle of cylinders and cones.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/oracle.hpp"

namespace crt::test {

struct FrustumOracle {
  RealVec from;
  RealVec to;
  Real from_radius;
  Real to_radius;

  RealVec axis() const { return normalized(to - from); }
  Real height() const { return length(to - from); }

  std::vector<Real> candidates(const RealRay& ray) const {
    const RealVec w = axis();
    const RealVec o = ray.origin - from;
    const RealVec p = cross(o, w);
    const RealVec m = cross(ray.direction, w);
    const Real slope = (to_radius - from_radius) / height();
    const Real s0 = from_radius + slope * dot(o, w);
    const Real s1 = slope * dot(ray.direction, w);
    std::vector<Real> result = quadratic_roots(dot(m, m) - s1 * s1, dot(p, m) - s0 * s1, dot(p, p) - s0 * s0);
    for (const RealVec& end : {from, to}) {
      for (const Real root : plane_roots(ray, w, end)) result.push_back(root);
    }
    return result;
  }

  Real field(const RealVec& point) const {
    const RealVec w = axis();
    const Real z = dot(point - from, w);
    const Real rho = length(cross(point - from, w));
    const Real slope = (to_radius - from_radius) / height();
    const Real cosine = 1 / square_root(1 + slope * slope);
    return std::max({cosine * (rho - from_radius - slope * z), -z, z - height()});
  }
};

}  // namespace crt::test
