// This is the oracle of cylinders and cones.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/oracle.hpp"

namespace crt::test {

class FrustumOracle {
 public:
  FrustumOracle(const Vec3& from, const Vec3& to, double from_radius, double to_radius)
      : from_(from),
        to_(to),
        axis_(normalized(to_ - from_)),
        height_(length(to_ - from_)),
        radius_(from_radius),
        slope_((Real(to_radius) - Real(from_radius)) / height_),
        cosine_(1 / square_root(1 + slope_ * slope_)) {}

  std::vector<Real> candidates(const RealRay& ray) const {
    const RealVec o = ray.origin - from_;
    const RealVec p = cross(o, axis_);
    const RealVec m = cross(ray.direction, axis_);
    const Real s0 = radius_ + slope_ * dot(o, axis_);
    const Real s1 = slope_ * dot(ray.direction, axis_);
    std::vector<Real> result =
        quadratic_roots(dot(m, m) - s1 * s1, dot(p, m) - s0 * s1, dot(p, p) - s0 * s0);
    for (const RealVec& end : {from_, to_}) {
      for (const Real root : plane_roots(ray, axis_, end)) result.push_back(root);
    }
    return result;
  }

  Real field(const RealVec& point) const {
    const Real z = dot(point - from_, axis_);
    const Real rho = length(cross(point - from_, axis_));
    return std::max({cosine_ * (rho - radius_ - slope_ * z), -z, z - height_});
  }

 private:
  RealVec from_;
  RealVec to_;
  RealVec axis_;
  Real height_;
  Real radius_;  ///< at from
  Real slope_;
  Real cosine_;
};

}  // namespace crt::test
