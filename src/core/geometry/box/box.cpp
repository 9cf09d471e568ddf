#include "core/geometry/box/box.hpp"

#include <limits>

#include "core/math/vector.hpp"

namespace crt::core {

BoxShape::BoxShape(const Box& box)
    : lower_(glm::min(box.corner_a, box.corner_b)),
      upper_(glm::max(box.corner_a, box.corner_b)),
      faces_{PlaneFace({-1, 0, 0}, lower_), PlaneFace({1, 0, 0}, upper_),
             PlaneFace({0, -1, 0}, lower_), PlaneFace({0, 1, 0}, upper_),
             PlaneFace({0, 0, -1}, lower_), PlaneFace({0, 0, 1}, upper_)} {}

std::optional<CoreSegment> BoxShape::core_segment() const {
  const Vec3 size = upper_ - lower_;
  int along = size.y > size.x ? 1 : 0;
  if (size.z > size[along]) along = 2;
  Vec3 across = 0.5 * size;
  across[along] = 0;
  const double reach = glm::length(across);
  return CoreSegment{lower_ + across, upper_ - across, reach, reach};
}

bool BoxShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const double shortest =
      unit_roundoff * (largest_component(upper_ - lower_) / largest_component(ray.direction));
  ClippedSpan span(ray.start, shortest);
  if (ray.start.face == no_face) {
    const unsigned ends = possible_ends(ray);
    if (ends == 0) return false;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      if ((ends >> face & 1u) == 0) continue;
      faces_[face].clip(ray, face, span);
      if (span.empty()) return false;
    }
  } else {
    for (std::uint32_t face = 0; face < faces_.size(); ++face) faces_[face].clip(ray, face, span);
  }
  return span.finish(out);
}

unsigned BoxShape::possible_ends(const ObjectRay& ray) const {
  std::array<double, 3> enter;
  std::array<double, 3> leave;
  std::array<double, 3> error;
  double last_enter = -infinity;
  double first_leave = infinity;
  // This covers the low parts of origin and direction, and the roundings here.
  constexpr double slack = 0x1p-48;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double origin = ray.origin[axis];
    enter[i] = -infinity;
    leave[i] = infinity;
    error[i] = 0;
    if (ray.direction[axis] == 0 && ray.direction_low[axis] == 0) {
      const double margin = slack * std::abs(origin);
      if (lower_[axis] + margin < origin && origin < upper_[axis] - margin) continue;
      return all_faces;
    }
    const double inverse = 1 / ray.direction[axis];
    constexpr double steepest = 0x1p500;
    if (!(std::abs(inverse) < steepest)) return all_faces;
    const double lower = (lower_[axis] - origin) * inverse;
    const double upper = (upper_[axis] - origin) * inverse;
    enter[i] = std::min(lower, upper);
    leave[i] = std::max(lower, upper);
    error[i] = slack * (std::abs(lower) + std::abs(upper) + std::abs(origin * inverse));
    last_enter = std::max(last_enter, enter[i] - error[i]);
    first_leave = std::min(first_leave, leave[i] + error[i]);
  }
  if (last_enter > first_leave) return 0;
  unsigned faces = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool upwards = ray.direction[static_cast<int>(axis)] > 0;
    const unsigned near = 1u << (2 * axis + (upwards ? 0 : 1));
    const unsigned far = 1u << (2 * axis + (upwards ? 1 : 0));
    if (enter[axis] + error[axis] >= last_enter) faces |= near;
    if (leave[axis] - error[axis] <= first_leave) faces |= far;
  }
  return faces;
}

template <class Real>
void BoxShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t face,
                           bool with_uv, SurfacePointOf<Real>& point) const {
  using Vector = Vec3Of<Real>;
  const PlaneFace& plane = faces_[face];
  const Vector size = broadcast<Real>(upper_ - lower_);
  const Vector within = clamp(offset, broadcast<Real>(Vec3(0)), size);
  point.position = min(broadcast<Real>(upper_), broadcast<Real>(lower_) + within);
  point.position[plane.axis()] = broadcast<Real>(plane.position()[plane.axis()]);
  point.normal = broadcast<Real>(plane.unit_normal());
  if (!with_uv) return;
  const Vector share = within / size;
  point.u = plane.axis() == 0 ? share.z : share.x;
  point.v = plane.axis() == 1 ? share.z : share.y;
}

std::unique_ptr<const Shape> make_shape(const Box& box) {
  return std::make_unique<BoxShape>(box);
}

}  // namespace crt::core
