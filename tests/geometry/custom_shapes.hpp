// Tests make custom shapes of primitives whose crossings are known.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/geometry/shape.hpp"
#include "crt/custom.hpp"
#include "crt/primitives.hpp"

namespace crt::test {

/// A PrimitiveAsCustom says of a finite solid what its shape says.
class PrimitiveAsCustom final : public CustomShape {
 public:
  explicit PrimitiveAsCustom(Primitive primitive)
      : primitive_(std::move(primitive)), shape_(core::make_shape(primitive_)) {}

  const Primitive& primitive() const { return primitive_; }

  BoundingBox bounds() const override {
    const core::Bounds bounds = shape_->bounds();
    return {.lower = bounds.lower, .upper = bounds.upper};
  }
  void crossings(const Ray& ray, std::vector<CustomCrossing>& out) const override {
    core::CrossingList list;
    shape_->crossings({.origin = ray.origin, .direction = ray.direction}, list);
    for (const core::Crossing& crossing : list) {
      out.push_back({.t = crossing.t, .error = crossing.error, .face = crossing.face});
    }
  }
  CustomPoint point(const Vec3& position, std::uint32_t face) const override {
    const core::SurfacePoint point =
        shape_->point_on(position - shape_->anchor(face), Vec3(0), face, true);
    return {.normal = point.normal, .u = point.u, .v = point.v};
  }
  std::uint32_t face_count() const override { return shape_->face_count(); }

 private:
  Primitive primitive_;
  std::unique_ptr<const core::Shape> shape_;
};

inline Custom as_custom(const Primitive& primitive) {
  return {.shape = std::make_shared<const PrimitiveAsCustom>(primitive)};
}

}  // namespace crt::test
