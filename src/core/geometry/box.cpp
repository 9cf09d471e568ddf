#include "core/geometry/box.hpp"

#include "core/geometry/checks.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

BoxShape::BoxShape(const Box& box)
    : lower_(glm::min(box.corner_a, box.corner_b)),
      upper_(glm::max(box.corner_a, box.corner_b)),
      faces_{PlaneFace({-1, 0, 0}, lower_), PlaneFace({1, 0, 0}, upper_),  PlaneFace({0, -1, 0}, lower_),
             PlaneFace({0, 1, 0}, upper_),  PlaneFace({0, 0, -1}, lower_), PlaneFace({0, 0, 1}, upper_)} {}

bool BoxShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const double shortest =
      unit_roundoff * (largest_component(upper_ - lower_) / largest_component(ray.direction));
  Stretch stretch(ray.start, shortest);
  for (std::uint32_t face = 0; face < 6; face += 2) {
    faces_[face].clip(ray, face, stretch);
    faces_[face + 1].clip(ray, face + 1, stretch);
    if (ray.start.face == no_face && stretch.empty()) return false;
  }
  return stretch.finish(out);
}

SurfacePoint BoxShape::surface_point(const ObjectRay& ray, const Crossing& crossing, bool /*with_uv*/) const {
  const PlaneFace& face = faces_[crossing.face];
  const int across = face.axis();
  Vec3 share;
  SurfacePoint result;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = upper_[axis] - lower_[axis];
    const double offset = std::clamp(ray.from_center(lower_, crossing.t)[axis], 0.0, size);
    share[axis] = offset / size;
    result.position[axis] = std::min(lower_[axis] + offset, upper_[axis]);
  }
  result.position[across] = face.position()[across];
  result.normal = face.unit_normal();
  result.u = across == 0 ? share.z : share.x;
  result.v = across == 1 ? share.z : share.y;
  return result;
}

void validate(const Box& box) {
  check_coordinates("corner_a", box.corner_a);
  check_coordinates("corner_b", box.corner_b);
  for (int axis = 0; axis < 3; ++axis) {
    if (box.corner_a[axis] == box.corner_b[axis]) {
      reject("corner_b", "must differ from corner_a in every coordinate");
    }
  }
}

std::unique_ptr<const Shape> make_shape(const Box& box) {
  return std::make_unique<BoxShape>(box);
}

}  // namespace crt::core
