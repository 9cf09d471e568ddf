// The oracle needs quadruple precision and scaled primitives.
#include <cmath>

#include "core/geometry/implicit/field_node.hpp"
#include "geometry/custom_shapes.hpp"
#include "geometry/oracle.hpp"
#include "geometry/scaled_mesh.hpp"
#include "geometry/scaled_profile.hpp"

namespace crt::test {

Real square_root(Real x) {
  if (!(x > 0)) return 0;
  Real root = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3; ++i) root = (root + x / root) / 2;
  return root;
}

std::vector<Real> quadratic_roots(Real a, Real b, Real c) {
  if (a == 0) return b == 0 ? std::vector<Real>{} : std::vector<Real>{-c / (2 * b)};
  const Real discriminant = b * b - a * c;
  if (discriminant < 0) return {};
  const Real root = square_root(discriminant);
  const Real sum = b >= 0 ? -(b + root) : root - b;
  if (sum == 0) return {0};
  return {sum / a, c / sum};
}

std::vector<Real> plane_roots(const RealRay& ray, const RealVec& normal, const RealVec& position) {
  const Real rate = dot(normal, ray.direction);
  if (rate == 0) return {};
  return {dot(normal, position - ray.origin) / rate};
}

namespace {

Sphere times(Sphere s, double k) {
  s.center *= k;
  s.radius *= k;
  return s;
}
Box times(Box s, double k) {
  s.corner_a *= k;
  s.corner_b *= k;
  return s;
}
Plane times(Plane s, double k) {
  s.position *= k;
  return s;
}
HalfPlane times(HalfPlane s, double k) {
  s.position *= k;
  return s;
}
Cylinder times(Cylinder s, double k) {
  s.from *= k;
  s.to *= k;
  s.radius *= k;
  return s;
}
Cone times(Cone s, double k) {
  s.from *= k;
  s.to *= k;
  s.radius *= k;
  s.radius2 *= k;
  return s;
}
Capsule times(Capsule s, double k) {
  s.from *= k;
  s.to *= k;
  s.radius *= k;
  return s;
}
Torus times(Torus s, double k) {
  s.center *= k;
  s.radius *= k;
  s.thickness *= k;
  return s;
}
Disc times(Disc s, double k) {
  s.center *= k;
  s.radius *= k;
  return s;
}
Mesh times(const Mesh& s, double k) {
  return scaled_mesh(s, k);
}
Extrusion times(Extrusion s, double k) {
  s.profile = scaled_profile(*s.profile, k);
  s.from *= k;
  s.to *= k;
  return s;
}
Revolution times(Revolution s, double k) {
  s.profile = scaled_profile(*s.profile, k);
  return s;
}

HeightField times(HeightField s, double k) {
  s.corner_a *= k;
  s.corner_b *= k;
  return s;
}
Quadric times(Quadric s, double k) {
  s.squares /= k;
  s.squares /= k;
  s.products /= k;
  s.products /= k;
  s.linear /= k;
  return s;
}

/// Returns f(p / k), which has no rounding for powers of two.
Field with_scaled_argument(const core::FieldNode& node, double k) {
  using core::FieldOperation;
  const bool is_coordinate = node.operation == FieldOperation::x ||
                             node.operation == FieldOperation::y ||
                             node.operation == FieldOperation::z;
  if (is_coordinate) return core::FieldNode::make(node.operation) * (1 / k);
  if (!node.a) return core::FieldNode::make(node.operation, node.number);
  const Field a = with_scaled_argument(*node.a, k);
  if (!node.b) return core::FieldNode::make(node.operation, node.number, &a);
  const Field b = with_scaled_argument(*node.b, k);
  return core::FieldNode::make(node.operation, node.number, &a, &b);
}

Implicit times(Implicit s, double k) {
  s.field = with_scaled_argument(s.field.node(), k);
  s.lower *= k;
  s.upper *= k;
  return s;
}
Custom times(const Custom& s, double k) {
  return as_custom(scaled(dynamic_cast<const PrimitiveAsCustom&>(*s.shape).primitive(), k));
}
Triangle times(Triangle s, double k) {
  s.a *= k;
  s.b *= k;
  s.c *= k;
  return s;
}

}  // namespace

Primitive scaled(const Primitive& primitive, double factor) {
  return std::visit([factor](const auto& p) -> Primitive { return times(p, factor); }, primitive);
}

}  // namespace crt::test
