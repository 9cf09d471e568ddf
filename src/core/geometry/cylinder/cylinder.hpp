// A cylinder has all points within `radius` of the line through `from` and `to`, between the two
// planes across it through them. Equation, faces and (u, v) are in
// core/geometry/frustum/frustum.hpp, with alpha = 0.
// Tests: tests/geometry/cylinder_test.cpp
#pragma once

#include "core/geometry/frustum/frustum.hpp"

namespace crt::core {

class CylinderShape final : public FrustumShape {
 public:
  explicit CylinderShape(const Cylinder& cylinder)
      : FrustumShape(cylinder.from, cylinder.to, cylinder.radius, cylinder.radius) {}
};

inline bool is_solid(const Cylinder&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Cylinder& cylinder);
std::unique_ptr<const ExactShape> make_exact_shape(const Cylinder& cylinder);

}  // namespace crt::core
