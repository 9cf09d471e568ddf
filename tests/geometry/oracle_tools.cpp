// The oracle needs quadruple precision and scaled primitives.
#include <cmath>

#include "core/geometry/implicit/field_node.hpp"
#include "crt/schema_primitives.hpp"
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

/// Scales what the schema has as points and lengths.
template <class Shape>
Shape times(Shape s, double k) {
  using enum schema::Rule::Kind;
  schema::for_each_field<Shape>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    const auto kind = row.rule.kind;
    if constexpr (std::is_same_v<Value, double>) {
      if (kind == length || kind == length_or_zero) s.*row.member *= k;
    } else if constexpr (std::is_same_v<Value, Vec3>) {
      if (kind == point || kind == apart || kind == corner) s.*row.member *= k;
    }
  });
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
  return times<Implicit>(std::move(s), k);
}
Custom times(const Custom& s, double k) {
  return as_custom(scaled(dynamic_cast<const PrimitiveAsCustom&>(*s.shape).primitive(), k));
}

}  // namespace

Primitive scaled(const Primitive& primitive, double factor) {
  return std::visit([factor](const auto& p) -> Primitive { return times(p, factor); }, primitive);
}

}  // namespace crt::test
