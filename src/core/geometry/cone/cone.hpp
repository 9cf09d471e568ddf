// A cone has all points between the planes across the axis through `from` and `to` whose distance
// from the axis is at most the radius there. The radius goes from `radius` to `radius2` at a
// constant rate. Equation, faces and (u, v) are in core/geometry/frustum/frustum.hpp. With radius2
// = 0 there is no face 2.
// Tests: tests/geometry/cone_test.cpp
#pragma once

#include "core/geometry/frustum/frustum.hpp"

namespace crt::core {

class ConeShape final : public FrustumShape {
 public:
  explicit ConeShape(const Cone& cone)
      : FrustumShape(cone.from, cone.to, cone.radius, cone.radius2) {}
};

inline bool is_solid(const Cone&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Cone& cone);
std::unique_ptr<const ExactShape> make_exact_shape(const Cone& cone);

}  // namespace crt::core
